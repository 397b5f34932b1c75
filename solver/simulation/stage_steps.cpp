#include "simulation/stage_steps.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

constexpr std::int64_t kStepsBetweenLooks = 100;

}  // namespace

StageSteps::StageSteps(const case_::Case& input, const case_::Stage& stage, Share& share)
    : StageSteps(input, stage, share, kStepsBetweenLooks) {
  share_.begin_stage(stage, length());
}

double StageSteps::length() const {
  const double allowed = input_.time.step > 0 ? input_.time.step : input_.time.safety * share_.stable_step();
  const double left = stage_.end - share_.stepper().time();
  return left / std::max(1.0, std::ceil(left / allowed * (1.0 - 1e-9)));
}

void StageSteps::look() {
  if (--until_look_ != 0 || input_.time.step > 0) return;
  until_look_ = kStepsBetweenLooks;
  const double dt = length(), now = share_.stepper().dt();
  // Follow a shrinking limit at once, a growing one only when it is worth it.
  if (dt < 0.99 * now || dt > 1.2 * now) share_.stepper().set_dt(dt);
}

}  // namespace breccia
