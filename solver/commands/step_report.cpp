#include "commands/step_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "base/quantity_text.hpp"
#include "contact/search_params.hpp"
#include "domains/domain.hpp"
#include "domains/global_step.hpp"
#include "mesh/quality.hpp"
#include "model/parameters.hpp"
#include "model/time_step.hpp"
#include "simulation/countable_steps.hpp"

namespace breccia {
namespace {

/// Steps between two looks at the limit, as StageSteps takes them.
constexpr double kLook = 100;
/// Contact that makes the step shorter by this is worth a word; a penalty that makes it so much shorter does not count.
constexpr double kWorthTelling = 1.5, kHardly = 1.1;
/// Below this radius ratio an element is a sliver.
constexpr double kSliver = 0.1;
/// What slivers must cost to be blamed for it.
constexpr double kSliverCost = 1.2;

/// The model at the start, with what its step is made of.
class Start {
 public:
  Start(const case_::Case& input, const Model& model)
      : input_(input), model_(model), time_step_(model), domain_(model, search_params(input, model)) {
    for (const InitialVelocity& initial : initial_velocities(input, model)) add_velocity(domain_, initial);
    if (!input.stages.empty()) loads_ = stage_loads(input.stages.front(), model);
    parts_ = step_parts(Communicator(), time_step_, state(domain_.state.nodes.velocity), kLook * input.time.safety);
    now_ = step_with(parts_.contacts);
  }

  [[nodiscard]] const StableStep& now() const { return now_; }
  [[nodiscard]] const StepParts& parts() const { return parts_; }
  [[nodiscard]] StepModel model_now() const { return step_model(time_step_, state(domain_.state.nodes.velocity)); }

  /// With what bodies can come to meet until the end at the speeds they have or gravity gives them.
  [[nodiscard]] StepParts until_the_end() const {
    const double free_step = 2.0 / std::sqrt(parts_.most);
    const Field<double> velocity = velocity_with_gravity();
    return step_parts(Communicator(), time_step_, state(velocity), input_.stages.back().end / free_step);
  }

  [[nodiscard]] StableStep step_with(const std::vector<ContactShare>& contacts) const {
    return stable_step(model_now(), parts_.shares, parts_.most, contacts, parts_.open);
  }

  /// s, as it is now but for the viscosity.
  [[nodiscard]] double step_without_viscosity() const {
    std::vector<StepShare> shares = parts_.shares;
    for (StepShare& share : shares) share.damping = 0;
    return stable_step(model_now(), shares, parts_.most, parts_.contacts, parts_.open).step;
  }

  /// With every joint of breakable groups gone and its faces meeting.
  [[nodiscard]] StableStep broken() const {
    CornerClusters clusters(model_.mesh, model_.topology);
    std::vector<Topology::Face> faces;
    for (const ModelJoint& joint : model_.joints) {
      if (!model_.joint_laws[at(joint.law)].breakable()) continue;
      faces.push_back({joint.face.a, joint.face.face_a});
      faces.push_back({joint.face.b, joint.face.code / 3});
    }
    std::vector<Index> changed;
    clusters.break_faces(faces, changed);
    StepState state = this->state(domain_.state.nodes.velocity);
    state.clusters = &clusters;
    const StepParts parts = step_parts(Communicator(), time_step_, state, kLook * input_.time.safety);
    return stable_step(model_now(), parts.shares, parts.most, parts.contacts, parts.open);
  }

 private:
  /// Velocities with what gravity adds until the end to nodes that the first stage does not hold, m/s.
  [[nodiscard]] Field<double> velocity_with_gravity() const {
    constexpr int kTimes = 16;  // of a stage
    Vec3 gained = Vec3::Zero();
    double start = 0;
    for (const case_::Stage& stage : input_.stages) {
      const double part = (stage.end - start) / kTimes;
      for (int i = 0; i < kTimes; ++i) {
        for (std::size_t a = 0; a < 3; ++a)
          gained[static_cast<Eigen::Index>(a)] += part * stage.gravity[a](start + (i + 0.5) * part);
      }
      start = stage.end;
    }
    Field<double> velocity = domain_.state.nodes.velocity;
    std::vector<std::array<bool, 3>> held(at(model_.local.num_nodes));
    const Constraints constraints(loads_.constraints, model_.local, domain_.state.nodes);
    for (std::size_t i = 0; i < constraints.nodes().size(); ++i)
      held[at(constraints.nodes()[i])] = constraints.held_axes()[i];
    for (Index node = 0; node < model_.local.num_nodes; ++node) {
      for (int a = 0; a < 3; ++a) {
        if (!held[at(node)][static_cast<std::size_t>(a)]) velocity[nodal(node, a)] += gained[a];
      }
    }
    return velocity;
  }

