#pragma once

#include <cstdint>
#include <optional>

#include "simulation/stage_steps.hpp"

namespace breccia {

/// A share on its way through the stages of the case, step by step as in a run, without anybody being told.
class Course {
 public:
  /// Begins the first stage. Collective.  @pre input and share outlive this object
  Course(const case_::Case& input, Share& share) : input_(input), share_(share) {
    steps_.emplace(input_, input_.stages[stage_], share_);
  }
  /// Goes on from a snapshot. @param until_look  of the course that it was taken of
  Course(const case_::Case& input, Share& share, std::size_t stage, std::int64_t until_look)
      : input_(input), share_(share), stage_(stage) {
    steps_.emplace(input_, input_.stages[stage_], share_, until_look);
  }

  [[nodiscard]] bool over() const { return steps_->over() && stage_ + 1 == input_.stages.size(); }
  [[nodiscard]] std::int64_t until_look() const { return steps_->until_look(); }

  /// One step; a stage that ends with it is followed by the next one. Collective. @pre not over
  void step(bool stop) {
    steps_->look();
    share_.stepper().step(false, {.stop = stop});
    share_.keep_up();
    while (steps_->over() && !over()) steps_.emplace(input_, input_.stages[++stage_], share_);
  }

 private:
  const case_::Case& input_;
  Share& share_;
  std::size_t stage_ = 0;
  std::optional<StageSteps> steps_;
};

}  // namespace breccia
