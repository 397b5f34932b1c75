#include "mesh/closed_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"

namespace breccia {
namespace {

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
    if (!result.fault.empty()) {
      ClosedSurfaces none;
      none.fault = result.fault;
      return none;
    }
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
    find_twins(result);
    const bool inside_out = volume_of_all() < 0;
    DisjointSets shells(triangles_.size()), patches(triangles_.size());
    Index open = 0, crowded = 0, turned = 0;
    Vec3 first = Vec3::Zero();
    for (auto& [edge, sides] : of_edge) {
      const bool two = sides.size() == 2;
      const bool bad = two ? same_sense(sides[0], sides[1], edge)
                           : sides.size() % 2 != 0 || !pair_up(edge, sides, inside_out, result);
      if (bad && open + crowded + turned == 0) first = 0.5 * (points_[at(edge[0])] + points_[at(edge[1])]);
      (sides.size() < 2 ? open : crowded) += bad && !two ? 1 : 0;
      turned += two && bad ? 1 : 0;
      if (bad) continue;
      for (std::size_t i = 0; i < sides.size(); i += 2) {
        shells.join(sides[i], sides[i + 1]);
        const Vec3 a = area_vector(sides[i]), b = area_vector(sides[i + 1]);
        if (a.dot(b) >= std::cos(sharp) * a.norm() * b.norm()) patches.join(sides[i], sides[i + 1]);
      }
    }
    if (open > 0)
      return "the surface is open: " + std::to_string(open) + " edges belong to one triangle only" + near(first);
    if (crowded > 0)
      return "the surface bounds no solid: " + std::to_string(crowded) + " edges belong to more than two triangles" +
             near(first);
    if (turned > 0)
      return "inside and outside cannot be distinguished: the triangles at " + std::to_string(turned) +
             " edges face different ways" + near(first);
    result.shell = numbers_of(shells, triangles_.size(), result.num_shells);
    result.patch = numbers_of(patches, triangles_.size(), result.num_patches);
    for (Index t = 0; t < size(); ++t)
      if (const Index other = result.twin[at(t)]; other >= 0 && result.shell[at(t)] == result.shell[at(other)])
        return "a solid touches itself along a face" + near(corner(t, 0));
    return {};
  }

  /// Triangles of the same corners that face different ways.
  void find_twins(ClosedSurfaces& result) const {
    result.twin.assign(triangles_.size(), -1);
    std::map<std::array<Index, 3>, Index> first;
    for (Index t = 0; t < size(); ++t) {
      std::array<Index, 3> corners = triangles_[at(t)];
      std::sort(corners.begin(), corners.end());
      const auto [entry, fresh] = first.emplace(corners, t);
      const Index other = entry->second;
      if (fresh || result.twin[at(other)] >= 0 || area_vector(t).dot(area_vector(other)) > 0) continue;
      result.twin[at(t)] = other;
      result.twin[at(other)] = t;
    }
  }

  [[nodiscard]] double volume_of_all() const {
    double sum = 0;
    for (Index t = 0; t < size(); ++t) sum += volume_below(t);
    return sum;
  }
  /// Of the tetrahedron between a triangle and the first point, m3; positive where the triangle faces away from it.
  [[nodiscard]] double volume_below(Index t) const { return area_vector(t).dot(corner(t, 0) - points_[0]) / 3; }

