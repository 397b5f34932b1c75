#include "simulation/run_output.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/version.hpp"
#include "domains/state_records.hpp"
#include "observe/body_names.hpp"
#include "observe/energy_sample.hpp"
#include "output/folder/history_sink.hpp"
#include "output/folder/run_folder.hpp"
#include "output/folder/summary.hpp"

namespace breccia {
namespace {

/// A sample of the energies costs about as much as a step: lines of the history at no given interval come no closer
/// than so many steps.
constexpr std::int64_t kStepsBetweenLines = 20;

/// @param length  s, of the run
Schedule history_schedule(const case_::Case& input, double length) {
  const double interval = input.output.history_interval;
  return interval > 0 ? Schedule(interval) : Schedule(length / 500, kStepsBetweenLines);
}

std::string scientific(double value) { return number_text(value, 6); }

}  // namespace

RunOutput::RunOutput(const case_::Case& input, const std::vector<std::unique_ptr<Sink>>& sinks, Partition& partition)
    : input_(input),
      sink_group_(sinks, partition.communicator()),
      partition_(partition),
      observer_(input, partition),
      histories_(history_schedule(input, end())),
      frames_(input.output.frame_interval),
      peaks_(case_::history_columns(input.output.gauges, input.gauges)) {}

void RunOutput::tell_event(const std::string& kind, const std::string& text, bool accepted, const std::string& id) {
  const RunEvent event{kind, text, id, accepted, clock().steps, clock().time};
  sink_group_.tell([&](Sink& sink) { sink.event(event); });
}

void RunOutput::start_from(const RunPosition& from) {
  start_time_ = clock().time;
  start_step_ = clock().steps;
  histories_ = history_schedule(input_, end() - start_time_);
  last_fragments_ = from.fragments;
  last_broken_ = from.broken_joints;
}

void RunOutput::tell_start(bool insitu, const RunPosition* from) {
  const RunStart start{input_.title,
                       partition_.whole().num_elements,
                       partition_.whole().num_joints,
                       input_.output.gauges,
                       input_.gauges,
                       insitu,
                       from != nullptr ? std::optional(from->marks) : std::nullopt,
                       body_names(partition_.domain())};
  if (from != nullptr) {
    histories_ = Schedule::from_numbers(from->histories);
    frames_ = Schedule::from_numbers(from->frames);
    frame_number_ = from->frame_number;
    last_fragments_ = from->fragments;
    last_broken_ = from->broken_joints;
    wall_before_ = from->wall;
    start_time_ = from->start_time;
    start_step_ = from->start_step;
    resumed_at_ = clock().steps;
    within_stage_ = true;
    sound_.step = clock().steps - 1;  // whether the run goes well from here on is not known yet
  }
  pace_.begin({wall(), share(), clock().steps});
  sink_group_.tell([&](Sink& sink) { sink.start(start); });
}

void RunOutput::begin_stage(const case_::Stage& stage) {
  stage_name_ = stage.name;
  observer_.begin_stage(stage);
  tell_of_frame_interval(std::exchange(within_stage_, false));
}

void RunOutput::tell_of_frame_interval(bool told_before) {
  const double interval = input_.output.frame_interval;
  if (frames_told_ || interval <= 0 || interval >= clock().dt) return;
  frames_told_ = true;
  if (told_before) return;
  tell_event("frames",
             "output.frame_interval = " + scientific(interval) + " s is shorter than a step, " +
                 scientific(clock().dt) + " s: every step writes a frame",
             false);
}

std::vector<double> RunOutput::take_line(double time, InSituWatch* insitu) {
  const auto timing = partition_.domain().timer.measure(Phase::output);
  HistoryRow row = observer_.row(time);
  if (insitu != nullptr) row.insitu_share = insitu->share_of_time();
  last_fragments_ = row.fragments;
  last_broken_ = row.broken_joints;
  if (insitu != nullptr) insitu->take_row(row);
  sink_group_.tell([&](Sink& sink) { sink.history(row); });
  std::vector<double> numbers = history_values(row);
  peaks_.add(numbers);
  return numbers;
}

void RunOutput::take_row(double time, InSituWatch& insitu) {
  const auto timing = partition_.domain().timer.measure(Phase::output);
  HistoryRow row = observer_.row(time);
  row.insitu_share = insitu.share_of_time();
  insitu.take_row(row);
}

void RunOutput::check_energies(double time) {
  const EnergySample& sample = partition_.domain().sample;
  const EnergyFault fault = energy_fault(sample.budget, input_.time.residual_limit, input_.time.energy_gain_limit);
  if (fault.what.empty()) {
    sound_ = {clock().steps, frame_number_ - 1};  // the sample holds the velocities that lead to this state
    return;
  }
  throw SimulationError("step " + std::to_string(clock().steps - 1) + ", time " + scientific(time) +
                        " s: " + fault.what + "; the strain energy is densest in element " +
                        std::to_string(sample.worst_element) + "; lower time.safety, or raise " + fault.key +
                        " if you trust the run");
}

void RunOutput::write_frame() {
  const auto timing = partition_.domain().timer.measure(Phase::output);
  const FrameParts parts{input_.output.elements, input_.output.joints, input_.output.contacts};
  const Frame frame = observer_.picture(frame_number_++, parts);
  sink_group_.tell([&](Sink& sink) { sink.frame(frame); });
}

std::int64_t RunOutput::broken_joints() const {
  return partition_.communicator().sum(partition_.state().joints.broken);
}

double RunOutput::wall() const {
  return wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

double RunOutput::share() const {
  const double share = (clock().time - start_time_) / (end() - start_time_);
  const std::int64_t most = input_.time.max_steps;  // which ends the run if it comes first
  return most > 0 ? std::max(share, static_cast<double>(steps_done()) / static_cast<double>(most)) : share;
}

StatusLine RunOutput::status_line(bool paused) {
  StatusLine line;
  const double left = end() - clock().time;
  line.step = clock().steps;
  // Where elements are crushed the step may shrink without end; a count beyond this cannot be distinguished from it.
  constexpr double kMostSteps = 1e18;
  line.steps_total = line.step + static_cast<std::int64_t>(std::llround(std::min(left / clock().dt, kMostSteps)));
  line.time = clock().time;
  line.end = end();
  line.share = share();
  if (const std::int64_t most = input_.time.max_steps; most > 0)
    line.steps_total = std::min(line.steps_total, start_step_ + most);
  line.wall_s = wall();
  const RecentPace::Pace pace = pace_.follow({line.wall_s, line.share, line.step}, paused);
  line.element_steps_per_s = static_cast<double>(partition_.whole().num_elements) * pace.steps_per_s;
  line.eta_s = pace.share_per_s > 0 ? (1.0 - line.share) / pace.share_per_s : -1.0;
  line.energy_residual = partition_.domain().sample.budget.residual_relative;
  line.broken_joints = last_broken_;
  line.fragments = last_fragments_;
  line.imbalance = partition_.imbalance();
  line.decompositions = partition_.decompositions();
  line.stage = stage_name_;
  line.paused = paused;
  return line;
}

Summary RunOutput::summary_of(const std::string& status) {
  Summary summary;
  const Provenance provenance = collect_provenance(program_version(), {});
  summary.title = input_.title;
  summary.version = provenance.version;
  summary.host = provenance.host;
  summary.status = status;
  summary.steps = clock().steps;
  summary.simulated_time = clock().time;
  summary.time_step = clock().dt;
  summary.ranks = partition_.communicator().size();
  summary.decompositions = partition_.decompositions();
  summary.imbalance = partition_.imbalance();
  summary.messages = partition_.communicator().sum(partition_.domain().messages());
  summary.message_bytes = partition_.communicator().sum(partition_.domain().bytes());
  summary.elements = partition_.whole().num_elements;
  summary.joints = partition_.whole().num_joints;
  summary.broken_joints = last_broken_ = broken_joints();
  summary.fragments = observer_.num_fragments();
  summary.searches = partition_.communicator().max(partition_.state().counters.searches);
  summary.inverted_elements = partition_.communicator().sum(partition_.state().counters.crushed);
  summary.wall_s = wall();
  summary.span_s = summary.wall_s - wall_before_;
  summary.resumed_at = resumed_at_;
  summary.element_steps_per_s =
      static_cast<double>(summary.elements) * static_cast<double>(steps_done()) / summary.wall_s;
  for (int p = 0; p < static_cast<int>(Phase::count); ++p) {
    const auto phase = static_cast<Phase>(p);
    summary.phases.emplace_back(std::string(name_of(phase)),
                                partition_.communicator().max(partition_.domain().timer.seconds(phase)));
  }
  summary.peaks = peaks_.reports();
  summary.energy = partition_.domain().sample.budget;
  summary.max_rss_bytes =
      static_cast<std::uint64_t>(partition_.communicator().sum(static_cast<std::int64_t>(max_resident_bytes())));
  summary.simd = std::string(name_of(partition_.domain().simd));
  summary.state_hash = hash_of(partition_.domain()).text();
  return summary;
}

RunPosition RunOutput::position() const {
  RunPosition position;
  position.histories = histories_.numbers();
  position.frames = frames_.numbers();
  position.frame_number = frame_number_;
  position.fragments = last_fragments_;
  position.broken_joints = broken_joints();
  position.wall = wall();
  position.start_time = start_time_;
  position.start_step = start_step_;
  position.peaks = peaks_.memory();
  position.marks = sink_group_.marks();
  return position;
}

Summary RunOutput::finish(const std::string& status, Reports reports, bool paused) {
  Summary summary = summary_of(status);
  summary.checkpoints = reports.checkpoints;
  summary.insitu = std::move(reports.insitu);
  summary.conditions = std::move(reports.conditions);
  sink_group_.tell([&](Sink& sink) {
    sink.status(status_line(paused));
    sink.finish(summary);
  });
  return summary;
}

}  // namespace breccia
