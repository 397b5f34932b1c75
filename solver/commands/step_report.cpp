#include "commands/step_report.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "base/error.hpp"
#include "base/quantity_text.hpp"
#include "simulation/countable_steps.hpp"

namespace breccia {

StepReport step_report(const case_::Case& input, const Model& model, const StepAtStart& start) {
  const StableStep& now = start.now();
  StepReport report;
  report.limit = now.step;
  report.dt = start.dt();
  double begun = 0;
  for (const case_::Stage& stage : input.stages) {
    const double left = stage.end - begun;
    if (!are_countable(left, report.dt)) throw InputError(uncountable_steps(input, stage, left, report.dt, now));
    begun = stage.end;
  }
  report.text = fmt::format("stable time step {}, limited by {}; elements alone {}, with joints {}\n",
                            quantity_text(now.step, "s"), limit_text(now), quantity_text(now.element_step, "s"),
                            quantity_text(now.joint_step, "s"));
  report.text +=
      fmt::format("  elements' own steps: smallest {}, 1 % {}, median {}\n", quantity_text(now.quantiles[0], "s"),
                  quantity_text(now.quantiles[1], "s"), quantity_text(now.quantiles[3], "s"));
  report.broken = now.step;
  if (model.has_contact) {
    const StableStep met = start.step_with(start.met());
    report.broken = std::min(met.step, start.broken().step);
    if (met.step < 0.99 * now.step)
      report.text +=
          fmt::format("  {} once bodies meet that are on their way to each other\n", quantity_text(met.step, "s"));
    if (report.broken < 0.99 * met.step)
      report.text += fmt::format("  {} where fracture makes fragments that meet\n", quantity_text(report.broken, "s"));
  }
  return report;
}

}  // namespace breccia