  [[nodiscard]] StepState state(const Field<double>& velocity) const {
    return {domain_.state.nodes.position, velocity,
            domain_.contacts(),           domain_.contact ? &domain_.contact->clusters() : nullptr,
            &loads_.constraints,          {},
            loads_.local_damping};
  }

  const case_::Case& input_;
  const Model& model_;
  TimeStep time_step_;
  Domain domain_;
  StageLoads loads_;  ///< of the first stage
  StepParts parts_;
  StableStep now_;
};

/// Factor of the penalties at which contact hardly shortens the step.
double harmless_factor(const Start& start, const std::vector<ContactShare>& contacts, double wanted) {
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
std::string contact_advice(const Model& model, const Start& start, const std::vector<ContactShare>& contacts,
                           const std::string& when) {
  const StableStep step = start.step_with(contacts);
  if (step.limit != StepLimit::contact || step.joint_step < kWorthTelling * step.step) return {};
  const double factor = harmless_factor(start, contacts, step.joint_step / kHardly);
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
  const Start start(input, other);
  return start.step_with(start.until_the_end().contacts).step;
}

/// What damping of contact costs, if it does. Small elements pay most: it is made for a layer as thick as H.
/// @param met  s, stable once bodies meet
std::string contact_damping_advice(const case_::Case& input, const Model& model, double met) {
  const auto& laws = model.contact.laws;
  if (std::none_of(laws.begin(), laws.end(), [](const ContactLaw& law) { return law.damping > 0; })) return {};
  constexpr double kShare = 0.1;
  const double without = step_with_damping(input, model, 0.0);
  if (without < kWorthTelling * met) return {};
  return fmt::format(
      "contact.damping_ratio makes the step {:.2g} times shorter where bodies meet; a tenth of it would make it {:.2g} "
      "times shorter. 0.02 is enough for a block that is set down on a slope at once.",
      without / met, without / step_with_damping(input, model, kShare));
}

/// Slivers are blamed for the step only where all other elements are known to allow a longer one.
std::string sliver_advice(const Model& model, const Start& start) {
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

/// A viscosity that costs much of the step. With xi the damping of the highest vibrations, as a share of the critical
/// one, the step is 1/f of that without, f = xi + sqrt(1 + xi^2); xi is proportional to the viscosity.
std::string viscosity_advice(const Model& model, const Start& start) {
  constexpr double kMuch = 2, kLittle = 1.2;
  const auto share_of = [](double factor) { return 0.5 * (factor - 1 / factor); };
  const double factor = start.step_without_viscosity() / start.now().step;
  if (!(factor > kMuch)) return {};
  std::size_t group = 0;
  for (std::size_t g = 1; g < model.elastic.size(); ++g) {
    if (model.elastic[g].viscosity > model.elastic[group].viscosity) group = g;
  }
  const double viscosity = model.elastic[group].viscosity;
  return fmt::format(
      "Viscosity makes the step {:.2g} times shorter (material.viscosity of {}: {}); {} would make it {:.2g} times "
      "shorter.",
      factor, model.mesh.volume_groups[group], quantity_text(viscosity, "Pa s"),
      quantity_text(viscosity * share_of(kLittle) / share_of(factor), "Pa s"), kLittle);
}

}  // namespace

StepReport step_report(const case_::Case& input, const Model& model) {
  const Start start(input, model);
  const StableStep& now = start.now();
  StepReport report;
  report.limit = now.step;
  report.dt = input.time.step > 0 ? input.time.step : input.time.safety * now.step;
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
    const std::vector<ContactShare> later = start.until_the_end().contacts;
    const StableStep met = start.step_with(later);
    report.broken = std::min(met.step, start.broken().step);
    if (met.step < 0.99 * now.step)
      report.text +=
          fmt::format("  {} once bodies meet that are on their way to each other\n", quantity_text(met.step, "s"));
    if (report.broken < 0.99 * met.step)
      report.text += fmt::format("  {} where fracture makes fragments that meet\n", quantity_text(report.broken, "s"));
    advise(report.advice, contact_damping_advice(input, model, met.step));
    if (report.advice.empty()) advise(report.advice, contact_advice(model, start, start.parts().contacts, "Contact"));
    if (report.advice.empty()) advise(report.advice, contact_advice(model, start, later, "Once bodies meet, contact"));
  }
  advise(report.advice, viscosity_advice(model, start));
  advise(report.advice, given_step_text(input.time.step, now));
  if (now.limit != StepLimit::contact && now.quantiles[0] < 0.3 * now.quantiles[1]) {
    report.advice.push_back(fmt::format(
        "The worst element allows {:.1f} times less than the worst per cent: one bad element slows the whole run.",
        now.quantiles[1] / now.quantiles[0]));
  }
  advise(report.advice, sliver_advice(model, start));
  return report;
}

}  // namespace breccia
