#pragma once

#include <cstdint>

#include "domains/partition.hpp"

namespace breccia {

/// The steps of one stage: how long they are, and when the stage is over. A stage is a whole number of equal steps, as
/// long as is stable; every hundred steps the stable step is looked at again, since it shrinks when elements are
/// crushed, and within ten where a joint has been released: its faces may meet others from then on.
class StageSteps {
 public:
  /// Begins the stage. Collective.  @pre input, stage and partition outlive this object
  StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition);
  /// Goes on in a stage that has begun. @param until_look  as it was
  StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition, std::int64_t until_look)
      : input_(input), stage_(stage), partition_(partition), until_look_(until_look) {}

  [[nodiscard]] bool over() const {
    return !(partition_.state().clock.time < stage_.end - 0.5 * partition_.state().clock.dt);
  }
  /// The stable step at present, of elements, joints and contacts that can be made until the next look. Collective.
  [[nodiscard]] StableStep limit() const;
  /// Whether the stage is over after one more step of the present length.
  [[nodiscard]] bool at_last() const {
    const Clock& clock = partition_.state().clock;
    return !(clock.time + clock.dt < stage_.end - 0.5 * clock.dt);
  }
  /// Before every step: a new length if it is time to look and the limit has moved. Collective.
  void look();
  [[nodiscard]] std::int64_t until_look() const { return until_look_; }
  /// Where the end of the stage has moved: steps that fit it. Collective.
  void fit_end() { partition_.domain().state.clock.dt = length(); }

 private:
  /// What is allowed, shortened so that a whole number of steps ends with the stage, s.
  [[nodiscard]] double length() const;

  const case_::Case& input_;
  const case_::Stage& stage_;
  Partition& partition_;
  std::int64_t until_look_;
};

}  // namespace breccia
