#include "simulation/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.hpp"
#include "output/run_folder.hpp"
#include "output/summary.hpp"
#include "simulation/convert.hpp"
#include "simulation/observe.hpp"
#include "simulation/stepper.hpp"
#include "simulation/time_step.hpp"

namespace breccia {

std::atomic<bool> stop_requested{false};

namespace {

/// Steps between two looks at the stable step, which shrinks when elements are crushed.
constexpr std::int64_t kStepsBetweenChecks = 100;

/// Times at which something is due: 0, interval, 2 interval, ...; never twice in one step.
class Schedule {
 public:
  explicit Schedule(double interval) : interval_(interval) {}
  /// True when the next due time lies within the step that begins at `time`; moves on.
  bool due(double time, double dt) {
    if (interval_ <= 0 || time + 0.5 * dt < interval_ * static_cast<double>(next_)) return false;
    next_ = static_cast<std::int64_t>(std::floor((time + 0.5 * dt) / interval_)) + 1;
    return true;
  }

 private:
  double interval_;
  std::int64_t next_ = 0;
};

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class Runner {
 public:
  Runner(const case_::Case& input, const Model& model, const std::vector<std::unique_ptr<Sink>>& sinks)
      : input_(input),
        model_(model),
        sinks_(sinks),
        stepper_(model, search_params(input, model)),
        time_step_(model),
        end_(input.stages.back().end),
        histories_(input.output.history_interval > 0 ? input.output.history_interval : end_ / 500),
        frames_(input.output.frame_interval) {
    for (const case_::InitialVelocity& entry : input.initial_velocities) stepper_.add_velocity(initial_velocity(entry, model));
    make_gauges();
  }

  Summary run() {
    tell_start();
    try {
      for (std::size_t s = 0; s < input_.stages.size() && status_ == "complete"; ++s) run_stage(input_.stages[s]);
      write_frame();
    } catch (const SimulationError& error) {
      finish(error.what());
      throw;
    }
    return finish(status_);
  }

 private:
  void tell_start() {
    RunStart start{input_.title, model_.mesh.num_elements(), static_cast<std::int64_t>(model_.joints.size()), {}};
    for (const Gauge& gauge : gauges_) start.gauges.push_back(gauge.group);
    for (const auto& sink : sinks_) sink->start(start);
  }

  void make_gauges() {
    for (const std::string& group : input_.output.gauges) {
      Gauge gauge;
      gauge.group = group;
      gauge.nodes = nodes_of_group(model_, group);
      const auto& names = model_.mesh.volume_groups;
      const auto found = std::find(names.begin(), names.end(), group);
      if (found != names.end()) gauge.volume_group = static_cast<Index>(found - names.begin());
      gauges_.push_back(std::move(gauge));
    }
  }

  void begin_stage(const case_::Stage& stage) {
    stage_name_ = stage.name;
    for (Gauge& gauge : gauges_) {
      gauge.constraints.clear();
      for (std::size_t c = 0; c < stage.constraints.size(); ++c) {
        if (stage.constraints[c].group == gauge.group) gauge.constraints.push_back(c);
      }
    }
    for (const std::string& surface : stage.broken_surfaces) stepper_.break_joints(faces_of_surface(model_, surface));
    stepper_.begin_stage(stage_loads(stage, model_), step_to(stage.end));
  }

  /// Length of the next steps: what is allowed, shortened so that a whole number of them ends at `end`.
  double step_to(double end) {
    const double allowed =
        input_.time.step > 0 ? input_.time.step : input_.time.safety * time_step_.limit(stepper_.state().position);
    const double left = end - stepper_.time();
    return left / std::max(1.0, std::ceil(left / allowed * (1.0 - 1e-9)));
  }

  void run_stage(const case_::Stage& stage) {
    begin_stage(stage);
    std::int64_t until_check = kStepsBetweenChecks;
    while (stepper_.time() < stage.end - 0.5 * stepper_.dt()) {
      if (--until_check == 0 && input_.time.step <= 0) {
        until_check = kStepsBetweenChecks;
        const double dt = step_to(stage.end);
        // Follow a shrinking limit at once, a growing one only when it is worth it.
        if (dt < 0.99 * stepper_.dt() || dt > 1.2 * stepper_.dt()) stepper_.set_dt(dt);
      }
      advance();
      if (stop_requested) status_ = "stopped: by request";
      if (input_.time.max_steps > 0 && stepper_.steps() >= input_.time.max_steps) status_ = "stopped: time.max_steps reached";
      if (status_ != "complete") return;
    }
  }

  void advance() {
    const double time = stepper_.time();
    if (frames_.due(time, stepper_.dt())) write_frame();
    const bool sample = histories_.due(time, stepper_.dt());
    stepper_.step(sample);
    if (sample) {
      const HistoryRow row = make_history_row(stepper_, gauges_, time);
      last_fragments_ = row.fragments;
      for (const auto& sink : sinks_) sink->history(row);
      check_residual(time);
    }
    for (const auto& sink : sinks_) {
      if (sink->status_due()) sink->status(status_line());
    }
  }

  void check_residual(double time) const {
    const EnergyBudget& e = stepper_.budget();
    if (!(e.residual_relative > input_.time.residual_limit) && std::isfinite(e.residual)) return;
    throw SimulationError("step " + std::to_string(stepper_.steps() - 1) + ", time " + scientific(time) + " s: the energy residual is " +
                          scientific(100 * e.residual_relative) + " % of the largest term (limit " +
                          scientific(100 * input_.time.residual_limit) + " %); the strain energy is densest in element " +
                          std::to_string(stepper_.worst_element()) + "; lower time.safety, or raise time.residual_limit if you trust the run");
  }

  void write_frame() {
    const auto lap = stepper_.timer().measure(Phase::output);
    const FrameParts parts{input_.output.elements, input_.output.joints, input_.output.contacts};
    const Frame frame = make_frame(stepper_, frame_number_++, parts);
    for (const auto& sink : sinks_) sink->frame(frame);
  }

  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

  StatusLine status_line() {
    StatusLine line;
    const double left = end_ - stepper_.time();
    line.step = stepper_.steps();
    line.steps_total = line.step + static_cast<std::int64_t>(std::llround(left / stepper_.dt()));
    line.time = stepper_.time();
    line.end = end_;
    line.share = stepper_.time() / end_;
    line.wall_s = wall();
    line.element_steps_per_s = static_cast<double>(model_.mesh.num_elements()) * static_cast<double>(line.step) / line.wall_s;
    line.eta_s = line.share > 0 ? line.wall_s * (1.0 - line.share) / line.share : -1.0;
    line.energy_residual = stepper_.budget().residual_relative;
    line.broken_joints = stepper_.broken_joints();
    line.fragments = last_fragments_;
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
    summary.steps = stepper_.steps();
    summary.simulated_time = stepper_.time();
    summary.time_step = stepper_.dt();
    summary.elements = model_.mesh.num_elements();
    summary.joints = static_cast<std::int64_t>(model_.joints.size());
    summary.broken_joints = stepper_.broken_joints();
    summary.fragments = find_fragments(stepper_).count;
    summary.searches = stepper_.contact() != nullptr ? stepper_.contact()->num_searches() : 0;
    summary.inverted_elements = stepper_.crushed();
    summary.wall_s = wall();
    summary.element_steps_per_s = static_cast<double>(summary.elements) * static_cast<double>(summary.steps) / summary.wall_s;
    for (int p = 0; p < static_cast<int>(Phase::count); ++p) {
      const auto phase = static_cast<Phase>(p);
      summary.phases.emplace_back(std::string(name_of(phase)), stepper_.timer().seconds(phase));
    }
    summary.energy = stepper_.budget();
    summary.max_rss_bytes = max_resident_bytes();
    summary.simd = std::string(name_of(stepper_.simd()));
    summary.state_hash = hash_of(stepper_).text();
    for (const auto& sink : sinks_) {
      sink->status(status_line());
      sink->finish(summary);
    }
    return summary;
  }

  const case_::Case& input_;
  const Model& model_;
  const std::vector<std::unique_ptr<Sink>>& sinks_;
  Stepper stepper_;
  TimeStep time_step_;
  double end_;
  Schedule histories_, frames_;
  std::vector<Gauge> gauges_;
  std::string stage_name_, status_ = "complete";
  std::int64_t frame_number_ = 0, last_fragments_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace

Summary run_case(const case_::Case& input, const Model& model, const std::vector<std::unique_ptr<Sink>>& sinks) {
  return Runner(input, model, sinks).run();
}

}  // namespace breccia
