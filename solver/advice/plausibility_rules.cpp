#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/quantity_text.hpp"
#include "case/joint_entries.hpp"

namespace breccia {
namespace {

constexpr double kLargestFriction = 3;                        // no surfaces are known that rub more
constexpr double kLeastDensity = 10, kLargestDensity = 25e3;  // kg/m3, foams and the heaviest metals
constexpr double kSlowestWave = 1, kFastestWave = 25e3;       // m/s, jellies and diamond
constexpr double kLargestStrain = 0.2;                        // at which a joint may begin to break
constexpr double kHardlyBegun = 0.05;                         // of its length

void check_friction(Sentences& advice, const case_::Origin& origin, double friction) {
  if (!(friction > kLargestFriction)) return;
  const double angle = friction * std::numbers::pi / 180;
  std::string meant;
  if (friction < 90) meant = fmt::format(" For {:g} degrees, write {:.3g}, its tangent.", friction, std::tan(angle));
  advice.push_back(fmt::format("{}.friction (line {}) is a coefficient: {:g} is far above that of any surfaces.{}",
                               origin.key, origin.line, friction, meant));
}

void check_material(Sentences& advice, const case_::Material& material) {
  const double speed = std::sqrt(material.young / material.density);
  if (material.density < kLeastDensity || material.density > kLargestDensity)
    advice.push_back(fmt::format(
        "{}.density (line {}) is {}: no solid has that. Numbers without a unit are SI; 2.4 g/cm3 are 2400 kg/m3.",
        material.origin.key, material.origin.line, quantity_text(material.density, "kg/m3")));
  else if (speed < kSlowestWave || speed > kFastestWave)
    advice.push_back(fmt::format(
        "{} (line {}): waves run at {} by its young ({}) and density, as in no solid. Numbers without a unit are SI.",
        material.origin.key, material.origin.line, quantity_text(speed, "m/s"), quantity_text(material.young, "Pa")));
}

void check_strength(Sentences& advice, const case_::Case& input, const case_::Joint& joint) {
  const double young = case_::smallest_young(input, joint.groups), strength = joint.tensile_strength;
  if (!(young > 0) || !std::isfinite(strength) || strength <= kLargestStrain * young) return;
  advice.push_back(
      fmt::format("{}.tensile_strength (line {}) is {} with a young of {}: the material would stretch by {:.0f} % "
                  "before it breaks. Numbers without a unit are SI.",
                  joint.origin.key, joint.origin.line, quantity_text(strength, "Pa"), quantity_text(young, "Pa"),
                  100 * strength / young));
}

/// Whether a function has hardly begun its course when its stage ends.
bool is_cut_off(const TimeFunction& function, double start, double end) {
  if (function.table.size() < 2 || function.table.back().time <= end) return false;
  const double first = std::max(function.table.front().time, start);
  return end - first < kHardlyBegun * (function.table.back().time - first);
}

void check_course(Sentences& advice, const case_::Origin& origin, const TimeFunction& function, double start,
                  double end) {
  if (!is_cut_off(function, start, end)) return;
  advice.push_back(fmt::format(
      "{} (line {}) has hardly begun when its stage ends: it continues to {}, the stage to {}. Times without a "
      "unit are seconds, counted from the start of the run.",
      origin.key, origin.line, quantity_text(function.table.back().time, "s"), quantity_text(end, "s")));
}

void check_courses(Sentences& advice, const case_::Stage& stage, double start) {
  for (const TimeFunction& f : stage.gravity) check_course(advice, stage.origin, f, start, stage.end);
  for (const case_::Constraint& entry : stage.constraints) {
    for (const TimeFunction& f : entry.value) check_course(advice, entry.origin, f, start, stage.end);
  }
  for (const case_::Pressure& entry : stage.pressures)
    check_course(advice, entry.origin, entry.value, start, stage.end);
  for (const case_::Traction& entry : stage.tractions) {
    for (const TimeFunction& f : entry.value) check_course(advice, entry.origin, f, start, stage.end);
  }
  for (const case_::Force& entry : stage.forces) {
    for (const TimeFunction& f : entry.value) check_course(advice, entry.origin, f, start, stage.end);
  }
}

bool has_gravity(const case_::Stage& stage) {
  return std::any_of(stage.gravity.begin(), stage.gravity.end(), [](const TimeFunction& f) { return !f.is_zero(); });
}

/// Whether gravity acts along an axis along which the stage holds or moves nothing.
bool falls(const case_::Stage& stage) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool is_held = std::any_of(stage.constraints.begin(), stage.constraints.end(),
                                     [&](const case_::Constraint& entry) { return entry.axes[axis]; });
    if (!stage.gravity[axis].is_zero() && !is_held) return true;
  }
  return false;
}

/// What the stage before had and this one does not have at all, in words.
std::string left_out(const case_::Stage& before, const case_::Stage& stage) {
  std::string words;
  const auto add = [&](bool had, bool has, const char* what) {
    if (had && !has) words += (words.empty() ? "" : " and ") + std::string(what);
  };
  add(!before.constraints.empty(), !stage.constraints.empty(), "[[stage.constraint]]");
  add(has_gravity(before), has_gravity(stage), "gravity");
  return words;
}

}  // namespace

Sentences implausible_material(const case_::Case& input) {
  Sentences advice;
  for (const case_::Material& material : input.materials) check_material(advice, material);
  return advice;
}

Sentences implausible_strength(const case_::Case& input) {
  Sentences advice;
  for (const case_::Joint& joint : input.joints) check_strength(advice, input, joint);
  return advice;
}

Sentences implausible_friction(const case_::Case& input) {
  Sentences advice;
  for (const case_::Joint& joint : input.joints) check_friction(advice, joint.origin, joint.friction);
  for (const case_::Contact& contact : input.contacts) check_friction(advice, contact.origin, contact.friction);
  return advice;
}

Sentences function_cut_off(const case_::Case& input) {
  Sentences advice;
  double start = 0;
  for (const case_::Stage& stage : input.stages) {
    check_courses(advice, stage, start);
    start = stage.end;
  }
  return advice;
}

Sentences not_repeated_in_stage(const case_::Case& input) {
  Sentences advice;
  for (std::size_t s = 1; s < input.stages.size(); ++s) {
    const std::string words = left_out(input.stages[s - 1], input.stages[s]);
    if (words.empty()) continue;
    advice.push_back(fmt::format(
        "Stage {} lacks the {} of the previous stage: stages do not inherit. Repeat the entries to keep in stage {} "
        "(line {}).",
        s, words, s, input.stages[s].origin.line));
  }
  return advice;
}

std::string absorbing_under_gravity(const case_::Case& input) {
  if (input.stages.empty() || input.start) return {};
  const case_::Stage& first = input.stages.front();
  if (first.absorbing.empty() || !falls(first)) return {};
  return "Stage 0 has gravity and an absorbing surface, and no support against gravity: bodies on it sink at a steady "
         "speed, since the surface keeps only the forces of the time when it began to absorb. Let the model come to "
         "rest on a fixed base in a previous stage.";
}

}  // namespace breccia
