#include "simulation/run.hpp"

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "domains/partition.hpp"
#include "simulation/insitu_watch.hpp"
#include "simulation/run_control.hpp"
#include "simulation/run_output.hpp"
#include "simulation/stage_steps.hpp"
#include "simulation/step.hpp"

namespace breccia {

std::atomic<bool> stop_requested{false};

namespace {

/// Between two looks at the control file while the run is paused.
constexpr auto kPausedLook = std::chrono::milliseconds(100);

class Runner {
 public:
  Runner(const case_::Case& input, std::unique_ptr<Model> whole, const std::vector<std::unique_ptr<Sink>>& sinks,
         const Communicator& communicator, const RunFolder* folder)
      : input_(input),
        communicator_(communicator),
        partition_(input, communicator, std::move(whole)),
        output_(input, sinks, partition_),
        control_(folder != nullptr ? std::optional(folder->control()) : std::nullopt, communicator) {
    if (folder == nullptr || !input.insitu.asked_for()) return;
    communicator_.set_phase("start of the in-situ adaptor");
    insitu_.emplace(input, folder->extracts(), partition_,
                    [this](const std::string& text, bool good) { output_.tell_event("insitu", text, good); });
  }

  Summary run() {
    output_.tell_start(insitu_.has_value());
    try {
      for (std::size_t s = 0; s < input_.stages.size() && status_ == "complete"; ++s) run_stage(input_.stages[s]);
      conclude(partition_.domain());
      output_.write_frame();
      look_in_situ(true);
    } catch (const SimulationError& error) {
      finish(error.what());
      throw;
    } catch (const OutputError& error) {
      if (insitu_ && insitu_->failed()) finish(error.what());
      throw;
    } catch (const InternalError&) {
      if (insitu_) insitu_->abandon();
      throw;
    }
    return finish(status_);
  }

 private:
  void run_stage(const case_::Stage& stage) {
    StageSteps steps(input_, stage, partition_);
    output_.begin_stage(stage);
    if (input_.time.step > 0) {
      const std::string text = given_step_text(input_.time.step, steps.limit());
      if (!text.empty()) output_.tell_event("step", text, false);
    }
    while (!steps.over()) {
      steps.look();
      advance();
      if (partition_.state().signals.received.stop || stop_commanded_) status_ = "stopped: by request";
      if (input_.time.max_steps > 0 && clock().steps >= input_.time.max_steps)
        status_ = "stopped: time.max_steps reached";
      if (status_ != "complete") return;
    }
  }

  void advance() {
    if ((partition_.state().signals.received.orders & kControlOrder) != 0) obey(control_.receive());
    if (paused_) stay_paused();
    const double time = clock().time;
    if (output_.frame_due()) output_.write_frame();
    look_in_situ(false);
    const bool sample = output_.line_due();
    step(partition_.domain(), {sample, signals()});
    if (sample) output_.take_line(time, insitu_ ? &*insitu_ : nullptr);
    output_.tell_status(paused_);
    partition_.keep_up();
  }

  /// What this rank has to tell the others.
  StepSignals signals() {
    StepSignals signals{.stop = stop_requested};
    if (control_.asks()) signals.orders |= kControlOrder;
    if (insitu_) insitu_->add_signals(signals);
    return signals;
  }

  void look_in_situ(bool all) {
    if (!insitu_) return;
    all = std::exchange(extract_commanded_, false) || all;
    obey(insitu_->look(output_.observer(), all));
  }

  void obey(const std::vector<Command>& commands) {
    for (const Command& command : commands) {
      const std::string complaint = obey(command);
      output_.tell_event("control", complaint.empty() ? command.text : complaint, complaint.empty(), command.id);
    }
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
      case Command::Kind::frame_interval:
        output_.change_frame_interval(command.value);
        return {};
    }
    return {};
  }

  /// Waits between two steps until somebody lets the run go on or asks for its end.
  void stay_paused() {
    communicator_.set_phase("pause");
    while (paused_) {
      std::this_thread::sleep_for(kPausedLook);
      (void)control_.asks();
      obey(control_.receive());
      if (extract_commanded_) look_in_situ(true);
      if (communicator_.max(static_cast<std::int64_t>(stop_requested)) != 0) paused_ = false;
      output_.tell_status(paused_);
    }
  }

  Summary finish(const std::string& status) {
    if (status != status_) output_.write_frame();  // after an error: the last picture
    std::vector<PipelineReport> insitu;
    if (insitu_) insitu = insitu_->finish();
    return output_.finish(status, std::move(insitu), paused_);
  }

  [[nodiscard]] const Clock& clock() const { return partition_.state().clock; }

  const case_::Case& input_;
  Communicator communicator_;
  Partition partition_;
  RunOutput output_;
  std::string status_ = "complete";
  RunControl control_;
  bool paused_ = false, stop_commanded_ = false, extract_commanded_ = false;
  std::optional<InSituWatch> insitu_;
};

}  // namespace

Summary run_case(const case_::Case& input, std::unique_ptr<Model> whole,
                 const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                 const RunFolder* folder) {
  return Runner(input, std::move(whole), sinks, communicator, folder).run();
}

}  // namespace breccia
