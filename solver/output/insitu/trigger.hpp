#pragma once

#include <algorithm>
#include <cstdint>

#include "case/case.hpp"
#include "output/schedule.hpp"

namespace breccia {

/// Where a run is, alike on all ranks.
struct Moment {
  std::int64_t step = 0;
  double time = 0, dt = 0;  ///< s, simulated; the step that begins now
  std::int64_t broken = 0;  ///< joints of the whole model, as last counted
};

/// When a pipeline is due by quantities that all ranks know: steps, simulated time, broken joints. The root evaluates
/// wall time.
class Trigger {
 public:
  /// Without any trigger of the user's: so many times over the run.
  static constexpr double kTimes = 50;

  /// @param end  s, of the run
  Trigger(const case_::Pipeline& pipeline, double end)
      : every_steps_(pipeline.every_steps),
        every_broken_(pipeline.every_broken),
        first_break_(pipeline.first_break),
        times_over_the_run_(!pipeline.has_trigger()),
        every_time_(pipeline.has_trigger() ? pipeline.every_time : end / kTimes),
        times_(every_time_) {}

  /// @param first  where the run begins: joints that are broken there do not count
  /// @param end    s, of the run
  /// @param broken joints that have been counted since
  void start_from(const Moment& first, double end, std::int64_t broken) {
    if (times_over_the_run_) times_ = Schedule(every_time_ = (end - first.time) / kTimes);
    broken_at_start_ = first.broken;
    broke_ = broken > broken_at_start_;
    if (every_broken_ > 0) next_broken_ = (broken / every_broken_ + 1) * every_broken_;
  }
  /// To be called once a step; advances.
  [[nodiscard]] bool due(const Moment& now) {
    const bool by_time = times_.due(now.time, now.dt, now.step);
    const bool by_steps = every_steps_ > 0 && now.step % every_steps_ == 0;
    const bool first = first_break_ && !broke_ && now.broken > broken_at_start_;
    const bool by_broken = every_broken_ > 0 && now.broken >= next_broken_;
    broke_ = broke_ || now.broken > broken_at_start_;
    if (by_broken) next_broken_ = (now.broken / every_broken_ + 1) * every_broken_;
    return by_time || by_steps || first || by_broken;
  }
  /// Simulated time between two times that time or steps make due, s, with steps of dt.
  [[nodiscard]] double distance(double dt) const {
    const double steps = every_steps_ > 0 ? static_cast<double>(every_steps_) * dt : every_time_;
    return every_time_ > 0 ? std::min(every_time_, steps) : steps;
  }
  /// Whether only time and steps make it due, at even distances.
  [[nodiscard]] bool is_regular() const { return every_broken_ == 0 && !first_break_; }
  /// Whether joints that break must be counted for it.
  [[nodiscard]] bool counts_broken() const { return every_broken_ > 0 || (first_break_ && !broke_); }

 private:
  std::int64_t every_steps_, every_broken_;
  bool first_break_, broke_ = false;
  bool times_over_the_run_;
  double every_time_;
  Schedule times_;
  std::int64_t next_broken_ = every_broken_, broken_at_start_ = 0;
};

/// What something that is done again and again has cost. The first time starts what stays: what it took beyond a usual
/// time is the start.
class Overhead {
 public:
  explicit Overhead(double share) : share_(share) {}
  /// Whether another execution, at the cost of the last one, stays within the share of the elapsed wall time, s;
  /// start-up does not count.
  [[nodiscard]] bool allows(double elapsed) const { return times_ == 0 || spent_ + last_ <= share_ * elapsed; }
  void account(double seconds) {
    if (times_++ == 0) {
      start_ = seconds;
      return;
    }
    if (times_ == 2) {
      spent_ = std::min(start_, seconds);
      start_ -= spent_;
    }
    last_ = seconds;
    spent_ += seconds;
  }
  /// Time spent on it in which it was not done.
  void account_idle(double seconds) { spent_ += seconds; }
  [[nodiscard]] std::int64_t times() const { return times_; }
  [[nodiscard]] double spent() const { return spent_; }  ///< s, without the start
  [[nodiscard]] double start() const { return start_; }  ///< s
  /// Of one time, s, the last ones counting most; 0: not known yet.
  [[nodiscard]] double cost() const { return times_ < 2 ? 0 : 0.5 * (last_ + spent_ / static_cast<double>(times_)); }

 private:
  double share_;
  double start_ = 0, last_ = 0, spent_ = 0;
  std::int64_t times_ = 0;
};

}  // namespace breccia
