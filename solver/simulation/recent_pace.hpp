#pragma once

#include <cstdint>
#include <deque>

namespace breccia {

/// How fast a run gets on at present. Steps among debris take many times as long as those before anything has broken:
/// the mean over the whole run would promise its end far too soon.
class RecentPace {
 public:
  struct Mark {
    double wall = 0;   ///< s, ascending
    double share = 0;  ///< 0..1 of the run
    std::int64_t steps = 0;
  };
  struct Pace {
    double share_per_s = 0, steps_per_s = 0;  ///< 0: not known yet
  };

  /// Start or continuation of the run.
  void begin(const Mark& mark) { marks_ = {mark}; }
  /// Over the last quarter of the time since begin(), 20 s at least, or all of it. O(1) in the mean
  /// @param paused  does not count as time; the pace stays what it was
  Pace follow(const Mark& now, bool paused);

 private:
  std::deque<Mark> marks_;
  double elapsed_ = 0;  ///< s, without pauses
  Pace pace_;
};

}  // namespace breccia
