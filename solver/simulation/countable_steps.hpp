#pragma once

#include "base/error.hpp"
#include "case/case.hpp"
#include "case/countable.hpp"
#include "model/time_step.hpp"

namespace breccia {

/// Whether the steps of a length can be counted until the end of a stage, and one of them is above the round-off of the
/// time.
/// @param left  s, to the end @param dt  s
[[nodiscard]] inline bool are_countable(double left, double dt) { return left <= case_::kMostSteps * dt; }

/// What is wrong with a stage whose steps are not countable. @param limit  what allows no longer step
[[nodiscard]] Problem uncountable_steps(const case_::Case& input, const case_::Stage& stage, double left, double dt,
                                        const StableStep& limit);

}  // namespace breccia
