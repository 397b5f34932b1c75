#include "simulation/stage_steps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "model/time_step.hpp"
#include "simulation/countable_steps.hpp"

namespace breccia {
namespace {

constexpr std::int64_t kEvaluationInterval = 100;
constexpr std::int64_t kShortestInterval = 10;  // steps, after releases of joints, or while the step grows
constexpr std::int64_t kContactDelay = 2;       // steps until contact has the faces of a joint that was released
constexpr double kGrowth = 1.5;             // of the step at an evaluation: motions of a step predict those of the next
constexpr std::int64_t kGrowthDelay = 300;  // steps, see the class comment
constexpr double kDown = 0.99, kUp = 1.2;   // of the step: changes between are not made
constexpr double kMostTenths = 300;         // of the step at rest; limit of the reported number

/// How many times a step has come below a tenth of that at rest: 0 above a tenth, 1 above a hundredth, and so on.
int tenths(double share) { return static_cast<int>(std::clamp(-std::log10(share), 0.0, kMostTenths)); }

std::string number(double value) { return number_text(value, 3); }

/// The stable step in the places of the mesh, without contact, s. Collective. O(elements)
double step_at_rest(const Partition& partition) {
  const Model& model = partition.model();
  return partition.communicator().min(TimeStep(model).limit(model.local.reference));
}

/// What lengthens the step again, by what limits it.
const char* remedy_of(StepLimit limit) {
  switch (limit) {
    case StepLimit::contact:
      return "lower contact.penalty there";
    case StepLimit::joint:
      return "lower joint.penalty_factor (or joint.penalty) there";
    case StepLimit::element:
      break;
  }
  return "the element is crushed or drawn out: lower the speeds and loads there, use larger elements, or a material "
         "that breaks or yields";
}

}  // namespace

StageSteps::StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition,
                       const StepSchedule& schedule)
    : input_(input),
      stage_(stage),
      partition_(partition),
      schedule_(schedule),
      at_rest_(input.time.step > 0 ? 0.0 : step_at_rest(partition)) {}

StageSteps::StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition)
    : StageSteps(input, stage, partition, StepSchedule{.growth_steps = kGrowthDelay}) {
  partition_.begin_stage(stage);
  partition_.domain().state.clock.dt = length(allowed());
  demand_countable();
}

void StageSteps::demand_countable() const {
  const Clock& clock = partition_.state().clock;
  const double left = stage_.end - clock.time;
  if (!are_countable(left, clock.dt)) throw InputError(uncountable_steps(input_, stage_, left, clock.dt, limit()));
}

double StageSteps::length(double allowed) const {
  const double left = stage_.end - partition_.state().clock.time;
  return left / std::max(1.0, std::ceil(left / allowed * (1.0 - 1e-9)));
}

double StageSteps::allowed(const StepRange& range) {
  const std::int64_t growth_steps = schedule_.growth_steps + schedule_.since;
  schedule_ = {.until = kEvaluationInterval};
  if (input_.time.step > 0) return input_.time.step;
  const Clock& clock = partition_.state().clock;
  const double now = partition_.step_length(steps_to_look(), range);
  check_collapse(now);
  const double stable = input_.time.safety * now, most = kGrowth * clock.dt;
  if (clock.steps == 0 || stable <= most) return stable;
  schedule_.growth_steps = growth_steps;
  if (growth_steps < kGrowthDelay) return clock.dt;
  schedule_.until = kShortestInterval;
  return most;
}

void StageSteps::check_collapse(double stable) {
  const Clock& clock = partition_.state().clock;
  const double share = stable / at_rest_;
  const bool ends = share < kSmallestStep;
  // At the start of a run `check` has reported it.
  const bool fell = clock.steps > 0 && tenths(share) > tenths(clock.dt / (input_.time.safety * at_rest_));
  if (!ends && !fell) return;
  const double rest = input_.stages.back().end - clock.time;
  const StableStep limiter = limit();
  const std::string text = "step " + std::to_string(clock.steps) + ", time " + number(clock.time) +
                           " s: the stable step has fallen to " + number(stable) + " s, " + number(100 * share) +
                           " % of that of the model at rest, by " + limit_text(limiter) + "; the rest would take " +
                           number(rest / (input_.time.safety * stable)) + " steps; " + remedy_of(limiter.limit);
  if (ends) throw SimulationError(text + "; a time.step given in the case is not checked");
  warning_ = text;
}

void StageSteps::fit_end() {
  const StepSchedule before = schedule_;
  partition_.domain().state.clock.dt = length(allowed());
  schedule_ = before;
}

double StageSteps::steps_to_look() const {
  return (input_.time.step > 0 ? 1.0 : input_.time.safety) * kEvaluationInterval;
}

StableStep StageSteps::limit() const { return partition_.stable_step(steps_to_look()); }

void StageSteps::look() {
  if (partition_.state().signals.released)
    schedule_.until = std::min(schedule_.until, std::max(kContactDelay, kShortestInterval - schedule_.since));
  ++schedule_.since;
  const bool due = --schedule_.until == 0;
  if (input_.time.step > 0) return;
  if (due) adjust();
  if (at_last()) prepare_next();
}

void StageSteps::adjust() {
  const double most = allowed(unchanged()), now = partition_.state().clock.dt;
  // By more than 1 % down or 20 % up: a length that is kept leaves the limit a margin, and fits the end of the stage.
  if (most < kDown * now || length(most) > kUp * now) partition_.domain().state.clock.dt = length(most);
}

StepRange StageSteps::unchanged() const {
  constexpr double kRounding = 1e-6;
  const double dt = partition_.state().clock.dt, now = dt / input_.time.safety;
  const StepRange range{(kDown + kRounding) * now, (kUp - kRounding) * now};
  const double lowest = range.low / at_rest_;
  const bool warns = tenths(lowest) > tenths(dt / (input_.time.safety * at_rest_));
  return warns || lowest < kSmallestStep ? StepRange{} : range;
}

void StageSteps::prepare_next() {
  const auto stage =
      std::find_if(input_.stages.begin(), input_.stages.end(), [&](const case_::Stage& s) { return &s == &stage_; });
  if (stage == input_.stages.end() || std::next(stage) == input_.stages.end()) return;
  Clock& clock = partition_.domain().state.clock;
  const double stable = input_.time.safety * partition_.step_length(*std::next(stage), steps_to_look());
  if (stable < clock.dt) clock.dt = length(stable);
}

}  // namespace breccia
