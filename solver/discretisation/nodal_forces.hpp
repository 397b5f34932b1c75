#pragma once

#include <array>
#include <vector>

#include "base/field.hpp"
#include "base/types.hpp"
#include "discretisation/layout.hpp"

namespace breccia {

/// Forces on nodes that do not come from the element's own deformation or its intact joints: contact, active joints,
/// pressure. Own-node blocks get storage (96 doubles) only when something acts on them, so the sweep reads nothing for
/// the others; shared nodes have a full nodal field, into which the sweep scatters its internal forces as well. The
/// order in which `add` is called is the order of summation: callers go through joints, then couples, by ascending
/// global ids.
class NodalForces {
 public:
  NodalForces(Index num_own_blocks, Index num_nodes)
      : num_own_nodes_(num_own_blocks * 4 * kLanes),
        slot_(static_cast<std::size_t>(num_own_blocks), -1),
        shared_(static_cast<std::size_t>(num_nodes - num_own_blocks * 4 * kLanes) * 3, 0.0) {}

  /// Forget all forces; storage is kept. O(blocks in use + shared nodes).
  void clear();

  /// Adds a force, N, to a node.
  void add(Index node, const Vec3& force) { add(at(node), force); }
  /// The same at one of places().
  static void add(double* place, const Vec3& force) {
    place[0] += force[0];
    place[8] += force[1];
    place[16] += force[2];
  }

  /// The same of a share of a force.
  static void add(double* place, double share, const Vec3& force) {
    place[0] += share * force[0];
    place[8] += share * force[1];
    place[16] += share * force[2];
  }

  /// Where the forces on some nodes of one element are summed, components kLanes apart: for callers that add as `add`
  /// does. Valid until the next call that is not const.
  template <std::size_t n>
  [[nodiscard]] std::array<double*, n> places(const std::array<Index, n>& nodes) {
    std::array<double*, n> places;
    if (nodes[0] >= num_own_nodes_) {
      for (std::size_t i = 0; i < n; ++i) places[i] = at(nodes[i]);
      return places;
    }
    double* block = own_block(static_cast<std::size_t>(nodes[0]) / kBlockNodes);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t node = static_cast<std::size_t>(nodes[i]) % kBlockNodes;
      places[i] = block + node / kWidth * (3 * kWidth) + node % kWidth;
    }
    return places;
  }
  /// The same for the corners of an element that owns its nodes, of which corner 0 is given.
  [[nodiscard]] std::array<double*, 4> own_places(Index corner) {
    const auto node = static_cast<std::size_t>(corner);
    double* first = own_block(node / kBlockNodes) + node % kWidth;
    return {first, first + 3 * kWidth, first + 6 * kWidth, first + 9 * kWidth};
  }

  [[nodiscard]] Vec3 get(Index node) const;

  /// 96 doubles [corner][axis][lane] of an own-node block, or nullptr when nothing acts on it.
  [[nodiscard]] const double* block(Index own_block) const {
    const Index s = slot_[static_cast<std::size_t>(own_block)];
    return s < 0 ? nullptr : own_.data() + static_cast<std::size_t>(s) * 96;
  }
  /// The same of a block on which something is going to act. Valid until the next call that is not const.
  [[nodiscard]] double* acted_block(Index own_block) { return this->own_block(static_cast<std::size_t>(own_block)); }
  /// Slot of each own-node block, -1: none; and the storage they index, 96 doubles each. For the sweep.
  [[nodiscard]] const Index* slots() const { return slot_.data(); }
  [[nodiscard]] const double* own() const { return own_.data(); }
  /// Nodal field of the shared nodes, from node num_own_nodes on.
  [[nodiscard]] double* shared() { return shared_.data(); }

 private:
  static constexpr std::size_t kWidth = kLanes, kBlockNodes = 4 * kWidth;

  double* at(Index node) {
    if (node >= num_own_nodes_) return shared_.data() + nodal(node - num_own_nodes_, 0);
    return own_block(static_cast<std::size_t>(node) / kBlockNodes) + nodal(node % (4 * kLanes), 0);
  }
  double* own_block(std::size_t block) {
    Index& slot = slot_[block];
    if (slot < 0) slot = take_slot(static_cast<Index>(block));
    return own_.data() + static_cast<std::size_t>(slot) * 96;
  }
  Index take_slot(Index block);

  Index num_own_nodes_;
  std::vector<Index> slot_;
  std::vector<Index> used_;  ///< blocks with a slot, by slot
  Field<double> own_;
  Field<double> shared_;
};

}  // namespace breccia
