#pragma once

#include <memory>
#include <vector>

#include "advice/joint_measures.hpp"
#include "advice/overlaps.hpp"
#include "advice/rule_functions.hpp"
#include "advice/step_at_start.hpp"
#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Input of the rules. Data that several rules need are computed once, at the first request.
class Subject {
 public:
  /// @param model  of the whole mesh; both stay
  /// @param begun  s, time of the state that the case starts from; 0: it starts at rest
  Subject(const case_::Case& input, const Model& model, double begun = 0)
      : input_(input), model_(model), begun_(begun) {}

  [[nodiscard]] const case_::Case& input() const { return input_; }
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] double begun() const { return begun_; }

  /// None where the case starts from a state: its bodies have moved.
  [[nodiscard]] const std::vector<GroupOverlap>& overlaps() const;
  [[nodiscard]] const AllJointMeasures& joints() const;
  /// @pre the model is not a bare one
  [[nodiscard]] const StepAtStart& step() const;
  /// Number of steps if the first one's length stays.
  [[nodiscard]] double steps() const;
  [[nodiscard]] FramesEstimate frames() const;

 private:
  const case_::Case& input_;
  const Model& model_;
  double begun_;
  mutable std::unique_ptr<std::vector<GroupOverlap>> overlaps_;
  mutable std::unique_ptr<AllJointMeasures> joints_;
  mutable std::unique_ptr<StepAtStart> step_;
};

}  // namespace breccia
