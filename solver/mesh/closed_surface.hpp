#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace breccia {

/// Triangles that bound solids, as an STL file has them. Corners that are one point have one index.
struct SurfaceTriangles {
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
};

/// What a set of closed surfaces is made of.
struct ClosedSurfaces {
  std::vector<Index> shell;  ///< (triangles) connected part, numbered by its first triangle
  std::vector<Index> patch;  ///< (triangles) part without a sharp edge inside, numbered by its first triangle
  /// A solid: its outer shell, then its holes.
  std::vector<std::vector<Index>> solids;
  Index num_shells = 0, num_patches = 0;
  std::string fault;  ///< why they bound no solid, in words; all else is empty then
};

/// Takes surfaces apart into shells, patches and solids. A shell inside an even number of others bounds a solid, one
/// inside an odd number is a hole of the smallest around it. Refused, by `fault`: no triangle, triangles without area,
/// edges of one triangle (the surface is open), of more than two, or of two that face different ways, and triangles
/// that cross others.
/// Triangles that touch in their common plane are not looked for. @param sharp  angle between normals, rad
/// O(n log n) for usual shapes, more where many triangles lie above each other along the longest axis; a winding number
/// for each pair of shells. Throws nothing.
[[nodiscard]] ClosedSurfaces take_apart(const SurfaceTriangles& surface, double sharp);

}  // namespace breccia
