#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace breccia {

/// The model as meshed, whole on the rank that reads it, or the piece of it that a rank works on. Lengths in m.
///
/// Invariants after `finish_mesh` (mesh/finish.hpp): every element has a positive volume, every node belongs to an
/// element, volumes that are not glued share no node, elements are sorted by (volume group, space-filling rank of the
/// centroid), bodies are what holds together (mesh/bodies.hpp); as read, before that, every volume is a body. In the
/// whole mesh an element's index is its global id; a piece keeps the ids of its elements and nodes, both ascending, so
/// that the order of indices is the order of ids there as well.
struct Mesh {
  std::string source;  ///< file or generator, for messages

  std::vector<Vec3> nodes;                      ///< (num_nodes) reference position
  std::vector<std::array<Index, 4>> elements;   ///< (num_elements) corners, positively oriented
  std::vector<Index> element_group;             ///< (num_elements) index into volume_groups
  std::vector<Index> element_body;              ///< (num_elements) 0..num_bodies-1 (mesh/bodies.hpp)
  std::vector<Index> element_volume;            ///< (num_elements) volume of the geometry; empty: a piece, or as read
  std::vector<std::int64_t> element_source_id;  ///< (num_elements) id in the file, for messages
  std::vector<GlobalId> element_ids;            ///< (num_elements) ascending; empty: the whole mesh
  std::vector<GlobalId> node_ids;               ///< (num_nodes) ascending; empty: the whole mesh

  /// Triangle of a physical surface. `nodes` need not be oriented.
  struct SurfaceFace {
    std::array<Index, 3> nodes;
    Index group;  ///< index into surface_groups
  };
  std::vector<SurfaceFace> surface_faces;

  /// Node of a physical curve or point.
  struct GroupNode {
    Index node;
    Index group;  ///< index into node_groups
  };
  std::vector<GroupNode> group_nodes;

  /// Element of a physical volume that carries no material.
  struct SetElement {
    Index element;
    Index group;  ///< index into element_sets
  };
  std::vector<SetElement> set_elements;  ///< by (group, element); empty in a piece, whose corner tags have them

  std::vector<std::string> volume_groups;  ///< physical volumes that carry a material: an element is in one of them
  std::vector<std::string> surface_groups;
  std::vector<std::string> node_groups;   ///< physical curves and points; those of one name are one group
  std::vector<std::string> element_sets;  ///< physical volumes that carry no material and may overlap
  Index num_bodies = 0;

  [[nodiscard]] Index num_elements() const { return static_cast<Index>(elements.size()); }
  [[nodiscard]] Index num_nodes() const { return static_cast<Index>(nodes.size()); }
  [[nodiscard]] GlobalId element_id(Index element) const {
    return element_ids.empty() ? element : element_ids[static_cast<std::size_t>(element)];
  }
  /// Index of the element with this id, -1: not here. O(log elements).
  [[nodiscard]] Index element_with(GlobalId id) const {
    if (element_ids.empty()) return id < num_elements() ? static_cast<Index>(id) : -1;
    const auto found = std::lower_bound(element_ids.begin(), element_ids.end(), id);
    return found != element_ids.end() && *found == id ? static_cast<Index>(found - element_ids.begin()) : -1;
  }
  /// Volume of the geometry that an element is part of. @pre the whole mesh
  [[nodiscard]] Index volume_of(Index element) const {
    const auto e = static_cast<std::size_t>(element);
    return element_volume.empty() ? element_body[e] : element_volume[e];
  }
  [[nodiscard]] GlobalId node_id(Index node) const {
    return node_ids.empty() ? node : node_ids[static_cast<std::size_t>(node)];
  }
};

/// Index of a group by its name; -1: there is none. @param names  of groups of one kind
[[nodiscard]] inline Index group_index(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<Index>(found - names.begin());
}

/// Groups that consist of corners of elements: the surface groups, then the node groups, then the element sets. Index
/// of one by its name; -1: there is none. @param groups  with all three, as Mesh has them
template <class Groups>
[[nodiscard]] Index corner_group(const Groups& groups, const std::string& name) {
  if (const Index surface = group_index(groups.surface_groups, name); surface >= 0) return surface;
  const auto surfaces = static_cast<Index>(groups.surface_groups.size());
  const auto nodes = static_cast<Index>(groups.node_groups.size());
  if (const Index set = group_index(groups.element_sets, name); set >= 0) return surfaces + nodes + set;
  const Index of_nodes = group_index(groups.node_groups, name);
  return of_nodes < 0 ? -1 : surfaces + of_nodes;
}

/// Nodes of a triangle, ascending: the same from both sides.
[[nodiscard]] inline std::array<Index, 3> sorted(std::array<Index, 3> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace breccia
