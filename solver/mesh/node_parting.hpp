#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace breccia {

/// Steps of `finish_mesh` that concern shared nodes; indices as read, elements unsorted. All O(num_elements).

/// Nodes of no element.
[[nodiscard]] Index count_orphan_nodes(const Mesh& mesh);

/// (nodes) The first node within 1e-9 of the mesh's size (largest extent) of each node, along each axis: itself where
/// there is none before it. Nodes of no element count for none.
[[nodiscard]] std::vector<Index> coincident_nodes(const Mesh& mesh);

/// Every node becomes the first one of those up to `distance` from it, m, along each axis: of its own volume, or of any
/// where `across_volumes`. Surface triangles and nodes of curves and points follow. Returns how many nodes became
/// another one. A node of several volumes that share it already counts as one of the volume that names it first.
Index join_near_nodes(Mesh& mesh, double distance, bool across_volumes);

/// Nodes that have one before them there.
[[nodiscard]] Index count_duplicate_nodes(const Mesh& mesh);

/// What is wrong with a surface whose triangles are no face of any element, and what is allowed.
inline constexpr const char* kStrayTriangles = "holds triangles that are no face of any element";
inline constexpr const char* kFacesOfVolumes =
    "faces of meshed physical volumes; triangles are none where a line ends inside an extruded surface (cut the "
    "surface in two along the line and on from its tip to the border, away from the expected crack, and set "
    "mesh.glue), or where two surfaces with a common edge are extruded by two Extrude commands, each of which makes "
    "the face between them (extrude both in one command)";

/// Throws InputError, one problem a surface group, when a surface triangle is no face of any element.
void demand_surfaces_are_faces(const Mesh& mesh);

/// Gives every body nodes of its own. A surface triangle that is a face of several bodies becomes one for each, the
/// body of lowest index first. Returns how many nodes were added.
Index part_bodies(Mesh& mesh);

}  // namespace breccia
