#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/mesh.hpp"
#include "mesh/tetrahedron.hpp"

namespace breccia::geometry {

/// Signed volume of a tetrahedron, m3: (b-a) x (c-a) . (d-a) / 6; positive when a, b, c turn counter-clockwise seen
/// from outside the face opposite to d, the orientation of `Mesh::elements`.
[[nodiscard]] inline double tetra_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

/// Area of a triangle, m2.
[[nodiscard]] inline double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

/// Radius of the sphere that touches all four faces, m: 3 V / sum of the areas.
[[nodiscard]] inline double inradius(const std::array<Vec3, 4>& x) {
  double area = 0;
  for (const auto& f : kFaceCorners) {
    const auto corner = [&](std::size_t i) { return x[static_cast<std::size_t>(f[i])]; };
    area += triangle_area(corner(0), corner(1), corner(2));
  }
  return 3 * tetra_volume(x[0], x[1], x[2], x[3]) / area;
}

/// Height of a corner above the opposite face, m.
[[nodiscard]] inline double height(const std::array<Vec3, 4>& x, int corner) {
  const auto& f = kFaceCorners[static_cast<std::size_t>(corner)];
  const auto at = [&](std::size_t i) { return x[static_cast<std::size_t>(f[i])]; };
  return 3 * tetra_volume(x[0], x[1], x[2], x[3]) / triangle_area(at(0), at(1), at(2));
}

/// Corners of an element, m.
[[nodiscard]] inline std::array<Vec3, 4> corners_of(const Mesh& mesh, Index element) {
  const auto& e = mesh.elements[static_cast<std::size_t>(element)];
  const auto at = [&](Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  return {at(e[0]), at(e[1]), at(e[2]), at(e[3])};
}

/// Area of a face, m2.
[[nodiscard]] inline double face_area(const Mesh& mesh, Index element, int face) {
  const auto x = corners_of(mesh, element);
  const auto& f = kFaceCorners[static_cast<std::size_t>(face)];
  const auto corner = [&](std::size_t i) { return x[static_cast<std::size_t>(f[i])]; };
  return triangle_area(corner(0), corner(1), corner(2));
}

/// The six edges of a tetrahedron as pairs of corners; edge i and edge 5 - i share no corner.
inline constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// m, of the tetrahedron.
[[nodiscard]] inline double longest_edge(const std::array<Vec3, 4>& x) {
  double square = 0;
  for (const auto& [a, b] : kEdges)
    square = std::max(square, (x[static_cast<std::size_t>(a)] - x[static_cast<std::size_t>(b)]).squaredNorm());
  return std::sqrt(square);
}

}  // namespace breccia::geometry
