#include "simulation/countable_steps.hpp"

#include <array>
#include <cstdio>
#include <string>

namespace breccia {
namespace {

std::string short_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

Problem uncountable_steps(const case_::Case& input, const case_::Stage& stage, double left, double dt,
                          const StableStep& limit) {
  return {input.file.string(),
          stage.origin.line,
          stage.origin.key + ".end",
          "the stage would take more steps than can be counted: " + limit_text(limit) + " allows a time step of " +
              short_text(limit.step) + " s only",
          "at most 1e15 steps; look at stiffness, density, viscosity, penalties and size there",
          short_text(left) + " s in steps of " + short_text(dt) + " s"};
}

}  // namespace breccia
