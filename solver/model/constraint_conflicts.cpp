#include "model/constraint_conflicts.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A node of the discretised model, and that of the mesh from which it comes.
struct NamedNode {
  std::int64_t id;
  Index mesh_node;
};

bool operator<(const NamedNode& a, const NamedNode& b) { return a.id < b.id; }

/// The nodes of groups, as nodes_of_group finds them, of a model that need not be discretised.
class GroupNodes {
 public:
  explicit GroupNodes(const Model& model) : model_(model) {}

  /// Ascending, each once.
  const std::vector<NamedNode>& of(const std::string& group) {
    const auto known = nodes_.find(group);
    return known != nodes_.end() ? known->second : nodes_.emplace(group, find(group)).first->second;
  }

 private:
  [[nodiscard]] NamedNode node(Index element, int corner) const {
    const Mesh& mesh = model_.mesh;
    const Index mesh_node = mesh.elements[at(element)][at(corner)];
    const Index group = mesh.element_group[at(element)];
    const bool own = model_.discretisation[at(group)] == Discretisation::own_nodes;
    return {own ? std::int64_t{4} * element + corner : -1 - std::int64_t{mesh_node}, mesh_node};
  }

  [[nodiscard]] std::vector<NamedNode> find(const std::string& group) const {
    const Mesh& mesh = model_.mesh;
    std::vector<NamedNode> nodes;
    const auto volume = std::find(mesh.volume_groups.begin(), mesh.volume_groups.end(), group);
    if (volume != mesh.volume_groups.end()) {
      const auto index = static_cast<Index>(volume - mesh.volume_groups.begin());
      for (Index e = 0; e < mesh.num_elements(); ++e) {
        for (int c = 0; c < 4 && mesh.element_group[at(e)] == index; ++c) nodes.push_back(node(e, c));
      }
    } else {
      const auto surface = std::find(mesh.surface_groups.begin(), mesh.surface_groups.end(), group);
      const auto index = static_cast<Index>(surface - mesh.surface_groups.begin());
      for (const CornerTag& tag : model_.corner_tags) {
        for (int c = 0; c < 4 && tag.group == index; ++c) {
          if ((tag.corners >> c & 1) != 0) nodes.push_back(node(static_cast<Index>(tag.element), c));
        }
      }
    }
    std::sort(nodes.begin(), nodes.end());
    const auto same = [](const NamedNode& a, const NamedNode& b) { return a.id == b.id; };
    nodes.erase(std::unique(nodes.begin(), nodes.end(), same), nodes.end());
    return nodes;
  }

  const Model& model_;
  std::map<std::string, std::vector<NamedNode>> nodes_;
};

Index mesh_nodes_of(const std::vector<NamedNode>& nodes) {
  std::vector<Index> ids;
  for (const NamedNode& node : nodes) ids.push_back(node.mesh_node);
  std::sort(ids.begin(), ids.end());
  return static_cast<Index>(std::unique(ids.begin(), ids.end()) - ids.begin());
}

/// Whether two entries ask for the same along an axis.
bool agree(const case_::Constraint& a, const case_::Constraint& b, std::size_t axis) {
  const TimeFunction &f = a.value[axis], &g = b.value[axis];
  if (f.is_zero() && g.is_zero()) return true;
  return a.kind == b.kind && f == g;
}

}  // namespace

std::vector<ConstraintConflict> constraint_conflicts(const case_::Case& input, const Model& model) {
  std::vector<ConstraintConflict> conflicts;
  GroupNodes nodes(model);
  const auto compare = [&](const case_::Constraint& earlier, const case_::Constraint& later, std::size_t axis) {
    if (!earlier.axes[axis] || !later.axes[axis] || agree(earlier, later, axis)) return;
    const std::vector<NamedNode>&first = nodes.of(earlier.group), &second = nodes.of(later.group);
    std::vector<NamedNode> shared;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(shared));
    if (shared.empty()) return;
    conflicts.push_back({&earlier, &later, static_cast<int>(axis), mesh_nodes_of(shared), mesh_nodes_of(first),
                         shared.size() == first.size()});
  };
  for (const case_::Stage& stage : input.stages) {
    for (std::size_t later = 1; later < stage.constraints.size(); ++later) {
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          compare(stage.constraints[earlier], stage.constraints[later], axis);
      }
    }
  }
  return conflicts;
}

}  // namespace breccia
