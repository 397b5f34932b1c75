#pragma once

#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"

namespace breccia::case_ {

/// What is asked of the motion of nodes and cannot be meant: displacements that are not 0 where their stage starts (of
/// the first stage of a case that starts from a state, see jumps_at), and what acts along the axis of a plane model.
[[nodiscard]] std::vector<Problem> validate_motion(const Case& c);

/// Displacements of a stage that are not 0 at the time at which it starts, s: they count from there, so nodes would
/// jump in its first step. What is below 1e-9 of the parts of the function is round-off.
[[nodiscard]] std::vector<Problem> jumps_at(const Case& c, const Stage& stage, double start);

}  // namespace breccia::case_
