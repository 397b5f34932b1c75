#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "simulation/race.hpp"
#include "simulation/share.hpp"

namespace breccia {

/// Wall, search and contact time of a lap, piece by piece: every lap does the same work in the same piece, and what disturbs
/// the machine seldom disturbs the same piece of every lap.
class LapPieces {
 public:
  explicit LapPieces(const Share& share) : before_(now(share)) {}

  /// A piece ends here.
  void cut(const Share& share) {
    const auto after = now(share);
    for (std::size_t k = 0; k < kKinds; ++k) seconds_.push_back(after[k] - before_[k]);
    before_ = after;
  }
  /// The slowest rank's. Collective.
  void agree(const Communicator& communicator) { communicator.max(seconds_); }
  void keep_least(const LapPieces& other) {
    for (std::size_t i = 0; i < seconds_.size(); ++i) seconds_[i] = std::min(seconds_[i], other.seconds_[i]);
  }
  void sum_up(Lap& lap) const {
    std::array<double, kKinds> sum{};
    for (std::size_t i = 0; i < seconds_.size(); ++i) sum[i % kKinds] += seconds_[i];
    lap.wall = sum[0];
    lap.search = sum[1];
    lap.contact = sum[2];
  }

 private:
  static constexpr std::size_t kKinds = 3;
  static std::array<double, kKinds> now(const Share& share) {
    const PhaseTimer& timer = share.stepper().timer();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
            timer.seconds(Phase::search), timer.seconds(Phase::contact)};
  }

  std::array<double, kKinds> before_;
  std::vector<double> seconds_;  ///< (pieces, kinds)
};

}  // namespace breccia
