#pragma once

#include <cmath>

namespace breccia {

/// Sum of many terms with the rounding of one addition: Neumaier's compensated summation. The result depends on the
/// order of the terms in its last bits only; keep the order fixed.
class CompensatedSum {
 public:
  CompensatedSum() = default;
  explicit CompensatedSum(double value) : sum_(value) {}

  void add(double term) {
    const double sum = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0;
  double lost_ = 0;
};

/// Work of a force under central differences, J: the trapezoid sum of 1/2 (f_m + f_(m+1)) . (x_(m+1) - x_m), exact for
/// a force linear in x. Sorted by forces, f_n contributes twice: 1/2 f_n . v(n-1/2) dt to the step that ended at t_n
/// and 1/2 f_n . v(n+1/2) dt to the step that begins there. `value` between the two calls of a step is the work up to
/// t_n. With every force booked this way, 1/2 m v(n-1/2) . v(n+1/2) changes by exactly the sum of the works.
class WorkSum {
 public:
  /// @param power  f_n . v(n-1/2), W;  @param dt  t_n - t_(n-1), s; 0 at the start of a run
  void add_before(double power, double dt) { sum_.add(0.5 * power * dt); }
  /// @param power  f_n . v(n+1/2), W;  @param dt  t_(n+1) - t_n, s
  void add_after(double power, double dt) { sum_.add(0.5 * power * dt); }
  [[nodiscard]] double value() const { return sum_.value(); }

 private:
  CompensatedSum sum_;
};

}  // namespace breccia
