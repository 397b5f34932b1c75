#include "simulation/run.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "domains/motion_limit.hpp"
#include "domains/partition.hpp"
#include "simulation/checkpoint_snapshot.hpp"
#include "simulation/insitu_watch.hpp"
#include "simulation/run_checkpoints.hpp"
#include "simulation/run_conditions.hpp"
#include "simulation/run_control.hpp"
#include "simulation/run_output.hpp"
#include "simulation/run_stages.hpp"
#include "simulation/sound_state.hpp"
#include "simulation/stage_steps.hpp"
#include "simulation/step.hpp"
#include "system/interruption.hpp"

namespace breccia {

std::atomic<bool> stop_requested{false};

namespace {

/// Between two polls of the control file while the run is paused.
constexpr auto kPausedLook = std::chrono::milliseconds(100);

class Runner {
 public:
  Runner(const case_::Case& input, std::unique_ptr<Model> whole, const std::vector<std::unique_ptr<Sink>>& sinks,
         const Communicator& communicator, const RunFolder* folder)
      : Runner(input, nullptr, sinks, communicator, folder, [&](const case_::Case& now) {
          return Partition(now, communicator, std::move(whole), [&] { give_up_start(communicator); });
        }) {}

  Runner(const case_::Case& input, Checkpoint from, const ResumeOptions& options,
         const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator, const RunFolder& folder)
      : Runner(input, &from.position, sinks, communicator, &folder, [&](const case_::Case& now) {
          return Partition(now, communicator, checkpoint_snapshot(now, communicator, from));
        }) {
    from_ = from.position;
    options_ = options;
    extract_commanded_ = from_->extract_due;
    if (!conditions_.restore(from_->conditions) || !output_.restore_peaks(from_->peaks))
      throw InputError(Problem{folder.root.string(), 0, "resume",
                               "this checkpoint is damaged: it has not the conditions and gauges of its case", "", ""});
    if (checkpoints_) checkpoints_->restore(*from_);
  }

  Runner(const case_::Case& input, Checkpoint from, const StartOptions& options,
         const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator, const RunFolder& folder)
      : Runner(input, nullptr, sinks, communicator, &folder, [&](const case_::Case& now) {
          return Partition(now, communicator, start_snapshot(now, communicator, options, from));
        }) {
    partition_.refuse_what_cannot_break();
    output_.observer().check_points();
    output_.start_from(from.position);
    start_words_ = options.words;
  }

  Summary run() {
    output_.tell_start(insitu_.has_value(), from_ ? &*from_ : nullptr);
    if (insitu_) insitu_->start_from(output_.first_step(), from_ ? &*from_ : nullptr);
    if (from_)
      output_.tell_event("resume",
                         "the run continues from step " + std::to_string(clock().steps) + " on " +
                             std::to_string(communicator_.size()) + " rank" + (communicator_.size() == 1 ? "" : "s"),
                         true);
    if (!start_words_.empty()) output_.tell_event("start", start_words_, true);
    give_up_start(communicator_);
    try {
      for (auto s = first_stage(); s < input_.stages.size() && status_ == "complete"; ++s) run_stage(s);
      if (checkpoints_) end_with_checkpoint();
      conclude(partition_.domain());
      check_last_motion(partition_.domain());
      output_.write_frame();
      look_in_situ(true);
    } catch (const SimulationError& error) {
      throw SimulationError(end_with_fault(error.what()));
    } catch (const OutputError& error) {
      complete_checkpoint();
      if (insitu_ && insitu_->failed()) finish(error.what());
      throw;
    } catch (const InternalError&) {
      if (insitu_) insitu_->abandon();
      throw;
    }
    return finish(status_);
  }

 private:
  template <class MakePartition>
  Runner(const case_::Case& input, const RunPosition* from, const std::vector<std::unique_ptr<Sink>>& sinks,
         const Communicator& communicator, const RunFolder* folder, MakePartition&& make_partition)
      : stages_(input, from),
        communicator_(communicator),
        partition_(make_partition(input_)),
        output_(input_, sinks, partition_),
        conditions_(input),
        control_(folder != nullptr ? std::optional(folder->control()) : std::nullopt, communicator) {
    if (folder == nullptr) return;
    checkpoints_.emplace(input_, partition_, *folder,
                         [this](const std::string& text, bool good) { tell_of_checkpoint(text, good); });
    if (!input.insitu.asked_for()) return;
    communicator_.set_phase("start of the in-situ adaptor");
    insitu_.emplace(input, folder->extracts(), partition_,
                    [this](const std::string& text, bool good) { output_.tell_event("insitu", text, good); });
  }

