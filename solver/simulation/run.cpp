#include "simulation/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "output/channels.hpp"
#include "output/history_sink.hpp"
#include "output/insitu.hpp"
#include "output/schedule.hpp"
#include "output/summary.hpp"
#include "simulation/convert.hpp"
#include "simulation/frames.hpp"
#include "simulation/observe.hpp"
#include "simulation/run_control.hpp"
#include "simulation/share.hpp"
#include "simulation/stage_steps.hpp"

namespace breccia {

std::atomic<bool> stop_requested{false};

namespace {

/// Taking stock costs about as much as a step: lines of the history that nobody has ordered come no closer than so many steps.
constexpr std::int64_t kStepsBetweenLines = 20;

/// An order of the root besides those for pipelines, whose bits are below.
constexpr std::uint64_t kControlOrder = std::uint64_t{1} << 32;

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
        sinks_(sinks),
        communicator_(communicator),
        share_(input, communicator, std::move(whole)),
        end_(input.stages.back().end),
        histories_(input.output.history_interval > 0 ? Schedule(input.output.history_interval) : Schedule(end_ / 500, kStepsBetweenLines)),
        frames_(input.output.frame_interval),
        control_(folder != nullptr ? std::optional(folder->control()) : std::nullopt, communicator) {
    if (folder == nullptr || !input.insitu.asked_for()) return;
    communicator_.set_phase("start of the in-situ adaptor");
    insitu_.emplace(input, folder->extracts(), communicator_, [this](const std::string& text, bool good) { tell_event("insitu", text, good); });
    columns_ = history_columns(input.output.gauges, true);
  }

  Summary run() {
    tell_start();
    try {
      for (std::size_t s = 0; s < input_.stages.size() && status_ == "complete"; ++s) run_stage(input_.stages[s]);
      stepper().conclude();
      write_frame();
      look_in_situ(true);
    } catch (const SimulationError& error) {
      finish(error.what());
      throw;
    } catch (const OutputError& error) {
      if (insitu_ && insitu_->failed()) finish(error.what());
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

  void tell_event(const std::string& kind, const std::string& text, bool accepted, const std::string& id = {}) {
    const RunEvent event{kind, text, id, accepted, stepper().steps(), stepper().time()};
    tell([&](Sink& sink) { sink.event(event); });
  }

  void tell_start() {
    const RunStart start{input_.title, share_.whole().num_elements, share_.whole().num_joints, input_.output.gauges, insitu_.has_value()};
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
      if (stepper().heard().stop || stop_commanded_) status_ = "stopped: by request";
      if (input_.time.max_steps > 0 && stepper().steps() >= input_.time.max_steps) status_ = "stopped: time.max_steps reached";
      if (status_ != "complete") return;
    }
  }

  void advance() {
    if ((stepper().heard().orders & kControlOrder) != 0) obey(control_.hear());
    if (paused_) stay_paused();
    const double time = stepper().time();
    if (frames_.due(time, stepper().dt(), stepper().steps())) write_frame();
    look_in_situ(false);
    const bool sample = histories_.due(time, stepper().dt(), stepper().steps());
    stepper().step(sample, word());
    if (sample) take_line(time);
    tell_status();
    share_.keep_up();
  }

  /// What this rank has to tell the others.
  Word word() {
    Word word{.stop = stop_requested};
    if (control_.asks()) word.orders |= kControlOrder;
    if (!insitu_) return word;
    word.orders |= insitu_->orders();
    word.broke = insitu_->counts_broken() && stepper().broken_joints() != counted_broken_;
    return word;
  }

  void take_line(double time) {
    HistoryRow row = make_history_row(stepper(), gauges_, time);
    if (insitu_) row.insitu_share = insitu_->share();
    last_fragments_ = row.fragments;
    last_broken_ = row.broken_joints;
    if (insitu_ && communicator_.is_root()) last_row_ = history_values(row);
    tell([&](Sink& sink) { sink.history(row); });
    check_residual(time);
  }

  /// Lets the pipelines that are due work on the present state. @param all  every one of them, whatever it costs
  void look_in_situ(bool all) {
    if (!insitu_) return;
    if (stepper().heard().broke) {
      counted_broken_ = stepper().broken_joints();
      broken_everywhere_ = communicator_.sum(counted_broken_);
    }
    const Moment now{stepper().steps(), stepper().time(), stepper().dt(), broken_everywhere_};
    const auto lap = stepper().timer().measure(Phase::insitu);
    communicator_.set_phase("in-situ pipelines");
    const auto ordered = static_cast<std::uint32_t>(stepper().heard().orders & ~kControlOrder);
    const InSitu::Plan plan = insitu_->plan(now, ordered, all || std::exchange(extract_commanded_, false));
    if (!plan) return;
    insitu_->execute(plan, picture(0, parts_of(plan.channels)), columns_, last_row_);
    obey_scripts();
  }

  /// What scripts ask of the run is what a person may ask as well.
  void obey_scripts() {
    const BrecciaRequests& asked = insitu_->requests();
    const std::array<double, 4> mine{double(asked.pause), double(asked.stop), double(asked.extract), asked.frame_interval};
    const std::vector<std::vector<double>> all = communicator_.all_gather(std::span<const double>(mine));
    const std::vector<double>& roots = all.front();
    std::vector<Command> commands;
    const auto add = [&](Command::Kind kind, const char* text, double value) {
      if (value > 0) commands.push_back({kind, value, std::string(text) + ", asked for by a script", "", ""});
    };
    add(Command::Kind::frame_interval, "frame_interval", roots[3]);
    add(Command::Kind::extract, "extract", roots[2]);
    add(Command::Kind::pause, "pause", roots[0]);
    add(Command::Kind::stop, "stop", roots[1]);
    obey(commands);
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
        frames_.change(command.value, stepper().time(), stepper().dt());
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
      obey(control_.hear());
      if (std::exchange(extract_commanded_, false)) look_in_situ(true);
      if (communicator_.max(static_cast<std::int64_t>(stop_requested)) != 0) paused_ = false;
      tell_status();
    }
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
    const Frame frame = picture(frame_number_++, parts);
    tell([&](Sink& sink) { sink.frame(frame); });
  }

  [[nodiscard]] Frame picture(std::int64_t number, const FrameParts& parts) const {
    const bool tells_cost = parts.elements || parts.surface;
    return make_frame(stepper(), number, parts, tells_cost ? share_.costs() : std::vector<double>{}, share_.load());
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
  RunControl control_;
  bool paused_ = false, stop_commanded_ = false, extract_commanded_ = false;
  std::optional<InSitu> insitu_;
  std::vector<std::string> columns_;                 ///< of the history
  std::optional<std::vector<double>> last_row_;      ///< of the history, on the root
  std::int64_t counted_broken_ = 0, broken_everywhere_ = 0;  ///< joints, of this rank and of all, when they were last counted
  std::int64_t gauged_ = 0;  ///< decomposition for which the gauges were made
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace

Summary run_case(const case_::Case& input, std::unique_ptr<Model> whole, const std::vector<std::unique_ptr<Sink>>& sinks,
                 const Communicator& communicator, const RunFolder* folder) {
  return Runner(input, std::move(whole), sinks, communicator, folder).run();
}

}  // namespace breccia
