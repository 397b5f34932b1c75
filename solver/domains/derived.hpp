#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "model/model.hpp"
#include "model/stage_loads.hpp"
#include "physics/active_joint.hpp"

namespace breccia {

/// Blocks first .. end - 1.
struct BlockRun {
  Index first, end;
};

/// What a rank computes once from its model and its state and keeps for the steps: no state of its own, rebuilt
/// whenever elements change hands.
struct Derived {
  JointLinks links;                    ///< of the joints that the sweep evaluates
  std::vector<Index> joint_of_face;    ///< (slots, 4) index of the joint, -1: none
  std::vector<std::uint8_t> relevant;  ///< (slots) 1: forces on its nodes are computed here: originals, and elements
                                       ///< with which they share nodes
  std::vector<Index> shared_corners;   ///< [shared block][4][8], as the sweep wants them
  std::vector<Index> shared_blocks;    ///< shared-node blocks with a relevant element
  std::vector<Index> padding_nodes;
  std::vector<double> free_across;    ///< (nodes) 1: moves along the axis of a plane model, 0: does not; or empty
  std::vector<BlockRun> ahead, rest;  ///< own-node blocks of originals: swept before the others, and the others

  [[nodiscard]] bool is_relevant(Index slot) const { return relevant[static_cast<std::size_t>(slot)] != 0; }
  /// -1: none
  [[nodiscard]] Index joint_at(Index slot, int face) const {
    return joint_of_face[static_cast<std::size_t>(slot) * 4 + static_cast<std::size_t>(face)];
  }
};

/// For a state at rest: links of all joints that begin intact.
[[nodiscard]] Derived derive(const Model& model);

/// Whether the face has an intact joint that the sweep evaluates.
[[nodiscard]] bool is_swept(const Model& model, const Derived& derived, Index slot, int face);

/// A joint as it is before its first evaluation, for the active list. @param index  into model.joints
[[nodiscard]] ActiveJoint new_active_joint(const Model& model, std::size_t index);

/// Which blocks are swept ahead of the others on one of several ranks: those with elements that are sent, and those
/// with nodes of constraints and absorbing boundaries, which are applied in one go. Shared nodes are all moved with
/// them.
/// @param sent  (own-node blocks) 1: with an element that another rank waits for
void plan_sweep_order(const Model& model, const StageLoads& loads, const std::vector<std::uint8_t>& sent,
                      Derived& derived);

/// Longest run of blocks, about 0.1 ms: between two runs messages move on, and a reduction needs several such chances
/// before it is done.
inline constexpr Index kLongestRun = 128;

}  // namespace breccia
