#include "simulation/insitu_watch.hpp"

#include <array>
#include <span>
#include <utility>

#include "output/folder/history_sink.hpp"
#include "output/insitu/channels.hpp"

namespace breccia {

InSituWatch::InSituWatch(const case_::Case& input, const std::filesystem::path& extracts, Partition& partition,
                         InSitu::Tell tell)
    : partition_(partition),
      insitu_(input, extracts, partition.communicator(), std::move(tell)),
      columns_(history_columns(input.output.gauges, input.gauges, true)) {}

void InSituWatch::start_from(Moment first, const RunPosition* from) {
  count_broken();
  BrokenCount count{broken_everywhere_, broken_everywhere_};
  if (from != nullptr) count = from->broken_count;
  if (!count.due && count.known != broken_everywhere_) {  // ranks have yet to signal it
    broken_everywhere_ = count.known;
    broken_here_ = -1;
  }
  if (count.due_next) count_at_ = partition_.state().clock.steps + 1;
  first.broken = broken_at_start_ = count.at_start;
  insitu_.start_from(first, count.known);
}

BrokenCount InSituWatch::broken_count() const {
  const Signals& signals = partition_.state().signals;
  const std::int64_t sent = partition_.communicator().max(static_cast<std::int64_t>(signals.sent.broke));
  return {broken_at_start_, broken_everywhere_, signals.received.broke, sent != 0};
}

void InSituWatch::add_signals(StepSignals& signals) {
  signals.orders |= insitu_.orders();
  signals.broke = insitu_.counts_broken() && partition_.state().joints.broken != broken_here_;
}

void InSituWatch::take_row(const HistoryRow& row) {
  row_step_ = row.step;
  if (partition_.communicator().is_root()) last_row_ = history_values(row);
}

void InSituWatch::count_broken() {
  broken_here_ = partition_.state().joints.broken;
  broken_everywhere_ = partition_.communicator().sum(broken_here_);
}

std::vector<Command> InSituWatch::look(Observer& observer, bool all) {
  Domain& domain = partition_.domain();
  if (domain.state.signals.received.broke || domain.state.clock.steps == count_at_) count_broken();
  const Moment now{domain.state.clock.steps, domain.state.clock.time, domain.state.clock.dt, broken_everywhere_};
  const auto timing = domain.timer.measure(Phase::insitu);
  partition_.communicator().set_phase("in-situ pipelines");
  const auto ordered =
      static_cast<std::uint32_t>(domain.state.signals.received.orders);  // the lower half is for pipelines
  InSitu::Plan plan = insitu_.plan(now, ordered, all);
  if (plan.rows != 0) {
    if (!delayed_) delayed_ = Delayed{{0, std::uint32_t{1} << BRECCIA_HISTORY, 0}, observer.picture(0, parts_of(0))};
    delayed_->plan.pipelines |= plan.rows;
    plan.pipelines &= ~plan.rows;
  }
  if (!plan) return {};
  insitu_.execute(plan, observer.picture(0, parts_of(plan.channels)), columns_, last_row_);
  return asked_by_scripts();
}

void InSituWatch::execute_delayed() {
  if (!delayed_) return;
  const auto timing = partition_.domain().timer.measure(Phase::insitu);
  partition_.communicator().set_phase("in-situ pipelines");
  const Delayed delayed = std::move(*delayed_);
  delayed_.reset();
  given_step_ = row_step_;
  insitu_.execute_delayed(delayed.plan, delayed.frame, columns_, last_row_);
}

/// The last state has no step that finds its row: pipelines get the last one, unless they have it.
std::vector<PipelineReport> InSituWatch::finish() {
  if (row_step_ != given_step_) execute_delayed();
  return insitu_.finish();
}

std::vector<Command> InSituWatch::asked_by_scripts() const {
  const BrecciaRequests& asked = insitu_.requests();
  const std::array<double, 4> mine{double(asked.pause), double(asked.stop), double(asked.extract),
                                   asked.frame_interval};
  const std::vector<double> roots = partition_.communicator().all_gather(std::span<const double>(mine)).front();
  std::vector<Command> commands;
  const auto add = [&](Command::Kind kind, const char* text, double value) {
    if (value > 0) commands.push_back({kind, value, std::string(text) + ", requested by a script", "", ""});
  };
  add(Command::Kind::frame_interval, "frame_interval", roots[3]);
  add(Command::Kind::extract, "extract", roots[2]);
  add(Command::Kind::pause, "pause", roots[0]);
  add(Command::Kind::stop, "stop", roots[1]);
  return commands;
}

}  // namespace breccia
