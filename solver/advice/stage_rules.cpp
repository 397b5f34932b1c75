#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "advice/constraint_words.hpp"
#include "advice/solids.hpp"
#include "base/error.hpp"
#include "base/quantity_text.hpp"

namespace breccia {
namespace {

/// Viscosity over Young's modulus, of the time in which a wave crosses a body: 2 % of critical damping.
constexpr double kViscosity = 0.005;

/// Likewise, for a coefficient of friction 1. Elastic bodies that slide on each other without damping are unstable, the
/// more so the larger the friction. With 0.05, and without a delay of friction, two blocks of 15 mm slide evenly on
/// meshes of 5 and 8 mm and rub at most 0.6 % too little, with coefficients of 0.3, 0.6 and 0.9; with 0.03 and 0.6 up
/// to 5 % too little.
constexpr double kSlidingViscosity = 0.05;
/// Share of it that is enough: the reported value is rounded.
constexpr double kSufficientShare = 0.95;

/// Whether anything takes energy out of vibrations in a stage.
/// @param viscosity  Pa s, of a material, that is enough: more than this
bool damped(const case_::Case& input, const case_::Stage& stage, double viscosity = 0) {
  const auto any = [](const auto& entries, auto member, double least) {
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.*member > least; });
  };
  return stage.mass_damping > 0 || stage.local_damping > 0 ||
         any(input.materials, &case_::Material::viscosity, viscosity) ||
         any(input.contacts, &case_::Contact::damping_ratio, 0);
}

Vec3 value_at(const std::array<TimeFunction, 3>& f, double time) { return {f[0](time), f[1](time), f[2](time)}; }

Vec3 gravity_at(const case_::Stage& stage, double time) { return value_at(stage.gravity, time); }

/// The pressure that a stage puts on a surface at a time, Pa.
double pressure_at(const case_::Stage* stage, const std::string& surface, double time) {
  double sum = 0;
  if (stage == nullptr) return sum;
  for (const case_::Pressure& p : stage->pressures) {
    if (p.surface == surface) sum += p.value(time);
  }
  return sum;
}

/// The tractions on a surface, Pa, or the forces on a group, N. @param name  of a load's surface or group
template <class Load>
Vec3 sum_at(const std::vector<Load>& loads, std::string Load::*name, const std::string& group, double time) {
  Vec3 sum = Vec3::Zero();
  for (const Load& load : loads) {
    if (load.*name == group) sum += value_at(load.value, time);
  }
  return sum;
}

/// Loads that a stage begins with, in words; empty: none that comes suddenly.
std::string sudden_loads(const case_::Stage& stage, const case_::Stage* before, double start) {
  constexpr double kLargeJump = 0.1;  // of the load, in one step
  const Vec3 last = before != nullptr ? gravity_at(*before, start) : Vec3::Zero(), first = gravity_at(stage, start);
  std::string loads;
  if ((first - last).norm() > kLargeJump * std::max(first.norm(), gravity_at(stage, stage.end).norm()))
    loads = fmt::format("gravity ({} at once)", quantity_text((first - last).norm(), "m/s2"));
  for (const case_::Pressure& p : stage.pressures) {
    const double jump = pressure_at(&stage, p.surface, start) - pressure_at(before, p.surface, start);
    if (std::abs(jump) <= kLargeJump * std::max(std::abs(p.value(start)), std::abs(p.value(stage.end)))) continue;
    loads += fmt::format("{}the pressure on \"{}\" ({} at once)", loads.empty() ? "" : " and ", p.surface,
                         quantity_text(jump, "Pa"));
  }
  const auto add_jumps = [&]<class Load>(std::vector<Load> case_::Stage::*member, std::string Load::*name,
                                         const char* what, const char* unit) {
    for (const Load& load : stage.*member) {
      const Vec3 now = sum_at(stage.*member, name, load.*name, start);
      const Vec3 then = before != nullptr ? sum_at(before->*member, name, load.*name, start) : Vec3(Vec3::Zero());
      const double jump = (now - then).norm();
      if (jump <= kLargeJump * std::max(value_at(load.value, start).norm(), value_at(load.value, stage.end).norm()))
        continue;
      loads += fmt::format("{}the {} on \"{}\" ({} at once)", loads.empty() ? "" : " and ", what, load.*name,
                           quantity_text(jump, unit));
    }
  };
  add_jumps(&case_::Stage::tractions, &case_::Traction::surface, "traction", "Pa");
  add_jumps(&case_::Stage::forces, &case_::Force::group, "force", "N");
  return loads;
}

