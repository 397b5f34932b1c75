#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace breccia {

/// What was found and done while a mesh was made ready; for the report of `check` and `mesh`.
struct MeshReport {
  Index nodes = 0;  ///< of the finished mesh
  Index elements = 0;
  Index bodies = 0;
  Index inverted_repaired = 0;   ///< elements whose corners were listed with the opposite sense
  Index orphan_nodes = 0;        ///< nodes of no element, dropped
  Index split_nodes = 0;         ///< nodes added because volumes that are not glued shared them
  Index merged_nodes = 0;        ///< nodes that became an earlier one near to them
  Index duplicate_nodes = 0;     ///< nodes read that coincide with an earlier one: within 1e-9 of the mesh's size
  Index ungrouped_elements = 0;  ///< tetrahedra outside every physical volume, left out

  struct Group {
    std::string name;
    Index count = 0;
  };
  std::vector<Group> volume_groups;       ///< elements of each
  std::vector<Group> surface_groups;      ///< triangles of each
  std::vector<Group> node_groups;         ///< nodes of each
  std::vector<Group> element_sets;        ///< elements of each physical volume that carries no material
  std::vector<std::string> empty_groups;  ///< of any kind, of the file, without an element or a node of one: left out
  std::vector<std::string> notes;         ///< what was made of the file beyond reading it, a sentence each
};

struct FinishedMesh {
  Mesh mesh;
  MeshReport report;
};

struct FinishOptions {
  bool glue = false;            ///< volumes keep the nodes they share; false: every volume gets its own
  bool repair_inverted = true;  ///< swap two corners of elements of negative volume; false refuses them
  double merge_nodes = 0;       ///< m, along each axis: nodes so near to an earlier one become it (join_near_nodes)
};

/// Gives a mesh as read the invariants of `Mesh`: positive volumes, no orphan nodes, own nodes for every volume (unless
/// glued), no group without element or node, bodies (mesh/bodies.hpp, nothing cut), elements sorted by (volume group,
/// Hilbert rank of the centroid, old index), nodes in the order in which the elements first touch them. A surface
/// triangle between two volumes that are parted is kept once for each. The order depends on coordinates only through
/// the centroid's cell in a grid of 2^20 cells an axis. O(n log n), deterministic. Throws InputError with every
/// problem: no element, coordinates that are not finite, elements of zero volume (|V| <= 1e-10 of the longest edge
/// cubed) or, where they are not repaired, of negative volume (first 10 source ids and the count), surface triangles
/// that are no face of any element, elements that would collapse as nodes are merged, more elements than an Index can
/// number the corners of; those of build_topology.
/// @pre node, group and body indices are valid.
[[nodiscard]] FinishedMesh finish_mesh(Mesh raw, const FinishOptions& options);

}  // namespace breccia
