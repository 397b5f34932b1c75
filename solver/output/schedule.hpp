#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace breccia {

/// Simulated times at which something is due: 0, interval, 2 interval, ...; never twice within `least_steps`.
class Schedule {
 public:
  /// @param interval  s; 0: never
  explicit Schedule(double interval, std::int64_t least_steps = 1) : interval_(interval), least_steps_(least_steps) {}
  /// True when the next due time lies before the end of the step of length dt that begins at `time`; moves on.
  bool due(double time, double dt, std::int64_t step) {
    if (interval_ <= 0 || step < free_step_ || time + 0.5 * dt < interval_ * static_cast<double>(next_)) return false;
    next_ = following(time, dt);
    free_step_ = step + least_steps_;
    return true;
  }
  /// From now on another interval, next due at its first multiple after `time`.
  void change(double interval, double time, double dt) {
    interval_ = interval;
    if (interval_ > 0) next_ = following(time, dt);
  }

  /// Where it is, as numbers for a checkpoint, and back.
  [[nodiscard]] std::array<double, 4> numbers() const {
    return {interval_, static_cast<double>(least_steps_), static_cast<double>(free_step_), static_cast<double>(next_)};
  }
  [[nodiscard]] static Schedule from_numbers(const std::array<double, 4>& numbers) {
    Schedule schedule(numbers[0], static_cast<std::int64_t>(numbers[1]));
    schedule.free_step_ = static_cast<std::int64_t>(numbers[2]);
    schedule.next_ = static_cast<std::int64_t>(numbers[3]);
    return schedule;
  }

 private:
  [[nodiscard]] std::int64_t following(double time, double dt) const {
    constexpr double kMost = 9e18;  // of an interval so short that it is always due
    return static_cast<std::int64_t>(std::min(kMost, std::floor((time + 0.5 * dt) / interval_))) + 1;
  }
  double interval_;
  std::int64_t least_steps_, free_step_ = 0;
  std::int64_t next_ = 0;
};

}  // namespace breccia
