#pragma once

#include <span>
#include <vector>

#include "mesh/corner_sets.hpp"
#include "mesh/faces_at_nodes.hpp"
#include "mesh/free_faces.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// Sides of the free surface that an element meets with an edge or a corner, beside its own free faces.
struct SurfacePlanes {
  std::size_t count = 0;  ///< of rows
  SideRows rows{};        ///< m, how far the corners lie behind each side
};

/// Neighbouring faces whose normals differ by less than 30 degrees are one side: a row has the least of the distances
/// to their planes, so it is exact where the side is flat. A side that its own free face continues has no row. Where
/// the body reaches before a side, as at a reentrant edge, the distance is not that to its plane: the row has the
/// depths of the nodes. Sides of edges come first; where there are more than kMostSides sides, a further face counts to
/// the one whose direction is nearest to its own.
/// @param faces   all free faces; `around` is made of them;  @param depth  (mesh nodes) m. O(faces around^2)
[[nodiscard]] SurfacePlanes surface_planes(const Mesh& mesh, Index element, std::span<const FreeFace> faces,
                                           const FacesAtNodes& around, std::span<const double> depth);

}  // namespace breccia
