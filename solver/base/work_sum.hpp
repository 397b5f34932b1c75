#pragma once

#include "base/exact_sum.hpp"

namespace breccia {

/// Work of forces under central differences, J: the trapezoid sum of 1/2 (f_m + f_(m+1)) . (x_(m+1) - x_m), exact for
/// a force linear in x. Sorted by forces, f_n contributes twice: 1/2 f_n . v(n-1/2) dt to the step that ended at t_n
/// and 1/2 f_n . v(n+1/2) dt to the step that begins there. `sum` between the two calls of a step is the work up to
/// t_n. With every force accounted this way, 1/2 m v(n-1/2) . v(n+1/2) changes by exactly the sum of the works.
/// The power of each entity (node, face) is accounted by itself, so that the sum does not depend on which rank has
/// which.
class WorkSum {
 public:
  /// @param power  f_n . v(n-1/2), W;  @param dt  t_n - t_(n-1), s; 0 at the start of a run
  void add_before(double power, double dt) { sum_.add(0.5 * power * dt); }
  /// @param power  f_n . v(n+1/2), W;  @param dt  t_(n+1) - t_n, s
  void add_after(double power, double dt) { sum_.add(0.5 * power * dt); }
  [[nodiscard]] const ExactSum& sum() const { return sum_; }

 private:
  ExactSum sum_;
};

}  // namespace breccia
