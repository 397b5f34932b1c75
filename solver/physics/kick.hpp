#pragma once

namespace breccia {

/// Time from v_(n-1/2) to v_(n+1/2), s: the mean of the steps before and after t_n (central differences of variable
/// step). With the step to come alone, every change of it would give or take energy. The first step is from rest.
/// @param before  t_n - t_(n-1), 0 at the start;  @param dt  t_(n+1) - t_n, s
[[nodiscard]] constexpr double kick_length(double before, double dt) { return before > 0 ? 0.5 * (before + dt) : dt; }

}  // namespace breccia
