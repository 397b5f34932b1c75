#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "discretisation/blocks.hpp"
#include "physics/contact/geometry/tetra.hpp"

namespace breccia {

/// What one step of contact reads of an element and adds to it, side by side in memory: an element is in many couples,
/// and in the nodal fields its numbers lie in twelve cache lines each.
struct alignas(64) StepElement {
  PreparedTetra tetra;
  double velocity[4][3];  ///< m/s, of its corners
  double curl[3];         ///< 1/s, of its velocities; 0 of an inert one
  double force[4][3];     ///< N, on its corners, what acts beside contact included. Of elements with own nodes
};

/// Elements of a step by blocks of slots, each prepared when one of them is first needed. Kept for its storage.
struct StepElements {
  using Block = std::array<StepElement, kLanes>;
  std::vector<Index> place;      ///< (blocks of slots) index into `blocks`, -1: never needed
  std::deque<Block> blocks;      ///< in the order in which they were first needed; stay where they are
  std::vector<std::uint64_t> prepared_in;  ///< (blocks) number of the step, as `step`
  std::vector<std::uint64_t> acted_in;     ///< (blocks) likewise: when a force was last added
  std::vector<Index> used;       ///< of this step: blocks of slots
  std::uint64_t step = 0;        ///< counts from 1
};

}  // namespace breccia
