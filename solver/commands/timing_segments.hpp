#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "commands/race.hpp"
#include "domains/partition.hpp"

namespace breccia {

/// Time of a repetition by segments. Every repetition does the same work in the same segment, and a disturbance of the
/// machine seldom falls into the same segment of every repetition.
class TimingSegments {
 public:
  /// @param length  of a piece, steps
  TimingSegments(const Partition& partition, std::int64_t length) : length_(length), before_(totals(partition)) {}

  /// After every step.
  void step(const Partition& partition) {
    if (steps_++ % length_ == 0) pieces_.push_back({});
    const Totals now = totals(partition);
    Piece& piece = pieces_.back();
    const double wall = now.wall - before_.wall, search = now.search - before_.search,
                 contact = now.contact - before_.contact;
    piece[kWall] += wall;
    piece[kSearch] += search;
    piece[kContact] += contact;
    piece[kRest] += wall - search - contact;
    if (now.searches > before_.searches) piece[kFull] += search;
    before_ = now;
  }
  /// The slowest rank's. Collective.
  void agree(const Communicator& communicator) {
    for (Piece& piece : pieces_) communicator.max(piece);
  }
  void keep_least(const TimingSegments& other) { keep_least(other, 0); }
  /// Keeps the least of what is neither search nor contact, and so the same for all candidates.
  void keep_least_rest(const TimingSegments& other) { keep_least(other, kRest, kRest + 1); }

  /// @param alone  on one rank, where none waits for another: wall time is the sum of its parts, of which the rest may
  ///               be that of another repetition
  void sum_up(Repetition& repetition, bool alone) const {
    Piece sum{};
    for (const Piece& piece : pieces_) {
      for (std::size_t k = 0; k < kKinds; ++k) sum[k] += piece[k];
    }
    repetition.wall = alone ? sum[kRest] + sum[kSearch] + sum[kContact] : sum[kWall];
    repetition.search = sum[kSearch];
    repetition.full_search = sum[kFull];
    repetition.contact = sum[kContact];
  }

 private:
  enum Kind : std::size_t { kWall, kRest, kSearch, kFull, kContact, kKinds };
  using Piece = std::array<double, kKinds>;
  struct Totals {
    double wall, search, contact;
    std::int64_t searches;
  };
  static Totals totals(const Partition& partition) {
    const PhaseTimer& timer = partition.domain().timer;
    return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
            timer.seconds(Phase::search), timer.seconds(Phase::contact), partition.state().counters.searches};
  }
  void keep_least(const TimingSegments& other, std::size_t from, std::size_t to = kKinds) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (std::size_t k = from; k < to; ++k) pieces_[i][k] = std::min(pieces_[i][k], other.pieces_[i][k]);
    }
  }

  std::int64_t length_, steps_ = 0;
  Totals before_;
  std::vector<Piece> pieces_;
};

}  // namespace breccia
