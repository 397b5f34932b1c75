#pragma once

#include "physics/stable_step.hpp"

namespace breccia {

/// y = K u of the model at rest, N: Hooke elements f_a = V (lambda tr e I + 2 mu e) g_a, intact joints k A0/3 (u -
/// u_other) on each corner; with mid-edge points half of each corner's opening and a quarter of the other two's. u, y:
/// nodal fields, as Field aligns them. O(elements).
void stiffness_action(const StepModel& model, const double* u, double* y);

/// Upper estimate of the largest eigenvalue of M^-1 K, 1/s2: largest Ritz value of a Lanczos iteration plus its
/// residual, which is at most 1 % of it, plus 1 % of margin. Deterministic: the start is a function of the nodes'
/// global ids.
[[nodiscard]] double largest_eigenvalue(const StepModel& model);

}  // namespace breccia
