#include "physics/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "physics/largest_eigenvalue.hpp"

namespace breccia {
namespace {

/// (2/omega) (sqrt(1 + xi^2) - xi), xi = damping / (2 omega), written without the difference of two large numbers.
double step_of(double omega_squared, double damping) {
  const double omega = std::sqrt(omega_squared);
  const double xi = 0.5 * damping / omega;
  return 2.0 / (omega * (std::sqrt(1.0 + xi * xi) + xi));
}

/// Ratio of viscous to elastic stiffness of pressure waves, s.
double viscous_ratio(const ElasticParams& p) { return 2.0 * p.viscosity / (p.lambda + 2.0 * p.mu); }

const ElasticParams& params_of(const StepModel& model, Index slot) {
  return model.params[static_cast<std::size_t>(model.mesh.block_group[static_cast<std::size_t>(slot / kLanes)])];
}

double element_share(const StepModel& model, Index slot, const Field<double>& position) {
  namespace el = elasticity;
  const LocalMesh& mesh = model.mesh;
  const auto s = static_cast<std::size_t>(slot);
  const ElasticParams& p = params_of(model, slot);
  el::Corners<double> x;
  for (int c = 0; c < 4; ++c) {
    const Vec3 corner = load_node(position.data(), mesh.corner_node(slot, c));
    x[static_cast<std::size_t>(c)] = {corner[0], corner[1], corner[2]};
  }
  el::Tensor<double> g;
  for (std::size_t i = 0; i < 9; ++i) g[i] = mesh.gradient[s / kLanes * 72 + i * kLanes + s % kLanes];
  const el::Tensor<double> f = el::deformation<double>(x, g);
  const double density = model.density[static_cast<std::size_t>(mesh.block_group[s / kLanes])];
  if (has_memory(p.law)) return 4.0 / density * bulk_stiffness(p, f, model.memory.of(slot), g);
  const el::Tensor<double> cof = el::cofactor(f);
  const double j = el::determinant(f, cof);

  // Below j_min psi' keeps falling while psi'' stays: the part psi'(J) d2J of the tangent comes to the front.
  double size = 0;
  for (const double entry : f) size += entry * entry;
  const double excess = std::max(0.0, el::volumetric_slope(p.j_min, p) - el::volumetric_slope(j, p)) * std::sqrt(size);

  double plain = 0, turned = 0;  // sums over the four corners of |g_a|^2 and |cof F g_a|^2
  for (std::size_t a = 0; a < 4; ++a) {
    el::Vector<double> grad{};
    for (std::size_t i = 0; i < 3; ++i) grad[i] = a < 3 ? g[3 * a + i] : -(g[i] + g[3 + i] + g[6 + i]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = cof[3 * i] * grad[0] + cof[3 * i + 1] * grad[1] + cof[3 * i + 2] * grad[2];
      plain += grad[i] * grad[i];
      turned += t * t;
    }
  }
  return 4.0 / density * ((p.mu + excess) * plain + el::volumetric_curvature(el::clamped(j, p), p) * turned);
}

/// k A0/3 of every joint on the faces of own-node elements, [slot][face], and on shared nodes.
struct JointSums {
  std::vector<std::array<double, 4>> own;
  std::vector<double> shared;
};

JointSums joint_sums(const StepModel& model) {
  const LocalMesh& mesh = model.mesh;
  JointSums sums{std::vector<std::array<double, 4>>(static_cast<std::size_t>(mesh.num_own_slots)),
                 std::vector<double>(static_cast<std::size_t>(mesh.num_nodes - mesh.num_own_nodes()), 0.0)};
  for (Index s = 0; s < mesh.num_own_slots; ++s) {
    for (int f = 0; f < 4; ++f)
      sums.own[static_cast<std::size_t>(s)][static_cast<std::size_t>(f)] = model.links.stiffness[JointLinks::at(s, f)];
  }
  const auto add = [&](Index slot, int face, double stiffness) {
    if (slot < mesh.num_own_slots) {
      sums.own[static_cast<std::size_t>(slot)][static_cast<std::size_t>(face)] += stiffness;
      return;
    }
    for (const int corner : kFaceCorners[static_cast<std::size_t>(face)])
      sums.shared[static_cast<std::size_t>(mesh.corner_node(slot, corner) - mesh.num_own_nodes())] += stiffness;
  };
  for (const JointStiffness& joint : model.joints) {
    add(joint.slot_a, joint.face_a, joint.stiffness);
    add(joint.slot_b, joint.code / 3, joint.stiffness);
  }
  return sums;
}

void add_joint_share(const StepModel& model, Index slot, const JointSums& sums, StepShare& share) {
  share.by_face = slot < model.mesh.num_own_slots;
  if (share.by_face) {
    const double mass = model.mesh.node_mass[static_cast<std::size_t>(own_corner_node(slot, 0))];
    for (std::size_t f = 0; f < 4; ++f) share.joint[f] = 2.0 * sums.own[static_cast<std::size_t>(slot)][f] / mass;
    return;
  }
  for (int c = 0; c < 4; ++c) {
    const Index node = model.mesh.corner_node(slot, c);
    const double k = sums.shared[static_cast<std::size_t>(node - model.mesh.num_own_nodes())];
    share.joint[static_cast<std::size_t>(c)] = 2.0 * k / model.mesh.node_mass[static_cast<std::size_t>(node)];
  }
}

/// Replaces omega_e^2 of shared-node elements by the mean around each of their nodes, damping by the largest.
void average_over_shared_nodes(const StepModel& model, std::vector<StepShare>& shares) {
  const LocalMesh& mesh = model.mesh;
  if (mesh.num_own_slots == mesh.num_slots) return;
  const auto first = static_cast<std::size_t>(mesh.num_own_nodes());
  struct Sum {
    double mass = 0, stiff = 0, damping = 0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(mesh.num_nodes) - first);
  const auto real = [&](Index s) { return mesh.element_of_slot[static_cast<std::size_t>(s)] >= 0; };
  for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
    if (!real(s)) continue;
    const auto i = static_cast<std::size_t>(s);
    const double mass = 0.25 * model.density[static_cast<std::size_t>(mesh.block_group[i / kLanes])] * mesh.volume[i];
    for (int c = 0; c < 4; ++c) {
      Sum& sum = sums[static_cast<std::size_t>(mesh.corner_node(s, c)) - first];
      sum.mass += mass;
      sum.stiff += mass * shares[i].element[0];
      sum.damping += mass * shares[i].damping;
    }
  }
  for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
    if (!real(s)) continue;
    StepShare& mine = shares[static_cast<std::size_t>(s)];
    mine.damping = 0;
    for (int c = 0; c < 4; ++c) {
      const Sum& sum = sums[static_cast<std::size_t>(mesh.corner_node(s, c)) - first];
      mine.element[static_cast<std::size_t>(c)] = sum.stiff / sum.mass;
      mine.damping = std::max(mine.damping, sum.damping / sum.mass);
    }
  }
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
  const LocalMesh& mesh = model.mesh;
  const JointSums sums = joint_sums(model);
  std::vector<StepShare> shares(static_cast<std::size_t>(mesh.num_slots));
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (mesh.element_of_slot[static_cast<std::size_t>(s)] < 0) continue;
    StepShare& mine = shares[static_cast<std::size_t>(s)];
    mine.element.fill(element_share(model, s, position));
    mine.damping = mine.element[0] * viscous_ratio(params_of(model, s));
    add_joint_share(model, s, sums, mine);
  }
  average_over_shared_nodes(model, shares);
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

/// Local damping acts against the velocity of a node. As long as slow motion is faster than the vibrations on top of
/// it, its sign does not change: it takes nothing of the vibrations, and the mean of |f| that they make acts as a drag
/// on the slow motion. With few steps a period they do not die out either: |f| varies at 2 omega and feeds other
/// vibrations. A cantilever of stiff joints (penalty_factor 100, beta 0.6) under a load that grows over about one of
/// its periods came to 0.36, 0.83 and 1.00 of its bending with 2, 3 and 5 here; one of 300 to 0.96 with 5.
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
