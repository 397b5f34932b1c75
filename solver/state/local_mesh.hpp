#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"
#include "mesh/mesh.hpp"
#include "state/layout.hpp"

namespace breccia {

/// How the elements of a volume group are put together.
enum class Discretisation {
  own_nodes,    ///< every element has four nodes of its own, joints hold them together
  shared_nodes  ///< elements share nodes: an ordinary explicit finite-element body
};

/// The discretised model on one rank: everything that stays as it is while nothing breaks.
///
/// Elements stand in slots. Slots come in blocks of kLanes; a block holds elements of one volume group only, missing
/// ones are padding (volume 0, mass 1, a unit tetrahedron that feels no force). Blocks of own-node groups come first:
/// slot s < num_own_slots has its corners at own_corner_node(s, c); the nodes of shared-node groups follow.
/// Within a group slots follow the global element ids, so ascending slots are ascending ids group by group.
struct LocalMesh {
  Index num_slots = 0;      ///< elements with padding, a multiple of kLanes
  Index num_own_slots = 0;  ///< of these with their own nodes, a multiple of kLanes
  Index num_nodes = 0;      ///< with padding, a multiple of kLanes; own nodes first: 4 num_own_slots of them
  Index num_elements = 0;   ///< without padding

  std::vector<GlobalId> element_of_slot;  ///< (num_slots) global element id, -1 for padding
  std::vector<Index> slot_of_element;     ///< (num elements of the model) on one rank: inverse of the above
  std::vector<Index> block_group;         ///< (num_slots / kLanes) volume group of a block
  std::vector<Index> slot_body;           ///< (num_slots) body, -1 for padding
  std::vector<std::array<Index, 4>> shared_corners;  ///< (num_slots - num_own_slots) nodes of shared-node elements
  std::vector<GlobalId> node_id;          ///< (num_nodes) 4 element + corner for own nodes,
                                          ///< 4 num_elements + mesh node for shared ones, -1 for padding

  Field<double> gradient;    ///< [block][9][8] D_m^-1 row-major, 1/m: F = sum_c (x_c - x_0) row c-1 of D_m^-1
  Field<double> volume;      ///< [block][8] reference volume, m3
  Field<double> node_mass;   ///< (num_nodes) kg, lumped: a quarter of each element; 1 for padding
  Field<double> reference;   ///< nodal field: reference positions, m

  std::vector<std::array<Index, 4>> vertex;  ///< (num_slots) mesh vertices of the corners: static identity for "shares a
                                             ///< vertex"; -1 for padding

  [[nodiscard]] Index num_blocks() const { return num_slots / kLanes; }
  [[nodiscard]] Index num_own_blocks() const { return num_own_slots / kLanes; }
  [[nodiscard]] Index num_own_nodes() const { return 4 * num_own_slots; }
  [[nodiscard]] Index corner_node(Index slot, int corner) const {
    return slot < num_own_slots ? own_corner_node(slot, corner)
                                : shared_corners[static_cast<std::size_t>(slot - num_own_slots)][static_cast<std::size_t>(corner)];
  }
};

/// @param discretisation  (mesh.volume_groups)
/// @param density         (mesh.volume_groups) kg/m3
/// @pre mesh satisfies its invariants (mesh/mesh.hpp)
[[nodiscard]] LocalMesh build_local_mesh(const Mesh& mesh, const std::vector<Discretisation>& discretisation,
                                         const std::vector<double>& density);

}  // namespace breccia
