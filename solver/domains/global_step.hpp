#pragma once

#include "model/time_step.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// What the step depends on besides the model.
struct StepState {
  const Field<double>& position;                              ///< nodal field, m
  const Field<double>& velocity;                              ///< nodal field, m/s
  const ContactState* contact = nullptr;                      ///< the overlap field; null: no contact yet
  const CornerClusters* clusters = nullptr;                   ///< of contact; null: nothing has broken
  const std::vector<NodalConstraint>* constraints = nullptr;  ///< of the stage; null: none
  MaterialMemory memory{};                                    ///< of laws with memory
  double local_damping = 0;                                   ///< of the stage
};

/// What a step is found from.
struct StepParts {
  std::vector<StepShare> shares;       ///< (num_slots) of elements and joints
  double most = 0;                     ///< 1/s2, of elements and joints of the whole model: the true limit
  std::vector<ContactShare> contacts;  ///< (num_slots), or none
  std::vector<std::uint8_t> open;      ///< (num_slots) bits of faces that have nothing across them, or none
};

[[nodiscard]] StepModel step_model(const TimeStep& time_step, const StepState& state);

/// @param steps  of the true limit without contact, for which bodies may come nearer before the next call
/// Collective.
[[nodiscard]] StepParts step_parts(const Communicator& communicator, const TimeStep& time_step, const StepState& state,
                                   double steps);

/// Stable step of the whole model, s, with what limits it, alike on all ranks (its quantiles are of this rank). A
/// function of the present state alone: exact maxima over ranks, nothing of searches and couples.
/// @param steps  as for step_parts.  Collective. O(elements + patches).
[[nodiscard]] StableStep global_stable_step(const Communicator& communicator, const TimeStep& time_step,
                                            const StepState& state, double steps);

/// Lengths of the step, s, that make no difference to who requests it; 0, 0: none.
struct StepRange {
  double low = 0, high = 0;
};

/// Its length alone, s, bitwise the same, at lower cost: possible contacts are evaluated only where they could still
/// shorten it. Where bounds show that it lies in the range, that costs less still, and range.low is returned.
/// Collective. O(elements + patches)
[[nodiscard]] double global_step_length(const Communicator& communicator, const TimeStep& time_step,
                                        const StepState& state, double steps, const StepRange& range = {});

}  // namespace breccia
