#include "simulation/stage_steps.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "simulation/countable_steps.hpp"

namespace breccia {
namespace {

constexpr std::int64_t kStepsBetweenLooks = 100;
constexpr std::int64_t kSoonest = 10;  // steps between looks where joints come apart, or the step is still to grow
constexpr std::int64_t kTaken = 2;     // steps until contact has the faces of a joint that was released
constexpr double kGrowth = 1.5;        // of the step at a look: motions of a step foretell those of the next

}  // namespace

StageSteps::StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition)
    : StageSteps(input, stage, partition, StepLooks{}) {
  partition_.begin_stage(stage);
  partition_.domain().state.clock.dt = next_length();
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

double StageSteps::next_length() {
  looks_ = {kStepsBetweenLooks, 0};
  if (input_.time.step > 0) return length(input_.time.step);
  const Clock& clock = partition_.state().clock;
  const double stable = input_.time.safety * limit().step, most = kGrowth * clock.dt;
  if (clock.steps == 0 || stable <= most) return length(stable);
  looks_.until = kSoonest;
  return length(most);
}

void StageSteps::fit_end() {
  const StepLooks before = looks_;
  partition_.domain().state.clock.dt = next_length();
  looks_ = before;
}

StableStep StageSteps::limit() const {
  return partition_.stable_step((input_.time.step > 0 ? 1.0 : input_.time.safety) * kStepsBetweenLooks);
}

void StageSteps::look() {
  if (partition_.state().signals.released)
    looks_.until = std::min(looks_.until, std::max(kTaken, kSoonest - looks_.since));
  ++looks_.since;
  if (--looks_.until != 0 || input_.time.step > 0) return;
  const double dt = next_length(), now = partition_.state().clock.dt;
  // By more than 1 % down or 20 % up: a length that is kept leaves the limit a margin.
  if (dt < 0.99 * now || dt > 1.2 * now) partition_.domain().state.clock.dt = dt;
}

}  // namespace breccia
