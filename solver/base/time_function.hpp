#pragma once

#include <vector>

namespace breccia {

/// A scalar function of time: f(t) = constant + linear t + sum_k amplitude_k sin(2 pi frequency_k t + phase_k) +
/// table(t). The table is piecewise linear, constant before its first and after its last point. SI units.
struct TimeFunction {
  struct Sine {
    double amplitude = 0;
    double frequency = 0;  ///< Hz
    double phase = 0;      ///< rad
    friend bool operator==(const Sine&, const Sine&) = default;
  };
  struct Point {
    double time = 0;  ///< s, increasing
    double value = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };

  double constant = 0;
  double linear = 0;  ///< a second
  std::vector<Sine> sines;
  std::vector<Point> table;

  /// O(sines + log table), throws nothing.
  [[nodiscard]] double operator()(double time) const;
  /// The function that has at t the value of this one at t + by.
  [[nodiscard]] TimeFunction earlier(double by) const;
  /// True for the function that is zero at all times.
  [[nodiscard]] bool is_zero() const;
  friend bool operator==(const TimeFunction&, const TimeFunction&) = default;
};

}  // namespace breccia
