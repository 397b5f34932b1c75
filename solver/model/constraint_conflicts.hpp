#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "discretisation/local_mesh.hpp"
#include "model/model.hpp"

namespace breccia {

/// Two entries of a stage with different motions of the same nodes along an axis; the later one applies.
struct ConstraintConflict {
  const case_::Constraint* earlier;
  const case_::Constraint* later;
  int axis;
  Index shared = 0;  ///< nodes of the mesh that both name
  Index of_earlier = 0;
  bool whole = false;  ///< the later entry leaves nothing of the earlier one on this axis
};

/// A node of the discretised model, and that of the mesh from which it comes.
struct NamedNode {
  std::int64_t id;
  std::int64_t mesh_node;
  friend bool operator<(const NamedNode& a, const NamedNode& b) { return a.id < b.id; }
};
/// @param set  of the element's group (node_set of node_sets.hpp);  @param mesh_node  of the corner
[[nodiscard]] inline NamedNode named_node(Index set, std::int64_t element, int corner, std::int64_t mesh_node) {
  return {set < 0 ? 4 * element + corner : shared_node_id(set, mesh_node), mesh_node};
}

/// Nodes of groups by name; by their ids ascending, each once.
using NodesOfGroups = std::map<std::string, std::vector<NamedNode>>;

/// Volume and surface groups with different motions along an axis in two entries of a stage: only if they share nodes
/// do these conflict.
[[nodiscard]] std::vector<std::string> groups_to_compare(const case_::Case& input);

/// Brings nodes of a group into order.
void sort_nodes(std::vector<NamedNode>& nodes);

/// As below, of a model that is known by its nodes only. @param nodes  of all groups_to_compare
[[nodiscard]] std::vector<ConstraintConflict> constraint_conflicts(const case_::Case& input,
                                                                   const NodesOfGroups& nodes);

/// By stage, later entry, earlier entry, axis. Entries with the same motion do not conflict. O(corners log corners) for
/// each entry of a pair that could.
/// @param model  of the whole mesh; a bare one will do. The result points into `input`.
[[nodiscard]] std::vector<ConstraintConflict> constraint_conflicts(const case_::Case& input, const Model& model);

}  // namespace breccia
