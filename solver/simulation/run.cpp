#include "simulation/run.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "domains/partition.hpp"
#include "domains/state_records.hpp"
#include "observe/energy_sample.hpp"
#include "observe/observe.hpp"
#include "output/schedule.hpp"
#include "output/summary.hpp"
#include "simulation/insitu_watch.hpp"
#include "simulation/run_control.hpp"
#include "simulation/sink_group.hpp"
#include "simulation/stage_steps.hpp"
#include "simulation/step.hpp"

namespace breccia {

std::atomic<bool> stop_requested{false};

namespace {

/// A sample of the energies costs about as much as a step: lines of the history at no given interval come no closer
/// than so many steps.
constexpr std::int64_t kStepsBetweenLines = 20;

/// Between two looks at the control file while the run is paused.
constexpr auto kPausedLook = std::chrono::milliseconds(100);

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class Runner {
 public:
  Runner(const case_::Case& input, std::unique_ptr<Model> whole, const std::vector<std::unique_ptr<Sink>>& sinks,
         const Communicator& communicator, const RunFolder* folder)
      : input_(input),
        sink_group_(sinks, communicator),
        communicator_(communicator),
        partition_(input, communicator, std::move(whole)),
        observer_(input, partition_),
        end_(input.stages.back().end),
        histories_(input.output.history_interval > 0 ? Schedule(input.output.history_interval)
                                                     : Schedule(end_ / 500, kStepsBetweenLines)),
        frames_(input.output.frame_interval),
        control_(folder != nullptr ? std::optional(folder->control()) : std::nullopt, communicator) {
    if (folder == nullptr || !input.insitu.asked_for()) return;
    communicator_.set_phase("start of the in-situ adaptor");
    insitu_.emplace(input, folder->extracts(), partition_,
                    [this](const std::string& text, bool good) { tell_event("insitu", text, good); });
  }

  Summary run() {
    tell_start();
    try {
      for (std::size_t s = 0; s < input_.stages.size() && status_ == "complete"; ++s) run_stage(input_.stages[s]);
      conclude(partition_.domain());
      write_frame();
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
  void tell_event(const std::string& kind, const std::string& text, bool accepted, const std::string& id = {}) {
    const RunEvent event{kind, text, id, accepted, clock().steps, clock().time};
    sink_group_.tell([&](Sink& sink) { sink.event(event); });
  }

  void tell_start() {
    const RunStart start{input_.title, partition_.whole().num_elements, partition_.whole().num_joints,
                         input_.output.gauges, insitu_.has_value()};
    sink_group_.tell([&](Sink& sink) { sink.start(start); });
  }

  void run_stage(const case_::Stage& stage) {
    stage_name_ = stage.name;
    StageSteps steps(input_, stage, partition_);
    observer_.begin_stage(stage);
    if (input_.time.step > 0) {
      const std::string text = given_step_text(input_.time.step, steps.limit());
      if (!text.empty()) tell_event("step", text, false);
    }
    while (!steps.over()) {
      steps.look();
      const bool last = &stage == &input_.stages.back() && steps.at_last();
      advance(last || clock().steps + 1 == input_.time.max_steps);
      if (partition_.state().signals.received.stop || stop_commanded_) status_ = "stopped: by request";
      if (input_.time.max_steps > 0 && clock().steps >= input_.time.max_steps)
        status_ = "stopped: time.max_steps reached";
      if (status_ == "stopped: by request" && !steps.over()) advance(true);
      if (status_ != "complete") return;
    }
  }

  /// @param last  the energies are sampled, for the summary
  void advance(bool last) {
    if ((partition_.state().signals.received.orders & kControlOrder) != 0) obey(control_.receive());
    if (paused_) stay_paused();
    const double time = clock().time;
    if (frames_.due(time, clock().dt, clock().steps)) write_frame();
    look_in_situ(false);
    const bool line = histories_.due(time, clock().dt, clock().steps);
    step(partition_.domain(), {line || last, signals()});
    if (line) take_line(time);
    if (line || last) check_energies(time);
    tell_status();
    partition_.keep_up();
  }

  /// What this rank has to tell the others.
  StepSignals signals() {
    StepSignals signals{.stop = stop_requested};
    if (control_.asks()) signals.orders |= kControlOrder;
    if (insitu_) insitu_->add_signals(signals);
    return signals;
  }

  void take_line(double time) {
    const auto lap = partition_.domain().timer.measure(Phase::output);
    HistoryRow row = observer_.row(time);
    if (insitu_) row.insitu_share = insitu_->share_of_time();
    last_fragments_ = row.fragments;
    last_broken_ = row.broken_joints;
    if (insitu_) insitu_->take_row(row);
    sink_group_.tell([&](Sink& sink) { sink.history(row); });
  }

  void look_in_situ(bool all) {
    if (!insitu_) return;
    all = std::exchange(extract_commanded_, false) || all;
    obey(insitu_->look(observer_, all));
  }

  void obey(const std::vector<Command>& commands) {
    for (const Command& command : commands) {
      const std::string complaint = obey(command);
      tell_event("control", complaint.empty() ? command.text : complaint, complaint.empty(), command.id);
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
        write_frame();
        return {};
      case Command::Kind::frame_interval:
        frames_.change(command.value, clock().time, clock().dt);
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
      tell_status();
    }
  }

  void check_energies(double time) const {
    const EnergySample& sample = partition_.domain().sample;
    const EnergyFault fault = energy_fault(sample.budget, input_.time.residual_limit, input_.time.energy_gain_limit);
    if (fault.what.empty()) return;
    throw SimulationError("step " + std::to_string(clock().steps - 1) + ", time " + scientific(time) +
                          " s: " + fault.what + "; the strain energy is densest in element " +
                          std::to_string(sample.worst_element) + "; lower time.safety, or raise " + fault.key +
                          " if you trust the run");
  }

  void write_frame() {
    const auto lap = partition_.domain().timer.measure(Phase::output);
    const FrameParts parts{input_.output.elements, input_.output.joints, input_.output.contacts};
    const Frame frame = observer_.picture(frame_number_++, parts);
    sink_group_.tell([&](Sink& sink) { sink.frame(frame); });
  }

  void tell_status() {
    sink_group_.tell_status([this] { return status_line(); });
  }

  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

  StatusLine status_line() {
    StatusLine line;
    const double left = end_ - clock().time;
    line.step = clock().steps;
    line.steps_total = line.step + static_cast<std::int64_t>(std::llround(left / clock().dt));
    line.time = clock().time;
    line.end = end_;
    line.share = clock().time / end_;
    line.wall_s = wall();
    line.element_steps_per_s =
        static_cast<double>(partition_.whole().num_elements) * static_cast<double>(line.step) / line.wall_s;
    line.eta_s = line.share > 0 ? line.wall_s * (1.0 - line.share) / line.share : -1.0;
    line.energy_residual = partition_.domain().sample.budget.residual_relative;
    line.broken_joints = last_broken_;
    line.fragments = last_fragments_;
    line.imbalance = partition_.imbalance();
    line.decompositions = partition_.decompositions();
    line.stage = stage_name_;
    line.paused = paused_;
    return line;
  }

  Summary finish(const std::string& status) {
    if (status != status_) write_frame();  // after an error: the last picture
    Summary summary;
    if (insitu_) summary.insitu = insitu_->finish();
    const Provenance provenance = collect_provenance(BRECCIA_VERSION, {});
    summary.title = input_.title;
    summary.version = provenance.version;
    summary.host = provenance.host;
    summary.status = status;
    summary.steps = clock().steps;
    summary.simulated_time = clock().time;
    summary.time_step = clock().dt;
    summary.ranks = communicator_.size();
    summary.decompositions = partition_.decompositions();
    summary.imbalance = partition_.imbalance();
    summary.messages = communicator_.sum(partition_.domain().messages());
    summary.message_bytes = communicator_.sum(partition_.domain().bytes());
    summary.elements = partition_.whole().num_elements;
    summary.joints = partition_.whole().num_joints;
    summary.broken_joints = last_broken_ = communicator_.sum(partition_.state().joints.broken);
    summary.fragments = observer_.num_fragments();
    summary.searches = communicator_.max(partition_.state().counters.searches);
    summary.inverted_elements = communicator_.sum(partition_.state().counters.crushed);
    summary.wall_s = wall();
    summary.element_steps_per_s =
        static_cast<double>(summary.elements) * static_cast<double>(summary.steps) / summary.wall_s;
    for (int p = 0; p < static_cast<int>(Phase::count); ++p) {
      const auto phase = static_cast<Phase>(p);
      summary.phases.emplace_back(std::string(name_of(phase)),
                                  communicator_.max(partition_.domain().timer.seconds(phase)));
    }
    summary.energy = partition_.domain().sample.budget;
    summary.max_rss_bytes =
        static_cast<std::uint64_t>(communicator_.sum(static_cast<std::int64_t>(max_resident_bytes())));
    summary.simd = std::string(name_of(partition_.domain().simd));
    summary.state_hash = hash_of(partition_.domain()).text();
    sink_group_.tell([&](Sink& sink) {
      sink.status(status_line());
      sink.finish(summary);
    });
    return summary;
  }

  [[nodiscard]] const Clock& clock() const { return partition_.state().clock; }

  const case_::Case& input_;
  SinkGroup sink_group_;
  Communicator communicator_;
  Partition partition_;
  Observer observer_;
  double end_;
  Schedule histories_, frames_;
  std::string stage_name_, status_ = "complete";
  std::int64_t frame_number_ = 0, last_fragments_ = 0, last_broken_ = 0;
  RunControl control_;
  bool paused_ = false, stop_commanded_ = false, extract_commanded_ = false;
  std::optional<InSituWatch> insitu_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace

Summary run_case(const case_::Case& input, std::unique_ptr<Model> whole,
                 const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator,
                 const RunFolder* folder) {
  return Runner(input, std::move(whole), sinks, communicator, folder).run();
}

}  // namespace breccia
