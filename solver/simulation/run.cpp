#include "simulation/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "output/run_folder.hpp"
#include "output/summary.hpp"
#include "simulation/convert.hpp"
#include "simulation/observe.hpp"
#include "simulation/share.hpp"
#include "simulation/stage_steps.hpp"

namespace breccia {

std::atomic<bool> stop_requested{false};

namespace {

/// Taking stock costs about as much as a step: lines of the history that nobody has ordered come no closer than so many steps.
constexpr std::int64_t kStepsBetweenLines = 20;

/// Times at which something is due: 0, interval, 2 interval, ...; never twice within `least_steps`.
class Schedule {
 public:
  explicit Schedule(double interval, std::int64_t least_steps = 1) : interval_(interval), least_steps_(least_steps) {}
  /// True when the next due time lies before the end of the step that begins at `time`; moves on.
  bool due(double time, double dt, std::int64_t step) {
    if (interval_ <= 0 || step < free_step_ || time + 0.5 * dt < interval_ * static_cast<double>(next_)) return false;
    next_ = static_cast<std::int64_t>(std::floor((time + 0.5 * dt) / interval_)) + 1;
    free_step_ = step + least_steps_;
    return true;
  }

 private:
  double interval_;
  std::int64_t least_steps_, free_step_ = 0;
  std::int64_t next_ = 0;
};

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class Runner {
 public:
  Runner(const case_::Case& input, std::unique_ptr<Model> whole, const std::vector<std::unique_ptr<Sink>>& sinks,
         const Communicator& communicator)
      : input_(input),
        sinks_(sinks),
        communicator_(communicator),
        share_(input, communicator, std::move(whole)),
        end_(input.stages.back().end),
        histories_(input.output.history_interval > 0 ? Schedule(input.output.history_interval) : Schedule(end_ / 500, kStepsBetweenLines)),
        frames_(input.output.frame_interval) {}

  Summary run() {
    tell_start();
    try {
      for (std::size_t s = 0; s < input_.stages.size() && status_ == "complete"; ++s) run_stage(input_.stages[s]);
      stepper().conclude();
      write_frame();
    } catch (const SimulationError& error) {
      finish(error.what());
      throw;
    }
    return finish(status_);
  }

 private:
  /// What concerns sinks concerns all ranks: an error on one is an error on all.
  template <class Tell>
  void tell(Tell&& tell_one) {
    communicator_.set_phase("output");
    communicator_.agree([&] {
      if (status_error_) throw OutputError(*status_error_);
      for (const auto& sink : sinks_) tell_one(*sink);
    });
  }

  /// Only the clock of the rank with such a sink knows when: what goes wrong waits until all ranks speak next.
  void tell_status() {
    try {
      for (const auto& sink : sinks_) {
        if (sink->status_due()) sink->status(status_line());
      }
    } catch (const OutputError& error) {
      if (!status_error_) status_error_ = error;
    }
  }

  void tell_start() {
    const RunStart start{input_.title, share_.whole().num_elements, share_.whole().num_joints, input_.output.gauges};
    tell([&](Sink& sink) { sink.start(start); });
  }

  /// The groups' nodes on this rank as it is now.
  void make_gauges(const case_::Stage& stage) {
    gauges_.clear();
    gauged_ = share_.decompositions();
    for (const std::string& group : input_.output.gauges) {
      Gauge gauge;
      gauge.group = group;
      gauge.nodes = counted_nodes_of_group(share_.model(), group);
      const auto& names = share_.model().mesh.volume_groups;
      const auto found = std::find(names.begin(), names.end(), group);
      if (found != names.end()) gauge.volume_group = static_cast<Index>(found - names.begin());
      for (std::size_t c = 0; c < stage.constraints.size(); ++c) {
        if (stage.constraints[c].group == gauge.group) gauge.constraints.push_back(c);
      }
      gauges_.push_back(std::move(gauge));
    }
  }

  void run_stage(const case_::Stage& stage) {
    stage_name_ = stage.name;
    StageSteps steps(input_, stage, share_);
    make_gauges(stage);
    while (!steps.over()) {
      steps.look();
      if (gauged_ != share_.decompositions()) make_gauges(stage);
      advance();
      if (stepper().stop_agreed()) status_ = "stopped: by request";
      if (input_.time.max_steps > 0 && stepper().steps() >= input_.time.max_steps) status_ = "stopped: time.max_steps reached";
      if (status_ != "complete") return;
    }
  }

  void advance() {
    const double time = stepper().time();
    if (frames_.due(time, stepper().dt(), stepper().steps())) write_frame();
    const bool sample = histories_.due(time, stepper().dt(), stepper().steps());
    stepper().step(sample, stop_requested);
    if (sample) {
      const HistoryRow row = make_history_row(stepper(), gauges_, time);
      last_fragments_ = row.fragments;
      last_broken_ = row.broken_joints;
      tell([&](Sink& sink) { sink.history(row); });
      check_residual(time);
    }
    tell_status();
    share_.keep_up();
  }

  void check_residual(double time) const {
    const EnergyBudget& e = stepper().budget();
    if (!(e.residual_relative > input_.time.residual_limit) && std::isfinite(e.residual)) return;
    throw SimulationError("step " + std::to_string(stepper().steps() - 1) + ", time " + scientific(time) + " s: the energy residual is " +
                          scientific(100 * e.residual_relative) + " % of the largest term (limit " +
                          scientific(100 * input_.time.residual_limit) + " %); the strain energy is densest in element " +
                          std::to_string(stepper().worst_element()) + "; lower time.safety, or raise time.residual_limit if you trust the run");
  }

  void write_frame() {
    const auto lap = stepper().timer().measure(Phase::output);
    const FrameParts parts{input_.output.elements, input_.output.joints, input_.output.contacts};
    const Frame frame = make_frame(stepper(), frame_number_++, parts, share_.costs());
    tell([&](Sink& sink) { sink.frame(frame); });
  }

  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

  StatusLine status_line() {
    StatusLine line;
    const double left = end_ - stepper().time();
    line.step = stepper().steps();
    line.steps_total = line.step + static_cast<std::int64_t>(std::llround(left / stepper().dt()));
    line.time = stepper().time();
    line.end = end_;
    line.share = stepper().time() / end_;
    line.wall_s = wall();
    line.element_steps_per_s = static_cast<double>(share_.whole().num_elements) * static_cast<double>(line.step) / line.wall_s;
    line.eta_s = line.share > 0 ? line.wall_s * (1.0 - line.share) / line.share : -1.0;
    line.energy_residual = stepper().budget().residual_relative;
    line.broken_joints = last_broken_;
    line.fragments = last_fragments_;
    line.imbalance = share_.imbalance();
    line.decompositions = share_.decompositions();
    line.stage = stage_name_;
    return line;
  }

  Summary finish(const std::string& status) {
    if (status != status_) write_frame();  // after an error: the last picture
    Summary summary;
    const Provenance provenance = collect_provenance(BRECCIA_VERSION, {});
    summary.title = input_.title;
    summary.version = provenance.version;
    summary.host = provenance.host;
    summary.status = status;
    summary.steps = stepper().steps();
    summary.simulated_time = stepper().time();
    summary.time_step = stepper().dt();
    summary.ranks = communicator_.size();
    summary.decompositions = share_.decompositions();
    summary.imbalance = share_.imbalance();
    summary.messages = communicator_.sum(stepper().messages());
    summary.message_bytes = communicator_.sum(stepper().bytes());
    summary.elements = share_.whole().num_elements;
    summary.joints = share_.whole().num_joints;
    summary.broken_joints = last_broken_ = communicator_.sum(stepper().broken_joints());
    summary.fragments = find_fragments(stepper()).count;
    summary.searches = communicator_.max(stepper().searches());
    summary.inverted_elements = communicator_.sum(stepper().crushed());
    summary.wall_s = wall();
    summary.element_steps_per_s = static_cast<double>(summary.elements) * static_cast<double>(summary.steps) / summary.wall_s;
    for (int p = 0; p < static_cast<int>(Phase::count); ++p) {
      const auto phase = static_cast<Phase>(p);
      summary.phases.emplace_back(std::string(name_of(phase)), communicator_.max(stepper().timer().seconds(phase)));
    }
    summary.energy = stepper().budget();
    summary.max_rss_bytes = static_cast<std::uint64_t>(communicator_.sum(static_cast<std::int64_t>(max_resident_bytes())));
    summary.simd = std::string(name_of(stepper().simd()));
    summary.state_hash = hash_of(stepper()).text();
    tell([&](Sink& sink) {
      sink.status(status_line());
      sink.finish(summary);
    });
    return summary;
  }

  [[nodiscard]] Stepper& stepper() { return share_.stepper(); }
  [[nodiscard]] const Stepper& stepper() const { return share_.stepper(); }

  const case_::Case& input_;
  const std::vector<std::unique_ptr<Sink>>& sinks_;
  Communicator communicator_;
  Share share_;
  double end_;
  Schedule histories_, frames_;
  std::vector<Gauge> gauges_;
  std::string stage_name_, status_ = "complete";
  std::int64_t frame_number_ = 0, last_fragments_ = 0, last_broken_ = 0;
  std::optional<OutputError> status_error_;
  std::int64_t gauged_ = 0;  ///< decomposition for which the gauges were made
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace

Summary run_case(const case_::Case& input, std::unique_ptr<Model> whole, const std::vector<std::unique_ptr<Sink>>& sinks,
                 const Communicator& communicator) {
  return Runner(input, std::move(whole), sinks, communicator).run();
}

}  // namespace breccia
