#pragma once

#include <functional>

#include "base/exact_sum.hpp"
#include "base/field.hpp"
#include "physics/stable_step.hpp"

namespace breccia {

/// y = K u of the model at rest, N: Hooke elements f_a = V (lambda tr e I + 2 mu e) g_a, intact joints k A0/3 (u -
/// u_other) on each corner; with mid-edge points half of each corner's opening and a quarter of the other two's. u, y:
/// nodal fields, as Field aligns them. O(elements).
void stiffness_action(const StepModel& model, const double* u, double* y);

/// What an iteration over the nodes of a model needs of the other ranks that hold parts of it; as given: none.
struct RankOperations {
  /// Brings the nodes of proxies up to date in a nodal field.
  std::function<void(Field<double>&)> gather = [](Field<double>&) {};
  /// Totals over the ranks.
  std::function<double(const ExactSum&)> total = [](const ExactSum& sum) { return sum.value(); };
  std::function<double(double)> max = [](double value) { return value; };
};

/// Upper estimate of the largest eigenvalue of M^-1 K, 1/s2: largest Ritz value of a Lanczos iteration plus its
/// residual, which is at most 1 % of it, plus 1 % of margin. The same bits for any number of ranks: products are exact
/// sums over elements, and the start is a function of the nodes' global ids. Collective as far as `ranks` are.
/// @param model  of the originals and proxies of this rank
[[nodiscard]] double largest_eigenvalue(const StepModel& model, const RankOperations& ranks = {});

}  // namespace breccia
