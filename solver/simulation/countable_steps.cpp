#include "simulation/countable_steps.hpp"

#include <string>

#include "base/number_text.hpp"
#include "case/problem_at.hpp"

namespace breccia {
namespace {

std::string short_text(double value) { return number_text(value, 3); }

}  // namespace

Problem uncountable_steps(const case_::Case& input, const case_::Stage& stage, double left, double dt,
                          const StableStep& limit) {
  return case_::problem_at(
      input, stage.origin, "end",
      "the stage would take more steps than can be counted: " + limit_text(limit) + " allows a time step of " +
          short_text(limit.step) + " s only",
      case_::kAtMostSteps + std::string("; check stiffness, density, viscosity, penalties and size there"),
      short_text(left) + " s in steps of " + short_text(dt) + " s");
}

}  // namespace breccia
