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
  double force[3][4];     ///< N, by axis on its corners, what acts beside contact included. Of elements with own nodes
};

/// Elements of a step by blocks of slots. What a block stores is prepared when it is first needed: places in many,
/// motions and forces in few. Kept for its storage.
class StepElements {
 public:
  struct Block {
    std::array<StepElement, kLanes> elements;
    Index index;  ///< of the block of slots
    /// Number of the step for which tetra, velocity and curl, force are up to date.
    std::uint64_t prepared_in = 0, moved_in = 0, acted_in = 0;
  };

  StepElements() = default;
  /// Of a mesh of so many slots; nothing is prepared.
  explicit StepElements(Index num_slots) : of_slots_(static_cast<std::size_t>(num_slots / kLanes), nullptr) {}
  StepElements(StepElements&&) = default;
  StepElements& operator=(StepElements&&) = default;
  /// A copy has nothing prepared.
  StepElements(const StepElements& other) : of_slots_(other.of_slots_.size(), nullptr) {}
  StepElements& operator=(const StepElements& other) { return *this = StepElements(other); }
  ~StepElements() = default;

  void begin_step() {
    ++step_;
    used_.clear();
  }
  /// The block with a slot if it has been prepared in this step; otherwise null.
  [[nodiscard]] Block* prepared(Index slot) const {
    Block* block = of_slots_[static_cast<std::size_t>(slot / kLanes)];
    return block != nullptr && block->prepared_in == step_ ? block : nullptr;
  }
  void prefetch(Index slot) const {
    const Block* block = of_slots_[static_cast<std::size_t>(slot / kLanes)];
    if (block == nullptr) return;
    const StepElement& element = block->elements[static_cast<std::size_t>(slot % kLanes)];
    __builtin_prefetch(&element);
    __builtin_prefetch(&element.velocity[0]);
    __builtin_prefetch(&block->prepared_in);
  }
  /// The block with a slot, to be prepared. It stays where it is.
  [[nodiscard]] Block& prepare(Index slot) {
    Block*& block = of_slots_[static_cast<std::size_t>(slot / kLanes)];
    if (block == nullptr) {
      block = &blocks_.emplace_back();
      block->index = slot / kLanes;
    }
    block->prepared_in = step_;
    used_.push_back(block);
    return *block;
  }
  [[nodiscard]] std::uint64_t step() const { return step_; }
  /// Calls f(block) for all blocks whose forces are up to date.
  template <class F>
  void for_each_acted(F&& f) const {
    for (const Block* block : used_) {
      if (block->acted_in == step_) f(*block);
    }
  }

 private:
  std::vector<Block*> of_slots_;  ///< (blocks of slots) null: never needed
  std::deque<Block> blocks_;
  std::vector<Block*> used_;  ///< of this step
  std::uint64_t step_ = 0;
};

}  // namespace breccia
