#include "mesh/closed_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "base/disjoint_sets.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string near(const Vec3& x) {
  std::ostringstream text;
  text << ", the first near (" << x.x() << ", " << x.y() << ", " << x.z() << ") of the file";
  return text.str();
}

/// Sets as numbers from 0, in the order of their first members.
std::vector<Index> numbers_of(DisjointSets& sets, std::size_t size, Index& count) {
  std::vector<Index> number(size, -1);
  for (std::size_t i = 0; i < size; ++i) {
    const Index r = sets.root(static_cast<Index>(i));
    number[i] = r == static_cast<Index>(i) ? count++ : number[at(r)];
  }
  return number;
}

class Surfaces {
 public:
  explicit Surfaces(const SurfaceTriangles& given) : points_(given.points), triangles_(given.triangles) {}

  ClosedSurfaces take_apart(double sharp) {
    ClosedSurfaces result;
    result.fault = fault_of_triangles();
    if (result.fault.empty()) result.fault = join(sharp, result);
    if (result.fault.empty()) result.fault = crossing();
    if (!result.fault.empty()) return {{}, {}, {}, 0, 0, result.fault};
    nest(result);
    return result;
  }

 private:
  [[nodiscard]] const Vec3& corner(Index t, std::size_t c) const { return points_[at(triangles_[at(t)][c])]; }
  [[nodiscard]] Vec3 area_vector(Index t) const {
    return 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  }
  [[nodiscard]] Index size() const { return static_cast<Index>(triangles_.size()); }

  [[nodiscard]] std::string fault_of_triangles() const {
    if (triangles_.empty()) return "holds no triangle";
    Index flat = 0, first = -1;
    for (Index t = 0; t < size(); ++t) {
      const auto& [a, b, c] = triangles_[at(t)];
      if (a != b && b != c && c != a && area_vector(t).squaredNorm() > 0) continue;
      if (flat++ == 0) first = t;
    }
    if (flat == 0) return {};
    return "has " + std::to_string(flat) + " triangles without area" + near(corner(first, 0));
  }

  /// Shells and patches, by edges.
  std::string join(double sharp, ClosedSurfaces& result) {
    std::map<std::array<Index, 2>, std::vector<Index>> of_edge;
    for (Index t = 0; t < size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        std::array<Index, 2> edge{triangles_[at(t)][c], triangles_[at(t)][(c + 1) % 3]};
        std::sort(edge.begin(), edge.end());
        of_edge[edge].push_back(t);
      }
    DisjointSets shells(triangles_.size()), patches(triangles_.size());
    Index open = 0, crowded = 0, turned = 0;
    Vec3 first = Vec3::Zero();
    for (const auto& [edge, sides] : of_edge) {
      const bool bad = sides.size() != 2 || same_sense(sides[0], sides[1], edge);
      if (bad && open + crowded + turned == 0) first = 0.5 * (points_[at(edge[0])] + points_[at(edge[1])]);
      (sides.size() < 2 ? open : crowded) += sides.size() == 2 ? 0 : 1;
      turned += sides.size() == 2 && bad ? 1 : 0;
      if (bad) continue;
      shells.join(sides[0], sides[1]);
      const Vec3 a = area_vector(sides[0]), b = area_vector(sides[1]);
      if (a.dot(b) >= std::cos(sharp) * a.norm() * b.norm()) patches.join(sides[0], sides[1]);
    }
    if (open > 0)
      return "the surface is open: " + std::to_string(open) + " edges belong to one triangle only" + near(first);
    if (crowded > 0)
      return "the surface bounds no solid: " + std::to_string(crowded) + " edges belong to more than two triangles" +
             near(first);
    if (turned > 0)
      return "inside and outside cannot be told apart: the triangles at " + std::to_string(turned) +
             " edges face different ways" + near(first);
    result.shell = numbers_of(shells, triangles_.size(), result.num_shells);
    result.patch = numbers_of(patches, triangles_.size(), result.num_patches);
    return {};
  }

  /// Both triangles go along the edge in the same sense.
  [[nodiscard]] bool same_sense(Index a, Index b, const std::array<Index, 2>& edge) const {
    const auto forward = [&](Index t) {
      for (std::size_t c = 0; c < 3; ++c)
        if (triangles_[at(t)][c] == edge[0] && triangles_[at(t)][(c + 1) % 3] == edge[1]) return true;
      return false;
    };
    return forward(a) == forward(b);
  }

  struct Box {
    Vec3 lower, upper;
    Index triangle = 0;
  };
  [[nodiscard]] Box box_of(Index t) const {
    return {corner(t, 0).cwiseMin(corner(t, 1)).cwiseMin(corner(t, 2)),
            corner(t, 0).cwiseMax(corner(t, 1)).cwiseMax(corner(t, 2)), t};
  }

