#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "advice/rule_functions.hpp"
#include "advice/step_at_start.hpp"
#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "mesh/quality.hpp"

namespace breccia {
namespace {

/// Factors by which contact shortens the step: from the first on it is reported; at the second a penalty is harmless.
constexpr double kReportedFactor = 1.5, kHarmlessFactor = 1.1;

/// Factor of the penalties at which contact hardly shortens the step.
double harmless_factor(const StepAtStart& start, const std::vector<ContactShare>& contacts, double wanted) {
  double low = -8, high = 0;  // powers of ten
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high), factor = std::pow(10.0, middle);
    std::vector<ContactShare> scaled = contacts;
    for (ContactShare& share : scaled) {
      for (double& corner : share.omega_squared) corner *= factor;
    }
    (start.step_with(scaled).step >= wanted ? low : high) = middle;
  }
  return std::pow(10.0, low);
}

/// What contact costs, if it does. @param when  "Contact", "Once ..., contact"
std::string contact_advice(const Model& model, const StepAtStart& start, const std::vector<ContactShare>& contacts,
                           const std::string& when) {
  const StableStep step = start.step_with(contacts);
  if (step.limit != StepLimit::contact || step.joint_step < kReportedFactor * step.step) return {};
  const double factor = harmless_factor(start, contacts, step.joint_step / kHarmlessFactor);
  const auto& slot_of = model.local.slot_of_element;
  const Index slot = slot_of[at(static_cast<Index>(step.element))];
  const Index group = model.local.block_group[at(slot / kLanes)], against = contacts[at(slot)].against;
  std::string text = fmt::format("{} makes the step {:.2g} times shorter", when, step.joint_step / step.step);
  if (against < 0) {
    const double penalty = model.contact.sphere->penalty;
    return text + fmt::format(
                      " at the sphere; a penalty of {:.2g} Pa instead of {:.3g} Pa would not, but let points out "
                      "{:.2g} times as far.",
                      factor * penalty, penalty, 1 / factor);
  }
  const ContactLaw& forth = model.contact.law(group, against);
  const ContactLaw& law = forth.active() ? forth : model.contact.law(against, group);
  const auto& names = model.mesh.volume_groups;
  return text + fmt::format(
                    " (\"{}\" on \"{}\", element {}); a penalty of {:.2g} Pa instead of {:.3g} Pa would not, but let "
                    "bodies {:.2g} times as deep into each other.",
                    names[at(group)], names[at(against)], step.element, factor * law.penalty, law.penalty, 1 / factor);
}

/// s, stable once bodies meet, with a share of the damping of contact.
double step_with_damping(const case_::Case& input, const Model& model, double share) {
  Model other = model;
  for (ContactLaw& law : other.contact.laws) law.damping *= share;
  const StepAtStart start(input, other);
  return start.step_with(start.met()).step;
}

/// What damping of contact costs, if it does. Small elements pay most: it is made for a layer as thick as H.
/// @param met  s, stable once bodies meet
std::string contact_damping_advice(const case_::Case& input, const Model& model, double met) {
  const auto& laws = model.contact.laws;
  if (std::none_of(laws.begin(), laws.end(), [](const ContactLaw& law) { return law.damping > 0; })) return {};
  constexpr double kShare = 0.1;
  const double without = step_with_damping(input, model, 0.0);
  if (without < kReportedFactor * met) return {};
  return fmt::format(
      "contact.damping_ratio makes the step {:.2g} times shorter where bodies meet; a tenth of it would make it {:.2g} "
      "times shorter. 0.02 is enough for a block that is set down on a slope at once.",
      without / met, without / step_with_damping(input, model, kShare));
}

}  // namespace

std::string step_of_contact(const case_::Case& input, const Model& model, const StepAtStart& start) {
  if (!model.has_contact) return {};
  std::string advice = contact_damping_advice(input, model, start.step_with(start.met()).step);
  if (advice.empty()) advice = contact_advice(model, start, start.parts().contacts, "Contact");
  if (advice.empty()) advice = contact_advice(model, start, start.met(), "Once bodies meet, contact");
  return advice;
}

/// A viscosity that costs much of the step. With xi the damping of the highest vibrations, as a share of the critical
/// one, the step is 1/f of that without, f = xi + sqrt(1 + xi^2); xi is proportional to the viscosity.
std::string step_of_viscosity(const Model& model, const StepAtStart& start) {
  constexpr double kLargeFactor = 2, kTargetFactor = 1.2;
  const auto share_of = [](double factor) { return 0.5 * (factor - 1 / factor); };
  const double factor = start.step_without_viscosity() / start.now().step;
  if (!(factor > kLargeFactor)) return {};
  std::size_t group = 0;
  for (std::size_t g = 1; g < model.elastic.size(); ++g) {
    if (model.elastic[g].viscosity > model.elastic[group].viscosity) group = g;
  }
  const double viscosity = model.elastic[group].viscosity;
  return fmt::format(
      "Viscosity makes the step {:.2g} times shorter (material.viscosity of {}: {}); {} would make it {:.2g} times "
      "shorter.",
      factor, model.mesh.volume_groups[group], quantity_text(viscosity, "Pa s"),
      quantity_text(viscosity * share_of(kTargetFactor) / share_of(factor), "Pa s"), kTargetFactor);
}

std::string step_too_long(const case_::Case& input, const StepAtStart& start) {
  return given_step_text(input.time.step, start.now());
}

std::string one_bad_element(const StepAtStart& start) {
  const StableStep& now = start.now();
  if (now.limit == StepLimit::contact || now.quantiles[0] >= 0.3 * now.quantiles[1]) return {};
  return fmt::format(
      "The worst element allows {:.1f} times less than the worst per cent: one bad element slows the whole run.",
      now.quantiles[1] / now.quantiles[0]);
}

std::string slivers(const Model& model, const StepAtStart& start) {
  constexpr double kSliver = 0.1;      // radius ratio
  constexpr double kSliverCost = 1.2;  // what they must cost to be blamed for it
  if (start.now().limit == StepLimit::contact) return {};
  const QualityReport quality = assess_quality(model.mesh);
  std::vector<Index> slivers;
  for (const QualityReport::Worst& w : quality.worst) {
    if (w.quality.radius_ratio < kSliver) slivers.push_back(model.local.slot_of_element[at(w.element)]);
  }
  if (slivers.empty()) return {};
  std::vector<StepShare> others = start.parts().shares;
  for (const Index slot : slivers) others[at(slot)] = {};
  const double without = 2.0 / std::sqrt(stiffest(start.model_now(), others));
  if (!(without > kSliverCost * start.now().step)) return {};
  return fmt::format(
      "{} slivers (radius ratio below {}), the worst element {}, set the time step: without them it would be at "
      "least "
      "{:.2g} times longer. Optimise the mesh (Mesh.Optimize, Mesh.OptimizeThreshold) or merge them.",
      slivers.size(), kSliver, quality.worst.front().element, without / start.now().step);
}

}  // namespace breccia
