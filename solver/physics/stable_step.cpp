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

struct Shares {
  double element = 0, joint = 0, contact = 0;  ///< of omega^2, 1/s2
  double damping = 0;                          ///< 1/s
  int joint_face = -1, contact_face = -1;
};

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

/// Largest sum of joint stiffness on a corner; the face is the stiffest one there.
void add_joint_share(const StepModel& model, Index slot, Shares& shares) {
  std::array<double, 4> k{};
  for (int face = 0; face < 4; ++face)
    k[static_cast<std::size_t>(face)] = model.links.stiffness[JointLinks::at(slot, face)];
  const double all = k[0] + k[1] + k[2] + k[3];
  const double node_sum = all - *std::min_element(k.begin(), k.end());  // the corner opposite to the softest face
  const double mass = model.mesh.node_mass[static_cast<std::size_t>(own_corner_node(slot, 0))];
  shares.joint = 2.0 * node_sum / mass;
  shares.joint_face = static_cast<int>(std::max_element(k.begin(), k.end()) - k.begin());
}

/// Replaces omega_e^2 of shared-node elements by the largest mean around one of their nodes.
void average_over_shared_nodes(const StepModel& model, std::vector<Shares>& shares) {
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
      sum.stiff += mass * shares[i].element;
      sum.damping += mass * shares[i].damping;
    }
  }
  for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
    if (!real(s)) continue;
    Shares& mine = shares[static_cast<std::size_t>(s)];
    mine.element = 0;
    for (int c = 0; c < 4; ++c) {
      const Sum& sum = sums[static_cast<std::size_t>(mesh.corner_node(s, c)) - first];
      if (sum.stiff / sum.mass > mine.element) {
        mine.element = sum.stiff / sum.mass;
        mine.damping = sum.damping / sum.mass;
      }
    }
  }
}

/// omega_c^2 of every face that has points, kept as the largest by slot.
void add_contact_shares(const StepModel& model, std::vector<Shares>& shares) {
  const LocalMesh& mesh = model.mesh;
  double face_sum = 0;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const ContactStiffness& point = model.contacts[k];
    const bool same_face =
        k > 0 && model.contacts[k - 1].slot == point.slot && model.contacts[k - 1].face == point.face;
    double inverse_mass = 1.0 / model.lightest_node;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index node = mesh.corner_node(point.slot, kFaceCorners[static_cast<std::size_t>(point.face)][i]);
      inverse_mass += point.shape[i] * point.shape[i] / mesh.node_mass[static_cast<std::size_t>(node)];
    }
    face_sum = (same_face ? face_sum : 0.0) + point.stiffness * inverse_mass;
    Shares& mine = shares[static_cast<std::size_t>(point.slot)];
    if (face_sum > mine.contact) {
      mine.contact = face_sum;
      mine.contact_face = point.face;
    }
  }
}

void name_limit(const StepModel& model, Index slot, const Shares& worst, StableStep& result) {
  result.element = model.mesh.element_of_slot[static_cast<std::size_t>(slot)];
  if (worst.contact >= worst.joint && worst.contact > worst.element) {
    result.limit = StepLimit::contact;
    result.face = worst.contact_face;
  } else if (worst.joint > worst.element) {
    result.limit = StepLimit::joint;
    result.face = worst.joint_face;
    const std::int32_t link = model.links.link[JointLinks::at(slot, worst.joint_face)];
    if (JointLinks::code_of(link) < 12) {
      result.neighbour = model.mesh.element_of_slot[static_cast<std::size_t>(JointLinks::slot_of(link))];
    }
  }
}

/// Shares of all slots; padding keeps zeros.
std::vector<Shares> all_shares(const StepModel& model, const Field<double>& position) {
  const LocalMesh& mesh = model.mesh;
  std::vector<Shares> shares(static_cast<std::size_t>(mesh.num_slots));
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (mesh.element_of_slot[static_cast<std::size_t>(s)] < 0) continue;
    Shares& mine = shares[static_cast<std::size_t>(s)];
    mine.element = element_share(model, s, position);
    mine.damping = mine.element * viscous_ratio(params_of(model, s));
    if (s < mesh.num_own_slots) add_joint_share(model, s, mine);
  }
  average_over_shared_nodes(model, shares);
  add_contact_shares(model, shares);
  return shares;
}

}  // namespace

double lightest_node(const LocalMesh& mesh) {
  double lightest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < mesh.node_mass.size(); ++n) {
    if (mesh.node_id[n] >= 0) lightest = std::min(lightest, mesh.node_mass[n]);
  }
  return lightest;
}

StableStep stable_step(const StepModel& model, const Field<double>& position) {
  const std::vector<Shares> shares = all_shares(model, position);
  constexpr double kNever = std::numeric_limits<double>::infinity();
  StableStep result{.step = kNever, .element_step = kNever, .joint_step = kNever};
  std::vector<double> steps;
  steps.reserve(shares.size());
  Index worst = -1;
  for (Index s = 0; s < model.mesh.num_slots; ++s) {
    const Shares& mine = shares[static_cast<std::size_t>(s)];
    if (!model.mesh.is_original(s)) continue;
    const double step = step_of(mine.element + mine.joint + mine.contact, mine.damping);
    steps.push_back(step);
    result.element_step = std::min(result.element_step, step_of(mine.element, mine.damping));
    result.joint_step = std::min(result.joint_step, step_of(mine.element + mine.joint, mine.damping));
    if (step < result.step) {
      result.step = step;
      worst = s;
    }
  }
  if (worst < 0) return result;
  name_limit(model, worst, shares[static_cast<std::size_t>(worst)], result);
  std::sort(steps.begin(), steps.end());
  constexpr std::array<double, 5> kProbability{0.0, 0.01, 0.1, 0.5, 1.0};
  for (std::size_t q = 0; q < kProbability.size(); ++q) {
    result.quantiles[q] = steps[static_cast<std::size_t>(kProbability[q] * static_cast<double>(steps.size() - 1))];
  }
  return result;
}

double true_stable_step(const StepModel& model) {
  double contact = 0, damping = 0;
  for (const Shares& mine : all_shares(model, model.mesh.reference)) {
    contact = std::max(contact, mine.contact);
    damping = std::max(damping, mine.damping);
  }
  return step_of(largest_eigenvalue(model) + contact, damping);
}

}  // namespace breccia
