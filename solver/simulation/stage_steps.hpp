#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "domains/partition.hpp"

namespace breccia {

/// Stable step over that of the model at rest, without contact, below which a run ends: what is left of it would take a
/// thousand times as long as was foreseen. Stiff contact makes it 0.1; crushed elements keep a stiffness (j_min).
inline constexpr double kSmallestStep = 1e-3;

/// When the stable step is evaluated.
struct StepSchedule {
  std::int64_t until = 0;         ///< steps to the next evaluation
  std::int64_t since = 0;         ///< steps from the last one
  std::int64_t growth_steps = 0;  ///< steps until the last one in which every evaluation found one half longer
};

/// The steps of one stage: their length, and the end of the stage. A stage is a whole number of equal steps, as long as
/// is stable; the stable step is evaluated every hundred steps, since it shrinks when elements are crushed, and after
/// ten where a joint has been released: its faces may then come into contact. From one evaluation to the next, and into
/// a stage, a step grows by half at most (domains/motion_limit.hpp), and after ten steps again. It grows by more within
/// a stage only if every evaluation of three hundred steps permits it: vibrating bodies near others make the stable
/// step rise and fall, and each change of the step changes the discrete energy of their vibrations.
///
/// A stable step that falls below a tenth, a hundredth, ... of that of the model at rest is a warning, and in the end
/// an error. The last step of a stage is divided into steps that are stable in the next one as well: nodes released
/// there are accelerated at once, over half of this step too. A step given in the case (time.step) is not checked.
class StageSteps {
 public:
  /// Begins the stage. Collective. Throws InputError where it would take more steps than can be counted.
  /// @pre input, stage and partition outlive this object
  StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition);
  /// Continues a stage that has begun. Collective. @param schedule  as it was
  StageSteps(const case_::Case& input, const case_::Stage& stage, Partition& partition, const StepSchedule& schedule);

  [[nodiscard]] bool over() const {
    return !(partition_.state().clock.time < stage_.end - 0.5 * partition_.state().clock.dt);
  }
  /// The stable step at present, of elements, joints and contacts that can form until the next evaluation. Collective.
  [[nodiscard]] StableStep limit() const;
  /// Whether the stage is over after one more step of the present length.
  [[nodiscard]] bool at_last() const {
    const Clock& clock = partition_.state().clock;
    return !(clock.time + clock.dt < stage_.end - 0.5 * clock.dt);
  }
  /// Before every step: a new length if an evaluation is due and the limit has changed. Collective. Throws
  /// SimulationError, the same on all ranks, if the limit is below kSmallestStep.
  void look();
  /// Warning of the last evaluation, returned once: the step has fallen below another tenth of that at rest.
  [[nodiscard]] std::string take_warning() { return std::exchange(warning_, {}); }
  [[nodiscard]] const StepSchedule& schedule() const { return schedule_; }
  /// Where the end of the stage has moved: steps that fit it. Collective.
  void fit_end();

 private:
  /// An allowed length, shortened so that a whole number of steps ends with the stage, s.
  [[nodiscard]] double length(double allowed) const;
  /// Refuses a stage of more steps than can be counted.
  void demand_countable() const;
  /// The length that is allowed now, s; schedules the next evaluation. Collective.
  /// @param range  stable steps that all lead to the present length, s: which of them it is need not be found
  [[nodiscard]] double allowed(const StepRange& range = {});
  /// Stable steps with which adjust() changes nothing, and warns of nothing; none: {0, 0}.
  [[nodiscard]] StepRange unchanged() const;
  /// At an evaluation. Collective. Throws SimulationError as look().
  void adjust();
  /// Where one step is left of the stage: divides it, if the next stage has a shorter one. Collective.
  void prepare_next();
  /// Stable steps to the next evaluation.
  [[nodiscard]] double steps_to_look() const;
  /// Notes a warning, or throws. Collective. @param stable  step, s
  void check_collapse(double stable);

  const case_::Case& input_;
  const case_::Stage& stage_;
  Partition& partition_;
  StepSchedule schedule_;
  double at_rest_ = 0;  ///< s, stable step of the model at rest; 0: not known, as the step is given
  std::string warning_;
};

}  // namespace breccia