  /// Sorts the triangles around an edge of several solids so that each two that follow each other have solid between
  /// them. False where they do not alternate.
  bool pair_up(const std::array<Index, 2>& edge, std::vector<Index>& sides, bool inside_out, ClosedSurfaces& result) {
    constexpr double kSameAngle = 1e-6, kTurn = 2 * std::numbers::pi;  // triangles of one plane, to single precision
    const Vec3 origin = points_[at(edge[0])], along = (points_[at(edge[1])] - origin).normalized();
    const auto across = [&](Index t) {
      for (const Index n : triangles_[at(t)])
        if (n != edge[0] && n != edge[1]) {
          const Vec3 x = points_[at(n)] - origin;
          return Vec3((x - x.dot(along) * along).normalized());
        }
      return Vec3(Vec3::Zero());
    };
    struct Side {
      double angle;
      bool begins;  ///< solid is at larger angles
      Index triangle;
    };
    std::vector<Side> around;
    const Vec3 zero = across(sides[0]), quarter = along.cross(zero);
    for (const Index t : sides) {
      const Vec3 x = across(t);
      double angle = std::atan2(x.dot(quarter), x.dot(zero));
      if (angle < -kSameAngle) angle += kTurn;
      around.push_back({angle, goes_along(t, edge) == inside_out, t});
    }
    std::sort(around.begin(), around.end(), [](const Side& a, const Side& b) {
      return std::pair(a.angle, a.triangle) < std::pair(b.angle, b.triangle);
    });
    // Of two at one angle the solid of one ends before that of the other begins.
    for (std::size_t i = 1; i < around.size(); ++i) {
      if (around[i].angle - around[i - 1].angle > kSameAngle) continue;
      if (around[i - 1].begins && !around[i].begins)
        std::swap(around[i - 1].triangle, around[i].triangle), std::swap(around[i - 1].begins, around[i].begins);
      if (result.twin[at(around[i].triangle)] != around[i - 1].triangle && result.mismatch.empty())
        result.mismatch = near(0.5 * (origin + points_[at(edge[1])]));
    }
    if (!around[0].begins) std::rotate(around.begin(), around.begin() + 1, around.end());
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (around[i].begins != (i % 2 == 0)) return false;
      sides[i] = around[i].triangle;
    }
    return true;
  }

  [[nodiscard]] bool goes_along(Index t, const std::array<Index, 2>& edge) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (triangles_[at(t)][c] == edge[0] && triangles_[at(t)][(c + 1) % 3] == edge[1]) return true;
    return false;
  }

  /// Both triangles go along the edge in the same sense.
  [[nodiscard]] bool same_sense(Index a, Index b, const std::array<Index, 2>& edge) const {
    return goes_along(a, edge) == goes_along(b, edge);
  }

  struct Box {
    Vec3 lower, upper;
    Index triangle = 0;
  };
  [[nodiscard]] Box box_of(Index t) const {
    return {corner(t, 0).cwiseMin(corner(t, 1)).cwiseMin(corner(t, 2)),
            corner(t, 0).cwiseMax(corner(t, 1)).cwiseMax(corner(t, 2)), t};
  }

  /// An edge of one triangle goes through the inside of another: searched among those whose boxes meet.
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

  /// A shell and where it lies.
  struct Shell {
    std::vector<Index> triangles;
    double volume = 0;              ///< negative where it faces inwards
    Vec3 inside = Vec3::Zero();     ///< a point close behind its largest triangle
    std::vector<Index> containers;  ///< larger shells around that point
    Index parent = -1;              ///< the innermost of them
    bool solid = true;              ///< it bounds one; else it is a hole
  };

  [[nodiscard]] std::vector<Shell> shells_of(const ClosedSurfaces& result) const {
    constexpr double kClose = 1e-6;   // of the size of the triangle: nearer than any other shell
    constexpr double kLarger = 1e-9;  // of the volume: shells that coincide are not inside each other
    std::vector<Shell> shells(at(result.num_shells));
    for (Index t = 0; t < size(); ++t) {
      Shell& shell = shells[at(result.shell[at(t)])];
      shell.triangles.push_back(t);
      shell.volume += volume_below(t);
    }
    for (Shell& shell : shells) {
      const Index t = *std::max_element(shell.triangles.begin(), shell.triangles.end(), [&](Index a, Index b) {
        return area_vector(a).squaredNorm() < area_vector(b).squaredNorm();
      });
      const double area = area_vector(t).norm(), depth = (shell.volume < 0 ? -1 : 1) * kClose * std::sqrt(area);
      shell.inside = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3 - depth / area * area_vector(t);
    }
    for (Shell& shell : shells)
      for (Index other = 0; other < result.num_shells; ++other)
        if (std::abs(shells[at(other)].volume) > (1 + kLarger) * std::abs(shell.volume) &&
            around(shells[at(other)].triangles, shell.inside))
          shell.containers.push_back(other);
    return shells;
  }

  /// Which shells bound solids, from the outermost inwards.
  void sort_out(std::vector<Shell>& shells) const {
    std::vector<Index> order(shells.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return shells[at(a)].containers.size() < shells[at(b)].containers.size();
    });
    for (const Index s : order) {
      Shell& shell = shells[at(s)];
      if (shell.containers.empty()) continue;
      const auto depth = [&](Index c) { return std::pair(shells[at(c)].containers.size(), shells[at(c)].solid); };
      shell.parent = *std::max_element(shell.containers.begin(), shell.containers.end(),
                                       [&](Index a, Index b) { return depth(a) < depth(b); });
      Index root = shell.parent;
      while (shells[at(root)].parent >= 0) root = shells[at(root)].parent;
      const bool same_way = (shell.volume < 0) == (shells[at(root)].volume < 0);
      shell.solid = same_way || !shells[at(shell.parent)].solid;  // a hole in a hole is none
    }
  }

  void nest(ClosedSurfaces& result) const {
    std::vector<Shell> shells = shells_of(result);
    sort_out(shells);
    std::vector<Index> solid_of(shells.size(), -1);
    for (Index s = 0; s < result.num_shells; ++s) {
      if (!shells[at(s)].solid) continue;
      solid_of[at(s)] = static_cast<Index>(result.solids.size());
      result.solids.push_back({s});
    }
    // A hole that a solid fills exactly is around that solid, and no larger.
    const auto fills_hole = [&](const Shell& shell) {
      return std::any_of(shells.begin(), shells.end(), [&](const Shell& other) {
        return !other.solid && other.parent == shell.parent && around(other.triangles, shell.inside);
      });
    };
    for (Index s = 0; s < result.num_shells; ++s) {
      const Shell& shell = shells[at(s)];
      if (shell.parent < 0 || !shells[at(shell.parent)].solid || (shell.solid && fills_hole(shell))) continue;
      const Index outer = solid_of[at(shell.parent)];
      result.solids[at(outer)].push_back(s);
      if (shell.solid)
        result.inclusions.push_back({solid_of[at(s)], outer});
      else
        ++result.num_holes;
    }
  }

  const std::vector<Vec3>& points_;
  const std::vector<std::array<Index, 3>>& triangles_;
};

}  // namespace

ClosedSurfaces take_apart(const SurfaceTriangles& surface, double sharp) { return Surfaces(surface).take_apart(sharp); }

}  // namespace breccia
