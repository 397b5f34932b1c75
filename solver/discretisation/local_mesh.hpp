#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"
#include "discretisation/layout.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// How the elements of a volume group are put together.
enum class Discretisation {
  own_nodes,    ///< every element has four nodes of its own, joints hold them together
  shared_nodes  ///< elements share nodes: an ordinary explicit finite-element body
};

/// Ids of shared nodes start here: above all ids of own nodes.
inline constexpr GlobalId kFirstSharedNode = GlobalId{1} << 40;

/// Id of a shared node. @param set  of the volume groups that share it (model/node_sets.hpp)
[[nodiscard]] constexpr GlobalId shared_node_id(Index set, GlobalId mesh_node) {
  return (1 + GlobalId{set}) * kFirstSharedNode + mesh_node;
}
/// Its node of the mesh.
[[nodiscard]] constexpr GlobalId mesh_node_of(GlobalId shared_node) { return shared_node % kFirstSharedNode; }

/// The discretised model on one rank: everything that stays as it is while nothing breaks. A rank holds originals,
/// which are its own to move and to count, and proxies, elements of other ranks that its originals depend on.
///
/// Elements stand in slots. Slots come in blocks of kLanes; a block holds elements of one volume group only, missing
/// ones are padding (volume 0, mass 1, a unit tetrahedron that feels no force). Blocks of own-node groups come first,
/// those of originals before those of proxies: slot s < num_own_slots has its corners at own_corner_node(s, c); the
/// nodes of shared-node groups follow. Among own-node originals, own-node proxies and shared-node elements (originals
/// and proxies together, for the order in which a node's forces are summed) ascending slots are ascending ids group by
/// group. Shared nodes that an original touches come before those that only proxies touch, in whole blocks.
struct LocalMesh {
  Index num_slots = 0;          ///< elements with padding, a multiple of kLanes
  Index num_own_slots = 0;      ///< of these with their own nodes, a multiple of kLanes
  Index num_own_originals = 0;  ///< of these in blocks of originals, a multiple of kLanes
  Index num_nodes = 0;          ///< with padding, a multiple of kLanes; own nodes first: 4 num_own_slots of them
  Index num_moved_nodes = 0;    ///< own nodes and those shared nodes that originals touch, with padding
  Index num_elements = 0;       ///< without padding, originals and proxies

  std::vector<GlobalId> element_of_slot;  ///< (num_slots) global element id, -1 for padding
  std::vector<Index> mesh_element;        ///< (num_slots) index of the element in the rank's mesh, -1 for padding
  std::vector<Index> slot_of_element;     ///< (elements of the rank's mesh) inverse of the above
  std::vector<std::uint8_t> original;     ///< (num_slots) 1: this rank's own; 0: proxy or padding
  std::vector<std::uint8_t> counted;  ///< (num_nodes) 1: this rank counts the node in sums over the model; each node
                                      ///< is counted by one rank, that of its lowest element; padding by none
  std::vector<Index> block_group;     ///< (num_slots / kLanes) volume group of a block
  std::vector<Index> slot_body;       ///< (num_slots) body, -1 for padding
  std::vector<std::array<Index, 4>> shared_corners;  ///< (num_slots - num_own_slots) nodes of shared-node elements
  std::vector<GlobalId> node_id;                     ///< (num_nodes) 4 element + corner for own nodes,
      ///< shared_node_id for shared ones, -1 for padding

  Field<double> gradient;   ///< [block][9][8] D_m^-1 row-major, 1/m: F = sum_c (x_c - x_0) row c-1 of D_m^-1
  Field<double> volume;     ///< [block][8] reference volume, m3
  Field<double> node_mass;  ///< (num_nodes) kg, lumped: a quarter of each element; 1 for padding
  Field<double> reference;  ///< nodal field: reference positions, m

  std::vector<std::array<Index, 4>>
      vertex;  ///< (num_slots) mesh vertices of the corners: static identity for "shares a
               ///< vertex"; -1 for padding

  [[nodiscard]] Index num_blocks() const { return num_slots / kLanes; }
  [[nodiscard]] Index num_own_blocks() const { return num_own_slots / kLanes; }
  [[nodiscard]] Index num_own_nodes() const { return 4 * num_own_slots; }
  [[nodiscard]] bool is_original(Index slot) const { return original[static_cast<std::size_t>(slot)] != 0; }
  /// Whether this rank computes the motion of a node.
  [[nodiscard]] bool is_moved(Index node) const {
    return node < 4 * num_own_originals || (node >= num_own_nodes() && node < num_moved_nodes);
  }
  [[nodiscard]] Index corner_node(Index slot, int corner) const {
    return slot < num_own_slots
               ? own_corner_node(slot, corner)
               : shared_corners[static_cast<std::size_t>(slot - num_own_slots)][static_cast<std::size_t>(corner)];
  }
  /// Numbers of the corners of a block's elements in a nodal field, [corner][axis][lane]: where they stand if the
  /// elements own their nodes, otherwise gathered into `room`. O(1)
  [[nodiscard]] const double* block_corners(Index block, const double* field, BlockCorners& room) const;
};

/// @param discretisation  (mesh.volume_groups)
/// @param density         (mesh.volume_groups) kg/m3
/// @param original        (mesh elements) 1: this rank's own; empty: all are
/// @param node_sets       (mesh.volume_groups) those of shared nodes have them in common where the numbers, >= 0, are
///                        the same; empty: all have
/// @pre mesh satisfies its invariants (mesh/mesh.hpp)
[[nodiscard]] LocalMesh build_local_mesh(const Mesh& mesh, const std::vector<Discretisation>& discretisation,
                                         const std::vector<double>& density,
                                         const std::vector<std::uint8_t>& original = {},
                                         const std::vector<Index>& node_sets = {});

}  // namespace breccia
