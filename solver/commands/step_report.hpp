#pragma once

#include <string>

#include "advice/step_at_start.hpp"
#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Report on the time step before the first one.
struct StepReport {
  double limit = 0;   ///< s, stable step at the start
  double dt = 0;      ///< s, that the run begins with
  double broken = 0;  ///< s, stable step if all joints that can break had, all faces near each other meeting
  std::string text;   ///< lines
};

/// Throws InputError where a stage takes more steps than can be counted.
[[nodiscard]] StepReport step_report(const case_::Case& input, const Model& model, const StepAtStart& start);

}  // namespace breccia
