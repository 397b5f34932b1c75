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
  std::vector<Index>
      twin;  ///< (triangles) the same triangle that faces the other way, of a shell that touches; -1: none
  /// A solid: its outer shell, then those inside that bound it: its holes, and the solids that are cut out of it.
  std::vector<std::vector<Index>> solids;
  /// A solid inside another, which has no hole there: the other is cut by it.
  struct Inclusion {
    Index inner, outer;  ///< indices into `solids`
  };
  std::vector<Inclusion> inclusions;
  Index num_holes = 0;
  std::string mismatch;  ///< where shells touch along a face that each cuts into other triangles; empty: nowhere
  Index num_shells = 0, num_patches = 0;
  std::string fault;  ///< why they bound no solid, in words; all else is empty then
};

/// Takes surfaces apart into shells, patches and solids. A shell that faces the way of the outermost around it bounds a
/// solid, which is cut out of the solid that it lies in; one that faces the other way is a hole of the smallest solid
/// around it. Solids that touch share edges: the triangles around an edge belong together in pairs with solid between.
/// Refused, by `fault`: no triangle, triangles without area, edges of one triangle (the surface is open), of triangles
/// that do not alternate around it, or of two that face different ways, a shell that touches itself along a face, and
/// triangles that cross others.
/// Triangles that touch in their common plane without a common edge are not searched for.
/// @param sharp  angle between normals, rad
/// O(n log n) for usual shapes, more where many triangles lie above each other along the longest axis; a winding number
/// for each pair of shells. Throws nothing.
[[nodiscard]] ClosedSurfaces take_apart(const SurfaceTriangles& surface, double sharp);

}  // namespace breccia