  /// An edge of one triangle goes through the inside of another: looked for among those whose boxes meet.
  [[nodiscard]] std::string crossing() const {
    std::vector<Box> boxes;
    Vec3 lower = box_of(0).lower, upper = box_of(0).upper;
    for (Index t = 0; t < size(); ++t) {
      boxes.push_back(box_of(t));
      lower = lower.cwiseMin(boxes.back().lower), upper = upper.cwiseMax(boxes.back().upper);
    }
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    std::sort(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      return std::pair(a.lower[axis], a.triangle) < std::pair(b.lower[axis], b.triangle);
    });
    std::vector<Box> open;  // those that the sweep is in
    for (const Box& box : boxes) {
      std::erase_if(open, [&](const Box& other) { return other.upper[axis] < box.lower[axis]; });
      for (const Box& other : open) {
        if ((other.upper.array() < box.lower.array()).any() || (box.upper.array() < other.lower.array()).any())
          continue;
        Vec3 place;
        if (cross(box.triangle, other.triangle, place) || cross(other.triangle, box.triangle, place))
          return "the surface goes through itself" + near(place);
      }
      open.push_back(box);
    }
    return {};
  }

  /// An edge of `a` goes through the inside of `b`.
  [[nodiscard]] bool cross(Index a, Index b, Vec3& place) const {
    constexpr double kInside = 1e-9;  // of barycentric coordinates: triangles that touch do not cross
    const Vec3 origin = corner(b, 0), u = corner(b, 1) - origin, v = corner(b, 2) - origin, normal = u.cross(v);
    for (std::size_t c = 0; c < 3; ++c) {
      const Index begin = triangles_[at(a)][c], end = triangles_[at(a)][(c + 1) % 3];
      const auto& corners = triangles_[at(b)];
      if (std::count(corners.begin(), corners.end(), begin) + std::count(corners.begin(), corners.end(), end) > 0)
        continue;
      const Vec3 from = points_[at(begin)] - origin, along = points_[at(end)] - points_[at(begin)];
      const double slope = normal.dot(along);
      if (std::abs(slope) <= kInside * normal.norm() * along.norm()) continue;
      const double t = -normal.dot(from) / slope;
      const Vec3 x = from + t * along;
      const double area = normal.squaredNorm();
      const double beta = x.cross(v).dot(normal) / area, gamma = u.cross(x).dot(normal) / area;
      if (std::min({t, 1 - t, beta, gamma, 1 - beta - gamma}) <= kInside) continue;
      place = origin + x;
      return true;
    }
    return false;
  }

  /// How often shell `s` goes round a point; the sum of solid angles.
  [[nodiscard]] bool around(const std::vector<Index>& triangles, const Vec3& point) const {
    double sum = 0;
    for (const Index t : triangles) {
      const Vec3 a = corner(t, 0) - point, b = corner(t, 1) - point, c = corner(t, 2) - point;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return std::abs(sum) > 2 * std::numbers::pi;
  }

  void nest(ClosedSurfaces& result) const {
    std::vector<std::vector<Index>> of_shell(at(result.num_shells));
    for (Index t = 0; t < size(); ++t) of_shell[at(result.shell[at(t)])].push_back(t);
    std::vector<std::vector<Index>> holders(at(result.num_shells));
    for (Index s = 0; s < result.num_shells; ++s)
      for (Index other = 0; other < result.num_shells; ++other)
        if (other != s && around(of_shell[at(other)], corner(of_shell[at(s)].front(), 0)))
          holders[at(s)].push_back(other);
    std::vector<Index> solid_of(at(result.num_shells), -1);
    for (Index s = 0; s < result.num_shells; ++s) {
      if (holders[at(s)].size() % 2 != 0) continue;
      solid_of[at(s)] = static_cast<Index>(result.solids.size());
      result.solids.push_back({s});
    }
    for (Index s = 0; s < result.num_shells; ++s) {
      if (holders[at(s)].size() % 2 == 0) continue;
      // Of those around it, the innermost lies in all the others.
      const Index innermost = *std::max_element(holders[at(s)].begin(), holders[at(s)].end(), [&](Index a, Index b) {
        return holders[at(a)].size() < holders[at(b)].size();
      });
      result.solids[at(solid_of[at(innermost)])].push_back(s);
    }
  }

  const std::vector<Vec3>& points_;
  const std::vector<std::array<Index, 3>>& triangles_;
};

}  // namespace

ClosedSurfaces take_apart(const SurfaceTriangles& surface, double sharp) { return Surfaces(surface).take_apart(sharp); }

}  // namespace breccia
