#include "simulation/recent_pace.hpp"

#include <algorithm>

namespace breccia {

RecentPace::Pace RecentPace::follow(const Mark& now, bool paused) {
  constexpr double kShortest = 20;  // s
  constexpr double kPart = 0.25;
  if (marks_.empty() || paused) {
    marks_ = {now};
    return pace_;
  }
  // The first step includes one-time work such as the first search, and would give hours instead of seconds.
  if (now.steps == marks_.front().steps + 1 && marks_.size() == 1) {
    marks_ = {now};
    return pace_;
  }
  elapsed_ += now.wall - marks_.back().wall;
  marks_.push_back(now);
  const double begin = now.wall - std::max(kShortest, kPart * elapsed_);
  while (marks_.size() > 2 && marks_[1].wall <= begin) marks_.pop_front();
  const Mark& then = marks_.front();
  if (const double wall = now.wall - then.wall; wall > 0)
    pace_ = {(now.share - then.share) / wall, static_cast<double>(now.steps - then.steps) / wall};
  return pace_;
}

}  // namespace breccia
