#include "physics/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "physics/element_shares.hpp"
#include "physics/largest_eigenvalue.hpp"

namespace breccia {
namespace {

/// (2/omega) (sqrt(1 + xi^2) - xi), xi = damping / (2 omega), written without the difference of two large numbers.
double step_of(double omega_squared, double damping) {
  const double omega = std::sqrt(omega_squared);
  const double xi = 0.5 * damping / omega;
  return 2.0 / (omega * (std::sqrt(1.0 + xi * xi) + xi));
}

GlobalId neighbour_across(const StepModel& model, Index slot, int face) {
  const auto element = [&](Index s) { return model.mesh.element_of_slot[static_cast<std::size_t>(s)]; };
  if (slot < model.mesh.num_own_slots && face >= 0) {
    const std::int32_t link = model.links.link[JointLinks::at(slot, face)];
    if (JointLinks::code_of(link) < 12) return element(JointLinks::slot_of(link));
  }
  for (const JointStiffness& joint : model.joints) {
    if (joint.slot_a == slot && joint.face_a == face) return element(joint.slot_b);
    if (joint.slot_b == slot && joint.code / 3 == face) return element(joint.slot_a);
  }
  return -1;
}

/// The stiffest corner of an element.
struct Corner {
  double omega_squared = 0, element = 0, joint = 0, contact = 0;
};

Corner stiffest_corner(const StepShare& share, double most, const ContactShare& contact, unsigned open) {
  Corner worst;
  for (int c = 0; c < 4; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const double element = share.element[i], joint = share.joint_at(c, open), touch = contact.omega_squared[i];
    const double sum = std::min(element + joint, most) + touch;
    if (sum > worst.omega_squared) worst = {sum, element, joint, touch};
  }
  return worst;
}

void name_limit(const StepModel& model, Index slot, const StepShare& share, const Corner& worst, int contact_face,
                StableStep& result) {
  result.element = model.mesh.element_of_slot[static_cast<std::size_t>(slot)];
  const double rest = worst.omega_squared - worst.contact;  // less than the sum of the bounds
  if (worst.contact >= std::min(worst.joint, rest) && worst.contact > std::min(worst.element, rest)) {
    result.limit = StepLimit::contact;
    result.face = contact_face;
  } else if (worst.joint > worst.element) {
    result.limit = StepLimit::joint;
    if (!share.by_face) return;
    result.face = static_cast<int>(std::max_element(share.joint.begin(), share.joint.end()) - share.joint.begin());
    result.neighbour = neighbour_across(model, slot, result.face);
  }
}

double stiffest_ratio(std::span<const ElasticParams> params) {
  double largest = 0;
  for (const ElasticParams& p : params) largest = std::max(largest, viscous_ratio(p));
  return largest;
}

}  // namespace

double viscous_ratio(const ElasticParams& p) { return 2.0 * p.viscosity / (p.lambda + 2.0 * p.mu); }

double StepShare::joint_at(int corner, unsigned open) const {
  if (!by_face) return joint[static_cast<std::size_t>(corner)];
  double sum = 0;
  for (int f = 0; f < 4; ++f) {
    if (f != corner && (open >> f & 1) == 0) sum += joint[static_cast<std::size_t>(f)];
  }
  return sum;
}

double StepShare::largest_joint() const {
  return std::max(std::max(joint_at(0), joint_at(1)), std::max(joint_at(2), joint_at(3)));
}

double StepShare::largest() const {
  double most = 0;
  for (int c = 0; c < 4; ++c) most = std::max(most, element[static_cast<std::size_t>(c)] + joint_at(c));
  return most;
}

std::vector<StepShare> step_shares(const StepModel& model, const Field<double>& position) {
  ElementShares elements(model);
  elements.update(model, position);
  std::vector<StepShare> shares;
  shares.reserve(static_cast<std::size_t>(model.mesh.num_slots));
  for (Index s = 0; s < model.mesh.num_slots; ++s) shares.push_back(elements.of(model, s));
  return shares;
}

double stiffest(const StepModel& model, std::span<const StepShare> shares) {
  double largest = 0;
  for (Index s = 0; s < model.mesh.num_slots; ++s) {
    const StepShare& mine = shares[static_cast<std::size_t>(s)];
    if (model.mesh.is_original(s)) largest = std::max(largest, mine.largest());
  }
  return largest;
}

/// Local damping needs about five steps a period, otherwise it does not damp: the sign of a node's velocity is then
/// that of the slow motion, the vibrations lose no energy, and the mean of the |f| that they cause is a drag on the
/// slow motion. A cantilever of stiff joints (penalty_factor 100, beta 0.6) under a load that grows over about one of
/// its periods reached 0.36, 0.83 and 1.00 of its bending with 2, 3 and 5 here; one of 300 reached 0.96 with 5.
constexpr double kSlowMotionFactor = 5.0;

ElementSteps::ElementSteps(const StepModel& model, double most)
    : most_(most),
      most_damping_(stiffest_ratio(model.params) > 0 ? stiffest_ratio(model.params) * most : 0.0),
      forces_(model.local_damping > 0 ? kSlowMotionFactor * (1.0 + model.local_damping) : 1.0) {}

double ElementSteps::step_of(double omega_squared, double damping) const {
  return breccia::step_of(forces_ * omega_squared, forces_ * damping);
}

double ElementSteps::of(const StepShare& share, const ContactShare& contact, unsigned open) const {
  return step_of(stiffest_corner(share, most_, contact, open).omega_squared, damping(share));
}

StableStep stable_step(const StepModel& model, std::span<const StepShare> shares, double most,
                       std::span<const ContactShare> contacts, std::span<const std::uint8_t> open) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  StableStep result{.step = kNever, .element_step = kNever, .joint_step = kNever};
  const ElementSteps element_steps(model, most);
  const ContactShare no_contact;
  std::vector<double> steps;
  steps.reserve(shares.size());
  Index worst = -1;
  double bound_of_worst = 0;
  const auto contact_of = [&](Index s) -> const ContactShare& {
    return contacts.empty() ? no_contact : contacts[static_cast<std::size_t>(s)];
  };
  const auto open_of = [&](Index s) { return open.empty() ? 0U : unsigned{open[static_cast<std::size_t>(s)]}; };
  for (Index s = 0; s < model.mesh.num_slots; ++s) {
    const StepShare& mine = shares[static_cast<std::size_t>(s)];
    if (!model.mesh.is_original(s)) continue;
    const double damping = element_steps.damping(mine), bound = mine.largest();
    const double step = element_steps.of(mine, contact_of(s), open_of(s));
    steps.push_back(step);
    result.element_step =
        std::min(result.element_step, element_steps.step_of(std::min(mine.largest_element(), most), damping));
    result.joint_step = std::min(result.joint_step, element_steps.step_of(std::min(bound, most), damping));
    // Where the true limit makes many alike, the worst is the one with the highest bound.
    if (step < result.step || (step == result.step && bound > bound_of_worst)) {
      result.step = step;
      worst = s;
      bound_of_worst = bound;
    }
  }
  if (worst < 0) return result;
  const StepShare& share = shares[static_cast<std::size_t>(worst)];
  name_limit(model, worst, share, stiffest_corner(share, most, contact_of(worst), open_of(worst)),
             contact_of(worst).face, result);
  std::sort(steps.begin(), steps.end());
  constexpr std::array<double, 5> kProbability{0.0, 0.01, 0.1, 0.5, 1.0};
  for (std::size_t q = 0; q < kProbability.size(); ++q) {
    result.quantiles[q] = steps[static_cast<std::size_t>(kProbability[q] * static_cast<double>(steps.size() - 1))];
  }
  return result;
}

StableStep stable_step(const StepModel& model, const Field<double>& position) {
  return stable_step(model, step_shares(model, position));
}

double true_stable_step(const StepModel& model) {
  double damping = 0;
  for (const StepShare& mine : step_shares(model, model.mesh.reference)) damping = std::max(damping, mine.damping);
  const double most = largest_eigenvalue(model), ratio = stiffest_ratio(model.params);
  return step_of(most, ratio > 0 ? std::min(damping, ratio * most) : 0.0);
}

}  // namespace breccia
