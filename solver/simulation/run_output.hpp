#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "domains/partition.hpp"
#include "observe/observe.hpp"
#include "output/peaks.hpp"
#include "output/schedule.hpp"
#include "output/sink.hpp"
#include "simulation/insitu_watch.hpp"
#include "simulation/recent_pace.hpp"
#include "simulation/sink_group.hpp"
#include "simulation/sound_state.hpp"

namespace breccia {

/// What a run writes: lines of the history, frames, the status, events and the summary, and when they are due. All but
/// the status is collective.
class RunOutput {
 public:
  /// @pre all arguments outlive this object; the ends of stages may change
  RunOutput(const case_::Case& input, const std::vector<std::unique_ptr<Sink>>& sinks, Partition& partition);

  /// The run starts from the state of another one. @param from  where that one was
  void start_from(const RunPosition& from);
  /// @param from  where the run continues; null: at its start
  void tell_start(bool insitu, const RunPosition* from);
  void tell_event(const std::string& kind, const std::string& text, bool accepted, const std::string& id = {});
  void begin_stage(const case_::Stage& stage);

  /// To be called once a step; advances.
  [[nodiscard]] bool frame_due() { return frames_.due(clock().time, clock().dt, clock().steps); }
  /// Likewise whether the step that comes is sampled.
  [[nodiscard]] bool line_due() { return histories_.due(clock().time, clock().dt, clock().steps); }
  void change_frame_interval(double interval) { frames_.change(interval, clock().time, clock().dt); }

  /// Peaks::restore
  [[nodiscard]] bool restore_peaks(const std::vector<double>& memory) { return peaks_.restore(memory); }

  void write_frame();
  /// A line of the history. @param time  s, of the step that was sampled;  @param insitu  null: none
  /// @return  its numbers, in the order of the columns
  std::vector<double> take_line(double time, InSituWatch* insitu);
  /// A row of the history for the pipelines alone. Collective.
  void take_row(double time, InSituWatch& insitu);
  /// Throws SimulationError if the residual of the step that was sampled, or the energy that it holds beyond what was
  /// put in, is above its limit; otherwise all until then is sound. @param time  s, of that step
  void check_energies(double time);
  [[nodiscard]] const SoundState& sound() const { return sound_; }
  void tell_status(bool paused) {
    sink_group_.tell_status([this, paused] { return status_line(paused); });
  }
  /// What a run has done beside its steps.
  struct Reports {
    std::vector<PipelineReport> insitu;
    CheckpointReport checkpoints;
    std::vector<ConditionReport> conditions;
  };
  Summary finish(const std::string& status, Reports reports, bool paused);
  /// Where the output is. Collective.
  [[nodiscard]] RunPosition position() const;

  /// Steps of this run, without those of the run whose state it started from.
  [[nodiscard]] std::int64_t steps_done() const { return clock().steps - start_step_; }

  /// Where the first one was.
  [[nodiscard]] Moment first_step() const { return {start_step_, start_time_}; }

  [[nodiscard]] Observer& observer() { return observer_; }

 private:
  /// Warns once a run if the frame interval is below the time step. @param told_before  the warning was given already
  void tell_of_frame_interval(bool told_before);
  [[nodiscard]] std::int64_t broken_joints() const;  ///< of the whole model, now; collective
  [[nodiscard]] double wall() const;
  [[nodiscard]] double end() const { return input_.stages.back().end; }  ///< s, of the run, as of now
  [[nodiscard]] double share() const;                                    ///< 0..1 of the run
  [[nodiscard]] StatusLine status_line(bool paused);
  [[nodiscard]] Summary summary_of(const std::string& status);
  [[nodiscard]] const Clock& clock() const { return partition_.state().clock; }

  const case_::Case& input_;
  SinkGroup sink_group_;
  Partition& partition_;
  Observer observer_;
  double start_time_ = 0;        ///< s, of the state that the run started from
  std::int64_t start_step_ = 0;  ///< likewise
  double wall_before_ = 0;       ///< s, that the run took before it was resumed
  Schedule histories_, frames_;
  Peaks peaks_;
  std::string stage_name_;
  std::int64_t frame_number_ = 0, last_fragments_ = 0, last_broken_ = 0;
  std::int64_t resumed_at_ = -1;  ///< step; -1: begun here
  bool within_stage_ = false;     ///< the run continues in a stage that has begun before
  bool frames_told_ = false;      ///< tell_of_frame_interval has had reason to
  SoundState sound_;
  RecentPace pace_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace breccia