/// The smallest Young's modulus of a model, Pa.
double softest(const Model& model) {
  double least = std::numeric_limits<double>::max();
  for (const ElasticParams& p : model.elastic)
    least = std::min(least, p.mu * (3 * p.lambda + 2 * p.mu) / (p.lambda + p.mu));
  return least;
}

/// A stage's name in quotes, or its number.
std::string words_of(const case_::Case& input, const case_::Stage& stage) {
  return stage.name.empty() ? fmt::format("{}", &stage - input.stages.data()) : "\"" + stage.name + "\"";
}

/// Whether a stage loads or drives anything at any of some times in it.
bool is_loaded(const case_::Stage& stage, double start) {
  constexpr int kTimes = 16;
  for (int i = 0; i <= kTimes; ++i) {
    const double time = start + (stage.end - start) * i / kTimes;
    const auto acts = [&](const TimeFunction& function) { return function(time) != 0; };
    if (std::any_of(stage.gravity.begin(), stage.gravity.end(), acts)) return true;
    for (const case_::Pressure& p : stage.pressures) {
      if (acts(p.value)) return true;
    }
    for (const case_::Traction& t : stage.tractions) {
      if (std::any_of(t.value.begin(), t.value.end(), acts)) return true;
    }
    for (const case_::Force& f : stage.forces) {
      if (std::any_of(f.value.begin(), f.value.end(), acts)) return true;
    }
    for (const case_::Constraint& c : stage.constraints) {
      if (c.kind != case_::ConstraintKind::fixed && std::any_of(c.value.begin(), c.value.end(), acts)) return true;
    }
  }
  return false;
}

/// Entries whose friction is high enough for what slides to vibrate, in words; empty: none.
struct RoughEntries {
  std::string words;
  double largest = 0;  ///< coefficient
};

RoughEntries rough_entries(const case_::Case& input) {
  // With and without a delay. A block dragged at 1.2 m/s hopped with 0.3: its normal force varied by 1.5 of its weight.
  constexpr double kSteady = 0.25, kSteadyAtOnce = 0.2;
  RoughEntries entries;
  const auto add = [&](const char* what, const std::array<std::string, 2>& groups, double friction, double steady) {
    if (friction <= steady) return;
    entries.words += fmt::format("{}{} of {} {:g}", entries.words.empty() ? "" : ", ", what,
                                 groups[0] == groups[1] ? groups[0] : groups[0] + " and " + groups[1], friction);
    entries.largest = std::max(entries.largest, friction);
  };
  for (const case_::Contact& c : input.contacts)
    add("contact", c.groups, c.friction, c.friction_delay > 0 ? kSteady : kSteadyAtOnce);
  for (const case_::Joint& j : input.joints) {
    const bool breaks =
        !j.inside() || std::any_of(input.materials.begin(), input.materials.end(), [&](const case_::Material& m) {
          const bool ruled = m.group == j.groups[0] || j.inside_any || m.group == case_::every_group;
          return ruled && m.joints == case_::JointPlacement::breakable;
        });
    if (breaks && j.tensile_strength > 0) add("joint", j.groups, j.friction, kSteadyAtOnce);
  }
  return entries;
}

}  // namespace

Sentences sudden_load(const case_::Case& input, const Model& model) {
  constexpr double kStatic = 10, kSlow = 20;  // crossings of a wave
  Sentences advice;
  Solids solids(model);
  const case_::Stage* before = nullptr;
  double start = 0;
  for (const case_::Stage& stage : input.stages) {
    const bool known = before != nullptr || !input.start;
    const std::string loads = known && !damped(input, stage) ? sudden_loads(stage, before, start) : "";
    solids.hold(stage);
    const double crossing = loads.empty() ? 0.0 : solids.slowest_at_rest();
    if (crossing > 0 && stage.end - start > kStatic * crossing) {
      advice.push_back(fmt::format(
          "Stage {} begins with {}, on bodies that are constrained, supported or pressed and have no damping: they "
          "vibrate with up to twice the static stress. For a slow load use a ramp over {} or more, {{ ramp = {{ start "
          "= {:g}, end = ..., to = ... }} }}, and damp: a material.viscosity of {}, or stage.local_damping{}.",
          words_of(input, stage), loads, quantity_text(kSlow * crossing, "s"), start,
          quantity_text(kViscosity * crossing * softest(model), "Pa s"),
          model.has_contact ? "; contact.damping_ratio = 0.05 damps bouncing" : ""));
    }
    before = &stage;
    start = stage.end;
  }
  return advice;
}

