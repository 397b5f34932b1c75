#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/surface_sides.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// What a whole model at rest knows of its free surface: what the overlap field of contact is made of
/// (physics/contact/geometry/field.hpp).
struct SurfaceDepth {
  std::vector<std::uint8_t> on_surface;  ///< (mesh nodes) 1: a corner of a free face
  std::vector<double> depth;             ///< (mesh nodes) m, > 0
  std::vector<Vec3> normal;         ///< (mesh nodes) mean outward normal; its length is 1 where the surface is flat
  std::vector<SurfaceSides> sides;  ///< (elements) that each meets
  std::vector<SideRows> planes;     ///< (elements) distances to those but its own faces (mesh/surface_planes.hpp)
};

/// The depth of a node of what can break is the least of its heights in its elements: no face that may become one of
/// the surface is nearer, nor much farther.
///
/// Elsewhere the depth of a node inside is its distance to the free surface (mesh/point_distance.hpp). That of a node
/// on the surface is how much lies behind it: the least of its heights above opposite free faces of its elements and of
/// its distances to free faces that it lies behind by half its distance at least (the other side of a wall, the far
/// side of a ridge); where there is none of these nearer than its longest edge, the least of its heights.
///
/// The mean normal of a node weights each free face with its angle there, so it does not depend on how the surface is
/// cut into triangles: of a straight edge between two faces at a right angle it is sqrt(1/2) long. Zero inside.
/// O(n log n) in the free faces, throws nothing.
/// @param breakable  (volume groups) inner faces may be freed
/// @pre mesh is finished, topology belongs to it
[[nodiscard]] SurfaceDepth surface_depth(const std::vector<bool>& breakable, const Mesh& mesh,
                                         const Topology& topology);

}  // namespace breccia
