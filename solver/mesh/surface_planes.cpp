#include "mesh/surface_planes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "mesh/geometry.hpp"

namespace breccia {
namespace {

/// Cosine of the angle between neighbouring faces of one smooth side.
constexpr double kSmooth = 0.866;
/// Of the longest edge: a node so near to a plane lies on it.
constexpr double kOnPlane = 1e-6;

/// A free face seen from an element.
struct SeenFace {
  unsigned set;  ///< corners of the element on it
  Vec3 normal, place;
};

/// Faces around the corners, those with most corners of the element first.
std::vector<SeenFace> faces_around(const Mesh& mesh, const std::array<Index, 4>& corners,
                                   std::span<const FreeFace> faces, const FacesAtNodes& around) {
  std::vector<Index> found;
  for (const Index corner : corners)
    found.insert(found.end(), around.at_node(corner).begin(), around.at_node(corner).end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<SeenFace> seen;
  for (const Index f : found) {
    const FreeFace& face = faces[at(f)];
    SeenFace& here = seen.emplace_back(SeenFace{0, normal_of(mesh, face), mesh.nodes[at(face[0])]});
    for (unsigned c = 0; c < 4; ++c) {
      if (std::find(face.begin(), face.end(), corners[c]) != face.end()) here.set |= 1U << c;
    }
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const SeenFace& a, const SeenFace& b) { return std::popcount(a.set) > std::popcount(b.set); });
  return seen;
}

/// Faces that form one side.
struct Side {
  unsigned set = 0;
  Vec3 normals{0, 0, 0};  ///< sum
  std::vector<SeenFace> faces;

  [[nodiscard]] bool continues_in(const SeenFace& face, double tolerance) const {
    if (!(normals.normalized().dot(face.normal) > kSmooth)) return false;
    return (set & face.set) != 0 || std::abs(face.normal.dot(faces.front().place - face.place)) < tolerance;
  }
  void add(const SeenFace& face) {
    set |= face.set;
    normals += face.normal;
    faces.push_back(face);
  }
  /// m, of a place behind the side; < 0: before it
  [[nodiscard]] double depth(const Vec3& place) const {
    double least = std::numeric_limits<double>::max();
    for (const SeenFace& face : faces) least = std::min(least, face.normal.dot(face.place - place));
    return least;
  }
};

std::vector<Side> sides_beside(const std::vector<SeenFace>& seen, double tolerance) {
  std::vector<Side> sides;
  for (const SeenFace& face : seen) {
    if (std::popcount(face.set) == 3) continue;
    const bool is_own = std::any_of(seen.begin(), seen.end(), [&](const SeenFace& own) {
      return std::popcount(own.set) == 3 && (own.set & face.set) == face.set && own.normal.dot(face.normal) > kSmooth;
    });
    if (is_own) continue;
    auto side =
        std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return s.continues_in(face, tolerance); });
    if (side == sides.end() && sides.size() < kMostSides) side = sides.insert(sides.end(), Side{});
    if (side == sides.end()) {
      side = std::max_element(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
        return a.normals.normalized().dot(face.normal) < b.normals.normalized().dot(face.normal);
      });
    }
    side->add(face);
  }
  return sides;
}

}  // namespace

SurfacePlanes surface_planes(const Mesh& mesh, Index element, std::span<const FreeFace> faces,
                             const FacesAtNodes& around, std::span<const double> depth) {
  const std::array<Index, 4>& corners = mesh.elements[at(element)];
  const std::vector<SeenFace> seen = faces_around(mesh, corners, faces, around);
  if (seen.empty()) return {};
  const auto x = geometry::corners_of(mesh, element);
  double longest = 0;
  for (const Vec3& a : x) {
    for (const Vec3& b : x) longest = std::max(longest, (a - b).norm());
  }
  SurfacePlanes planes;
  for (const Side& side : sides_beside(seen, kOnPlane * longest)) {
    std::array<double, 4> row{}, by_node{};
    for (std::size_t c = 0; c < 4; ++c) {
      if ((side.set >> c & 1U) != 0) continue;
      row[c] = side.depth(x[c]);
      by_node[c] = depth[at(corners[c])];
    }
    if (*std::min_element(row.begin(), row.end()) < -kOnPlane * longest) row = by_node;
    for (double& d : row) d = std::max(d, 0.0);
    const bool is_side = *std::max_element(row.begin(), row.end()) > kOnPlane * longest;
    if (is_side) planes.rows[planes.count++] = row;
  }
  return planes;
}

}  // namespace breccia
