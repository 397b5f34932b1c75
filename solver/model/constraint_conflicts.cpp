#include "model/constraint_conflicts.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "base/index.hpp"
#include "model/node_sets.hpp"

namespace breccia {
namespace {

/// The nodes of a group, as nodes_of_group finds them, of a model that need not be discretised.
std::vector<NamedNode> nodes_of(const Model& model, const std::string& group) {
  const Mesh& mesh = model.mesh;
  const auto node = [&](Index element, int corner) {
    const Index set = node_set(model.discretisation, model.whole.node_sets, mesh.element_group[at(element)]);
    return named_node(set, element, corner, mesh.elements[at(element)][at(corner)]);
  };
  std::vector<NamedNode> nodes;
  if (const Index volume = group_index(mesh.volume_groups, group); volume >= 0) {
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int c = 0; c < 4 && mesh.element_group[at(e)] == volume; ++c) nodes.push_back(node(e, c));
    }
  } else {
    const Index of_corners = corner_group(mesh, group);
    for (const CornerTag& tag : model.corner_tags) {
      for (int c = 0; c < 4 && tag.group == of_corners; ++c) {
        if ((tag.corners >> c & 1) != 0) nodes.push_back(node(static_cast<Index>(tag.element), c));
      }
    }
  }
  sort_nodes(nodes);
  return nodes;
}

Index mesh_nodes_of(const std::vector<NamedNode>& nodes) {
  std::vector<std::int64_t> ids;
  ids.reserve(nodes.size());
  for (const NamedNode& node : nodes) ids.push_back(node.mesh_node);
  std::sort(ids.begin(), ids.end());
  return static_cast<Index>(std::unique(ids.begin(), ids.end()) - ids.begin());
}

/// Whether two entries have the same motion along an axis.
bool agree(const case_::Constraint& a, const case_::Constraint& b, std::size_t axis) {
  const TimeFunction &f = a.value[axis], &g = b.value[axis];
  if (f.is_zero() && g.is_zero()) return true;
  return a.kind == b.kind && f == g;
}

/// visit(earlier, later, axis) for entries of a stage with different motions.
template <class Visit>
void for_each_difference(const case_::Case& input, Visit&& visit) {
  for (const case_::Stage& stage : input.stages) {
    for (std::size_t later = 1; later < stage.constraints.size(); ++later) {
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        const case_::Constraint &a = stage.constraints[earlier], &b = stage.constraints[later];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (a.axes[axis] && b.axes[axis] && !agree(a, b, axis)) visit(a, b, axis);
        }
      }
    }
  }
}

}  // namespace

std::vector<std::string> groups_to_compare(const case_::Case& input) {
  std::set<std::string> groups;
  for_each_difference(input, [&](const case_::Constraint& a, const case_::Constraint& b, std::size_t) {
    groups.insert({a.group, b.group});
  });
  return {groups.begin(), groups.end()};
}

void sort_nodes(std::vector<NamedNode>& nodes) {
  const auto same = [](const NamedNode& a, const NamedNode& b) { return a.id == b.id; };
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end(), same), nodes.end());
}

std::vector<ConstraintConflict> constraint_conflicts(const case_::Case& input, const NodesOfGroups& nodes) {
  std::vector<ConstraintConflict> conflicts;
  for_each_difference(input, [&](const case_::Constraint& earlier, const case_::Constraint& later, std::size_t axis) {
    const std::vector<NamedNode>&first = nodes.at(earlier.group), &second = nodes.at(later.group);
    std::vector<NamedNode> shared;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(shared));
    if (shared.empty()) return;
    conflicts.push_back({&earlier, &later, static_cast<int>(axis), mesh_nodes_of(shared), mesh_nodes_of(first),
                         shared.size() == first.size()});
  });
  return conflicts;
}

std::vector<ConstraintConflict> constraint_conflicts(const case_::Case& input, const Model& model) {
  NodesOfGroups nodes;
  for (const std::string& group : groups_to_compare(input)) nodes[group] = nodes_of(model, group);
  return constraint_conflicts(input, nodes);
}

}  // namespace breccia
