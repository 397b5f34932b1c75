#pragma once

#include <iosfwd>
#include <string>

#include "output/folder/status_sink.hpp"

namespace breccia {

/// Where a race stands.
struct RaceStatus {
  std::string doing;  ///< "on the way to the start", or who is running
  double share = 0;   ///< 0..1 of what is being done: the way to the start, then all repetitions
  double wall_s = 0;  ///< since that began
};

/// Progress of a race for the person or program that started it, in the modes of a run (ProgressSink) and at their
/// pace.
class RaceProgress {
 public:
  /// @pre stream outlives this object
  RaceProgress(ProgressMode mode, std::ostream& stream, int columns);

  /// Whether a status would be shown now; called every step, so that no unused one is made.
  [[nodiscard]] bool due() const { return mode_ != ProgressMode::none && pace_.due(); }
  void show(const RaceStatus& status);
  /// The last line, before the results.
  void finish();

 private:
  ProgressMode mode_;
  std::ostream& stream_;
  int columns_;
  Pace pace_;
  bool on_line_ = false;  ///< a bar stands on the present line
};

}  // namespace breccia
