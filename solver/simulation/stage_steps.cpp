#include "simulation/stage_steps.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

constexpr std::int64_t kStepsBetweenLooks = 100;
constexpr std::int64_t kSoonest = 10;  // steps between looks where joints come apart
constexpr std::int64_t kTaken = 2;     // steps until contact has the faces of a joint that was released

}  // namespace

StageSteps::StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition)
    : StageSteps(input, stage, partition, kStepsBetweenLooks) {
  partition_.begin_stage(stage);
  partition_.domain().state.clock.dt = length();
}

double StageSteps::length() const {
  const double safety = input_.time.safety;
  const double allowed = input_.time.step > 0 ? input_.time.step : safety * limit().step;
  const double left = stage_.end - partition_.state().clock.time;
  return left / std::max(1.0, std::ceil(left / allowed * (1.0 - 1e-9)));
}

StableStep StageSteps::limit() const {
  return partition_.stable_step((input_.time.step > 0 ? 1.0 : input_.time.safety) * kStepsBetweenLooks);
}

void StageSteps::look() {
  if (partition_.state().signals.released)
    until_look_ = std::min(until_look_, std::max(kTaken, until_look_ - (kStepsBetweenLooks - kSoonest)));
  if (--until_look_ != 0 || input_.time.step > 0) return;
  until_look_ = kStepsBetweenLooks;
  const double dt = length(), now = partition_.state().clock.dt;
  // By more than 1 % down or 20 % up: a length that is kept leaves the limit a margin.
  if (dt < 0.99 * now || dt > 1.2 * now) partition_.domain().state.clock.dt = dt;
}

}  // namespace breccia
