#include "advice/subject.hpp"

#include <cmath>

namespace breccia {

const std::vector<GroupOverlap>& Subject::overlaps() const {
  if (!overlaps_) {
    overlaps_ = std::make_unique<std::vector<GroupOverlap>>();
    if (begun_ == 0) *overlaps_ = overlaps_by_groups(model_);
  }
  return *overlaps_;
}

const AllJointMeasures& Subject::joints() const {
  if (!joints_) joints_ = std::make_unique<AllJointMeasures>(joint_measures(model_));
  return *joints_;
}

const StepAtStart& Subject::step() const {
  if (!step_) step_ = std::make_unique<StepAtStart>(input_, model_);
  return *step_;
}

double Subject::steps() const { return std::ceil((input_.stages.back().end - begun_) / step().dt()); }

FramesEstimate Subject::frames() const { return estimate_frames(input_, model_, begun_, steps()); }

}  // namespace breccia