  /// A run that has done nothing has nothing to lose.
  static void give_up_start(const Communicator& communicator) {
    communicator.agree([] { give_up_if_interrupted("interrupted before the first step"); });
  }

  [[nodiscard]] std::size_t first_stage() const { return from_ ? static_cast<std::size_t>(from_->stage) : 0; }

  /// As written in the checkpoint, or at its start.
  StageSteps begin_stage(std::size_t s) {
    const case_::Stage& stage = input_.stages[s];
    if (!from_ || s != first_stage()) return {input_, stage, partition_};
    StageSteps steps(input_, stage, partition_, StepSchedule{from_->until_look, from_->since_look, from_->growth});
    if (options_.extended && s + 1 == input_.stages.size()) steps.fit_end();
    return steps;
  }

  void run_stage(std::size_t s) {
    if (!from_ || s != first_stage()) stages_.begin(s);
    stage_ = s;
    StageSteps steps = begin_stage(s);
    output_.begin_stage(input_.stages[s]);
    tell_of_step(steps);
    if (input_.time.step > 0 && !(from_ && s == first_stage())) {
      const std::string text = given_step_text(input_.time.step, steps.limit());
      if (!text.empty()) output_.tell_event("step", text, false);
    }
    steps_ = &steps;
    while (!steps.over() && status_ == "complete") {
      take_commands();
      steps.look();
      tell_of_step(steps);
      look_at_state();  // a script may request the end: this step is the last one then
      if (output_.steps_done() == 0) give_up_start(communicator_);  // it may take long to write the first frame
      const bool end = s + 1 == input_.stages.size() && steps.at_last();
      const bool last = end || stop_commanded_ || output_.steps_done() + 1 == input_.time.max_steps ||
                        clock().time + clock().dt > options_.until - 0.5 * clock().dt;
      advance(end, last);
      status_ = status_now();
      look_at_checkpoints();
    }
    const bool last_stage = s + 1 == input_.stages.size();
    if (checkpoints_ && !checkpoints_->is_of_now())
      checkpoints_->begin(position(), last_stage || status_ != "complete");
    steps_ = nullptr;
    // After the checkpoint: a run resumed from it does not have this line.
    if (status_ != "complete" && sampled_without_line_) take_line(*sampled_without_line_);
  }

  void tell_of_step(StageSteps& steps) {
    const std::string text = steps.take_warning();
    if (!text.empty()) output_.tell_event("step", text, false);
  }

  [[nodiscard]] std::string status_now() const {
    if (!stop_reason_.empty()) return "stopped: " + stop_reason_;
    if (partition_.state().signals.received.stop || stop_commanded_) return "stopped: by request";
    if (input_.time.max_steps > 0 && output_.steps_done() >= input_.time.max_steps)
      return "stopped: time.max_steps reached";
    if (clock().time > options_.until - 0.5 * clock().dt) return "stopped: --until reached";
    return "complete";
  }

  void take_commands() {
    if ((partition_.state().signals.received.orders & kControlOrder) != 0) obey(control_.receive());
    if (paused_) stay_paused();
  }

  void look_at_state() {
    if (output_.frame_due()) output_.write_frame();
    look_in_situ(false);
  }

  /// @param end   of the run: the step gets a line of the history
  /// @param last  the energies are sampled, for the summary
  void advance(bool end, bool last) {
    const double time = clock().time;
    const bool line = output_.line_due() || end;
    const bool row = insitu_ && insitu_->waits_for_row();
    step(partition_.domain(), {line || last || row, signals()});
    const bool sampled = line || last || partition_.state().signals.received.stop;
    sampled_without_line_ = sampled ? std::optional(time) : std::nullopt;
    const std::vector<double> numbers = line ? take_line(time) : std::vector<double>{};
    if (row && !line) output_.take_row(time, *insitu_);
    if (row) insitu_->execute_delayed();
    if (line || last) check_energies(time);
    if (line) act_on(conditions_.take(numbers, stage_));
    output_.tell_status(paused_);
    if (!sampled_without_line_) partition_.keep_up();  // a line that is to come needs what a division forgets
  }

