#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace breccia {

/// Where the time of a run goes; the names appear in summary.json under "phases".
enum class Phase {
  setup,
  joints,
  search,
  contact,
  sweep,
  loads,
  stable_step,
  energy,
  communication,
  decomposition,
  output,
  insitu,
  checkpoint,
  count
};

[[nodiscard]] constexpr std::string_view name_of(Phase phase) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(Phase::count)> names{
      "setup",  "joints",        "search",        "contact", "sweep",   "loads",     "stable step",
      "energy", "communication", "decomposition", "output",  "in situ", "checkpoint"};
  return names[static_cast<std::size_t>(phase)];
}

/// Accumulated wall time by phase, s. Use `auto timing = timer.measure(Phase::sweep);` in a scope.
class PhaseTimer {
 public:
  using Clock = std::chrono::steady_clock;

  class Measurement {
   public:
    Measurement(PhaseTimer& timer, Phase phase) : timer_(timer), phase_(phase), start_(Clock::now()) {}
    Measurement(const Measurement&) = delete;
    Measurement& operator=(const Measurement&) = delete;
    ~Measurement() { timer_.add(phase_, std::chrono::duration<double>(Clock::now() - start_).count()); }

   private:
    PhaseTimer& timer_;
    Phase phase_;
    Clock::time_point start_;
  };

  [[nodiscard]] Measurement measure(Phase phase) { return {*this, phase}; }
  void add(Phase phase, double seconds) { seconds_[static_cast<std::size_t>(phase)] += seconds; }
  void add(const PhaseTimer& other) {
    for (std::size_t p = 0; p < seconds_.size(); ++p) seconds_[p] += other.seconds_[p];
  }
  [[nodiscard]] double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

 private:
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds_{};
};

}  // namespace breccia
