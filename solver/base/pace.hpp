#pragma once

#include <chrono>
#include <optional>

namespace breccia {

/// Limits an action to one execution per interval of wall time; the first is due at once.
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