  std::vector<double> take_line(double time) {
    sampled_without_line_.reset();
    return output_.take_line(time, insitu_ ? &*insitu_ : nullptr);
  }

  /// What the conditions of the case request. At the end of a run everything is written anyway.
  void act_on(const std::vector<RunConditions::Fired>& fired) {
    using Action = RunConditions::Action;
    for (const RunConditions::Fired& one : fired) {
      output_.tell_event("condition", one.text, true);
      if (one.action == Action::stop && stop_reason_.empty()) stop_reason_ = one.text;
      if (one.action == Action::checkpoint) checkpoint_due_ = true;
      if (one.action == Action::extract) extract_commanded_ = true;
      // With one more step, which is divided where the next stage has shorter ones.
      if (one.action == Action::end_stage) stages_.end_at(clock().time + clock().dt);
    }
    const auto is_frame = [](const RunConditions::Fired& one) { return one.action == Action::frame; };
    if (!stop_reason_.empty() || std::none_of(fired.begin(), fired.end(), is_frame)) return;
    (void)output_.frame_due();  // if one is, this is it
    output_.write_frame();
  }

  void check_energies(double time) {
    output_.check_energies(time);
    if (checkpoints_) checkpoints_->confirm(output_.sound().step);
  }

  /// Between two steps, where a run resumed from the checkpoint begins.
  void look_at_checkpoints() {
    if (!checkpoints_) return;
    checkpoints_->look();
    const bool due = checkpoints_->due() || checkpoint_due_;
    checkpoint_due_ = false;
    if (due && status_ == "complete") begin_checkpoint();  // else it is the last one
  }

  /// When a run ends with an error: the last sound state. A failure to write it is not reported then.
  void complete_checkpoint() {
    if (!checkpoints_) return;
    try {
      checkpoints_->finish();
    } catch (const OutputError&) {
    }
  }

  /// Writes what can be written. @return  what went wrong, and the last state before it
  std::string end_with_fault(const std::string& fault) {
    complete_checkpoint();
    SoundState sound = output_.sound();
    const std::int64_t jumped = partition_.state().signals.step_motion.exceeded_step;
    if (jumped >= 0) sound.step = std::min(sound.step, jumped);
    std::string text = fault + (checkpoints_ ? words_of(sound, checkpoints_->folder(), communicator_) : "");
    try {
      finish(text);
    } catch (const OutputError& error) {
      text += "; not written: " + std::string(error.what());
    }
    return text;
  }

  void end_with_checkpoint() {
    const auto timing = partition_.domain().timer.measure(Phase::checkpoint);
    checkpoints_->finish();
  }

  [[nodiscard]] RunPosition position() const {
    RunPosition position = output_.position();
    position.until_look = steps_->schedule().until;
    position.since_look = steps_->schedule().since;
    position.growth = steps_->schedule().growth_steps;
    if (insitu_) position.broken_count = insitu_->broken_count();
    position.extract_due = extract_commanded_;
    position.conditions = conditions_.memory();
    stages_.note(position);
    return position;
  }

  void tell_of_checkpoint(const std::string& text, bool good) {
    output_.tell_event("checkpoint", text, good);
    for (const Command& command : std::exchange(wait_for_checkpoint_, {}))
      output_.tell_event("control", text, good, command.id);
  }

  /// Signals of this rank to the others.
  StepSignals signals() {
    StepSignals signals{.stop = stop_requested};
    if (control_.asks()) signals.orders |= kControlOrder;
    if (insitu_) insitu_->add_signals(signals);
    if (checkpoints_) checkpoints_->add_signals(signals);
    return signals;
  }

  void look_in_situ(bool all) {
    if (!insitu_) return;
    all = std::exchange(extract_commanded_, false) || all;
    obey(insitu_->look(output_.observer(), all));
  }

  void obey(const std::vector<Command>& commands) {
    for (const Command& command : commands) {
      if (command.kind == Command::Kind::checkpoint && writes_checkpoints()) {
        write_checkpoint_for(command);
        continue;
      }
      const std::string complaint = obey(command);
      output_.tell_event("control", complaint.empty() ? command.text : complaint, complaint.empty(), command.id);
    }
  }