Sentences undamped_friction(const case_::Case& input, const Model& model) {
  const bool breaks = std::any_of(model.breakable.begin(), model.breakable.end(), [](bool b) { return b; });
  if (model.mesh.num_bodies < 2 && !breaks) return {};
  const RoughEntries entries = rough_entries(input);
  if (entries.words.empty()) return {};
  const double viscosity = kSlidingViscosity * entries.largest * Solids(model).slowest_crossing() * softest(model);
  double start = 0;
  for (const case_::Stage& stage : input.stages) {
    if (!damped(input, stage, kSufficientShare * viscosity) && is_loaded(stage, start)) {
      return {fmt::format(
          "{} stage {}, and there is friction (coefficients: {}), with which sliding elastic bodies vibrate and the "
          "mean friction is too low; contact.friction_delay prevents that for steady sliding, up to a coefficient of "
          "0.6, not after sudden motions, and joints have no delay. For sliding bodies add damping: a "
          "material.viscosity of {}.",
          damped(input, stage) ? "Viscosity damps little in" : "Nothing damps", words_of(input, stage), entries.words,
          quantity_text(viscosity, "Pa s"))};
    }
    start = stage.end;
  }
  return {};
}

std::string damped_sliding(const case_::Case& input, const Model& model) {
  const case_::Stage& last = input.stages.back();
  const bool breaks = std::any_of(model.breakable.begin(), model.breakable.end(), [](bool b) { return b; });
  const auto rubs = [](const auto& entries) {
    return std::any_of(entries.begin(), entries.end(), [](const auto& entry) { return entry.friction > 0; });
  };
  if (!(last.local_damping > 0) || (model.mesh.num_bodies < 2 && !breaks)) return {};
  if (!rubs(input.contacts) && !(breaks && rubs(input.joints))) return {};
  return fmt::format(
      "Stage {}, the last one, has a local_damping of {:g}: with friction it slows down or stops sliding bodies, even "
      "with 0.02, and falling bodies accelerate by {:g} of gravity. Where motion matters, omit it there and damp with "
      "material.viscosity.",
      words_of(input, last), last.local_damping, 1 - last.local_damping);
}

std::string damped_reactions(const case_::Case& input) {
  const auto recorded = [&](const case_::Constraint& entry) {
    const std::vector<std::string>& gauges = input.output.gauges;
    return std::find(gauges.begin(), gauges.end(), entry.group) != gauges.end();
  };
  for (const case_::Stage& stage : input.stages) {
    const auto& entries = stage.constraints;
    const bool drives = std::any_of(entries.begin(), entries.end(), [](const case_::Constraint& entry) {
      return entry.kind != case_::ConstraintKind::fixed &&
             !std::all_of(entry.value.begin(), entry.value.end(), [](const TimeFunction& f) { return f.is_zero(); });
    });
    if (!(stage.local_damping > 0) || !drives || std::none_of(entries.begin(), entries.end(), recorded)) continue;
    return fmt::format(
        "Stage {} has a local_damping of {:g} and drives what output.gauges record: it changes the reactions during "
        "acceleration and fracture (acceleration requires {:.3g} times the force). To measure forces, omit it there "
        "and damp with material.viscosity; compare the reactions of both ends.",
        words_of(input, stage), stage.local_damping, 1 / (1 - stage.local_damping));
  }
  return {};
}

Sentences overruled_constraints(const std::vector<ConstraintConflict>& conflicts) {
  Sentences advice;
  for (const ConstraintConflict& c : conflicts) {
    if (c.whole) continue;
    advice.push_back(fmt::format(
        "{} overrules {} along {} on {} of its {} nodes, which are in both entries. Otherwise remove {} from one of "
        "them.",
        name_of(*c.later), name_of(*c.earlier), "xyz"[c.axis], c.shared, c.of_earlier, "xyz"[c.axis]));
  }
  return advice;
}

Sentences overruled_constraint(const case_::Case& input, const Model& model) {
  return overruled_constraints(constraint_conflicts(input, model));
}

}  // namespace breccia
