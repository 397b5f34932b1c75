#pragma once

#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// Checks imposed motions: displacements that are not 0 at the start of their stage (for the first stage of a case that
/// starts from a state, see jumps_at), and loads or motions along the axis of a plane model.
[[nodiscard]] std::vector<Problem> validate_motion(const Case& c);

/// Displacements of a stage that are not 0 at the time at which it starts, s: they count from there, so nodes would
/// jump in its first step. What is below 1e-9 of the parts of the function is round-off.
[[nodiscard]] std::vector<Problem> jumps_at(const Case& c, const Stage& stage, double start);

}  // namespace breccia::case_
