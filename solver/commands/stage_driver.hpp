#pragma once

#include <cstdint>
#include <optional>

#include "simulation/stage_steps.hpp"
#include "simulation/step.hpp"

namespace breccia {

/// Takes a partition through the stages of the case, step by step as in a run, without output.
class StageDriver {
 public:
  /// Begins the first stage. Collective.  @pre input and partition outlive this object
  StageDriver(const case_::Case& input, Partition& partition) : input_(input), partition_(partition) {
    steps_.emplace(input_, input_.stages[stage_], partition_);
  }
  /// Continues from a snapshot. @param schedule  of the driver of the snapshot
  StageDriver(const case_::Case& input, Partition& partition, std::size_t stage, const StepSchedule& schedule)
      : input_(input), partition_(partition), stage_(stage) {
    steps_.emplace(input_, input_.stages[stage_], partition_, schedule);
  }

  [[nodiscard]] bool over() const { return steps_->over() && stage_ + 1 == input_.stages.size(); }
  [[nodiscard]] const StepSchedule& schedule() const { return steps_->schedule(); }

  /// One step; a stage that ends with it is followed by the next one. Collective. @pre not over
  void step(bool stop) {
    steps_->look();
    breccia::step(partition_.domain(), {.signals = {.stop = stop}});
    partition_.keep_up();
    while (steps_->over() && !over()) steps_.emplace(input_, input_.stages[++stage_], partition_);
  }

 private:
  const case_::Case& input_;
  Partition& partition_;
  std::size_t stage_ = 0;
  std::optional<StageSteps> steps_;
};

}  // namespace breccia
