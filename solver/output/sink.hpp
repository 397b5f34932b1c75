#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/experiment.hpp"
#include "output/frames/frame.hpp"
#include "output/run_position.hpp"

namespace breccia {

/// What is known about a run before its first step.
struct RunStart {
  std::string title;
  std::int64_t elements = 0, joints = 0;
  std::vector<std::string> gauges;           ///< groups, in the order of HistoryRow::gauges
  std::vector<case_::Gauge> point_gauges{};  ///< in the order of HistoryRow::at_points
  bool insitu = false;                       ///< pipelines are executed during the run: HistoryRow::insitu_share
  std::optional<OutputMarks>
      marks{};  ///< the run continues from a checkpoint: entries of its files beyond these are removed
  std::vector<std::string> bodies{};  ///< (bodies) what users call them; on the first rank
};

/// How far a run has come. SI.
struct StatusLine {
  std::int64_t step = 0;
  std::int64_t steps_total = 0;    ///< expected, at the present step size, or time.max_steps
  double time = 0;                 ///< s, simulated
  double end = 0;                  ///< s, simulated
  double share = 0;                ///< 0..1 of the run
  double element_steps_per_s = 0;  ///< at present
  double wall_s = 0;               ///< since the run's start
  double eta_s = 0;                ///< wall time still to go at that pace; negative or NaN: unknown
  double energy_residual = 0;      ///< relative
  std::int64_t broken_joints = 0, fragments = 0;
  double imbalance = 1;             ///< largest over mean working time of the ranks
  std::int64_t decompositions = 1;  ///< divisions of the model among the ranks so far
  std::string stage;
  bool paused = false;
};

/// Something that happened besides the physics.
struct RunEvent {
  std::string kind;      ///< "control": the answer to a command; "insitu": news of a pipeline; "checkpoint", "resume"
  std::string text;      ///< what happened, in words
  std::string id;        ///< of the command
  bool accepted = true;  ///< the command was carried out; false also for news that is a warning
  std::int64_t step = 0;
  double time = 0;  ///< s, simulated
};

/// Receives what a run produces. Calls come in the order: start, then any of frame, history and status, then finish.
/// Every call may throw OutputError. A sink copies what it wants to keep.
class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  virtual void start(const RunStart&) {}
  virtual void frame(const Frame&) {}
  virtual void history(const HistoryRow&) {}
  /// True when the sink would use a status line now; called every step, so that no unused line is made.
  [[nodiscard]] virtual bool status_due() const { return false; }
  virtual void status(const StatusLine&) {}
  virtual void event(const RunEvent&) {}
  /// How far the files are, for a checkpoint.
  virtual void mark(OutputMarks&) const {}
  /// Also after an error: see Summary::status ("complete", "stopped: ..." or the error's text).
  virtual void finish(const Summary&) {}
};

}  // namespace breccia
