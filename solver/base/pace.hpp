#pragma once

#include <chrono>
#include <optional>

namespace breccia {

/// Says "now" at most once an interval of wall time, and at first.
class Pace {
 public:
  explicit Pace(std::chrono::milliseconds interval) : interval_(interval) {}
  [[nodiscard]] bool due() const { return !last_ || Clock::now() - *last_ >= interval_; }
  void done() { last_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::chrono::milliseconds interval_;
  std::optional<Clock::time_point> last_;
};

}  // namespace breccia