  [[nodiscard]] bool writes_checkpoints() const { return checkpoints_ && input_.checkpoint.keep > 0; }

  /// The answer comes when it is there.
  void write_checkpoint_for(const Command& command) {
    checkpoints_->finish(!paused_);  // one that began before
    wait_for_checkpoint_.push_back(command);
    begin_checkpoint();
  }

  /// In a pause it is complete at once: no step waits for it.
  void begin_checkpoint() {
    checkpoints_->finish(!paused_);
    checkpoints_->begin(position());
    if (paused_) checkpoints_->finish();
  }

  /// @return  why it is refused; empty: done
  std::string obey(const Command& command) {
    switch (command.kind) {
      case Command::Kind::refused:
        return command.complaint;
      case Command::Kind::pause:
        if (std::exchange(paused_, true)) return "the run is paused already";
        return {};
      case Command::Kind::resume:
        if (!std::exchange(paused_, false)) return "the run is not paused";
        return {};
      case Command::Kind::stop:
        stop_commanded_ = true;
        paused_ = false;
        return {};
      case Command::Kind::extract:
        if (!insitu_) return "the run has no pipelines; allowed: frame, or a run with [insitu]";
        extract_commanded_ = true;
        return {};
      case Command::Kind::frame:
        output_.write_frame();
        return {};
      case Command::Kind::checkpoint:
        return "the run writes no checkpoints: checkpoint.keep is 0";
      case Command::Kind::frame_interval:
        output_.change_frame_interval(command.value);
        return {};
    }
    return {};
  }

  /// Waits between two steps until a command resumes or ends the run.
  void stay_paused() {
    communicator_.set_phase("pause");
    while (paused_) {
      std::this_thread::sleep_for(kPausedLook);
      (void)control_.asks();
      obey(control_.receive());
      if (extract_commanded_) look_in_situ(true);
      const bool checkpoint = checkpoint_requested.exchange(false);
      if (communicator_.max(static_cast<std::int64_t>(checkpoint)) != 0 && writes_checkpoints()) begin_checkpoint();
      if (communicator_.max(static_cast<std::int64_t>(stop_requested)) != 0) paused_ = false;
      output_.tell_status(paused_);
    }
  }

  Summary finish(const std::string& status) {
    if (status != status_) output_.write_frame();  // after an error: the last picture
    std::vector<PipelineReport> insitu;
    if (insitu_) insitu = insitu_->finish();
    return output_.finish(
        status, {std::move(insitu), checkpoints_ ? checkpoints_->report() : CheckpointReport{}, conditions_.reports()},
        paused_);
  }

  [[nodiscard]] const Clock& clock() const { return partition_.state().clock; }

  RunStages stages_;
  const case_::Case& input_ = stages_.now();
  Communicator communicator_;
  Partition partition_;
  RunOutput output_;
  RunConditions conditions_;
  std::string status_ = "complete";
  std::string stop_reason_;      ///< a condition; empty: none has ended the run
  bool checkpoint_due_ = false;  ///< a trigger has fired
  std::size_t stage_ = 0;        ///< the present one
  RunControl control_;
  bool paused_ = false, stop_commanded_ = false, extract_commanded_ = false;
  std::optional<InSituWatch> insitu_;
  std::optional<RunCheckpoints> checkpoints_;
  std::optional<double> sampled_without_line_;  ///< s, of the last step, where it is so
  std::vector<Command> wait_for_checkpoint_;    ///< their answers do
  std::optional<RunPosition> from_;             ///< the run continues from here
  ResumeOptions options_;
  std::string start_words_;      ///< whose state the run starts from; empty: at rest
  StageSteps* steps_ = nullptr;  ///< of the present stage
};

}  // namespace

Summary run_case(const case_::Case& input, std::unique_ptr<Model> whole,
                 const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                 const RunFolder* folder) {
  return Runner(input, std::move(whole), sinks, communicator, folder).run();
}

Summary resume_case(const case_::Case& input, Checkpoint from, const ResumeOptions& options,
                    const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                    const RunFolder& folder) {
  return Runner(input, std::move(from), options, sinks, communicator, folder).run();
}

Summary start_case(const case_::Case& input, Checkpoint from, const StartOptions& options,
                   const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                   const RunFolder& folder) {
  return Runner(input, std::move(from), options, sinks, communicator, folder).run();
}

}  // namespace breccia
