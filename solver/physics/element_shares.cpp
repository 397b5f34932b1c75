#include "physics/element_shares.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "physics/frequency_block.hpp"

namespace breccia {

void frequency_block_sse2(const FrequencyGroup& group, const double* corners, const double* gradient, double* out);
void frequency_block_avx2(const FrequencyGroup& group, const double* corners, const double* gradient, double* out);
void frequency_block_avx512(const FrequencyGroup& group, const double* corners, const double* gradient, double* out);

namespace {

namespace el = elasticity;

const ElasticParams& params_of(const StepModel& model, Index slot) {
  return model.params[at(model.mesh.block_group[at(slot / kLanes)])];
}

double density_of(const StepModel& model, Index slot) {
  return model.density[at(model.mesh.block_group[at(slot / kLanes)])];
}

/// omega_e^2 of an element whose law has a memory.
double frequency_with_memory(const StepModel& model, Index slot, const double* corners) {
  const auto lane = at(slot % kLanes);
  el::Corners<double> x;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 3; ++i) x[c][i] = corners[(3 * c + i) * kLanes + lane];
  }
  el::Tensor<double> g;
  for (std::size_t i = 0; i < 9; ++i) g[i] = model.mesh.gradient[at(slot / kLanes) * 72 + i * kLanes + lane];
  const el::Tensor<double> f = el::deformation<double>(x, g);
  return 4.0 / density_of(model, slot) * bulk_stiffness(params_of(model, slot), f, model.memory.of(slot), g);
}

/// Adds up k A0/3 of the joints on the faces of own-node elements, and on shared nodes.
void sum_joints(const StepModel& model, std::vector<std::array<double, 4>>& own, std::vector<double>& shared) {
  const LocalMesh& mesh = model.mesh;
  for (Index s = 0; s < mesh.num_own_slots; ++s) {
    for (int f = 0; f < 4; ++f) own[at(s)][at(f)] = model.links.stiffness[JointLinks::at(s, f)];
  }
  const auto add = [&](Index slot, int face, double stiffness) {
    if (slot < mesh.num_own_slots) {
      own[at(slot)][at(face)] += stiffness;
      return;
    }
    for (const int corner : kFaceCorners[at(face)])
      shared[at(mesh.corner_node(slot, corner) - mesh.num_own_nodes())] += stiffness;
  };
  for (const JointStiffness& joint : model.joints) {
    add(joint.slot_a, joint.face_a, joint.stiffness);
    add(joint.slot_b, joint.code / 3, joint.stiffness);
  }
}

}  // namespace

FrequencyFunction frequencies_for(Simd simd) {
  switch (simd) {
    case Simd::avx512:
      return frequency_block_avx512;
    case Simd::avx2:
      return frequency_block_avx2;
    case Simd::sse2:
      break;
  }
  return frequency_block_sse2;
}

ElementShares::ElementShares(const StepModel& model)
    : frequency_(at(model.mesh.num_slots)),
      joint_(at(model.mesh.num_own_slots)),
      stiffest_joint_(at(model.mesh.num_own_slots)),
      nodes_(at(model.mesh.num_nodes - model.mesh.num_own_nodes())) {
  const LocalMesh& mesh = model.mesh;
  std::vector<double> shared(nodes_.size(), 0.0);
  sum_joints(model, joint_, shared);
  for (Index s = 0; s < mesh.num_own_slots; ++s) {
    const double mass = mesh.node_mass[at(own_corner_node(s, 0))];
    StepShare share{.by_face = true};
    for (std::size_t f = 0; f < 4; ++f) share.joint[f] = joint_[at(s)][f] = 2.0 * joint_[at(s)][f] / mass;
    stiffest_joint_[at(s)] = share.largest_joint();
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    nodes_[n].joint = 2.0 * shared[n] / mesh.node_mass[n + at(mesh.num_own_nodes())];
}

void ElementShares::update(const StepModel& model, const Field<double>& position) {
  static const FrequencyFunction kernel = frequencies_for(best_simd());
  const LocalMesh& mesh = model.mesh;
  FrequencyGroup group;
  BlockCorners room;
  for (Index b = 0; b < mesh.num_blocks(); ++b) {
    const Index first = b * kLanes;
    const double* corners = mesh.block_corners(b, position.data(), room);
    const ElasticParams& p = params_of(model, first);
    if (has_memory(p.law)) {
      for (Index s = first; s < first + kLanes; ++s)
        frequency_[at(s)] = mesh.element_of_slot[at(s)] < 0 ? 0.0 : frequency_with_memory(model, s, corners);
      continue;
    }
    if (group.params != &p) group = {&p, density_of(model, first), el::volumetric_slope(p.j_min, p)};
    kernel(group, corners, &mesh.gradient[at(b) * 72], &frequency_[at(first)]);
  }
  average(model);
}

/// Replaces omega_e^2 of shared-node elements by the mean around each of their nodes, damping by the largest.
void ElementShares::average(const StepModel& model) {
  const LocalMesh& mesh = model.mesh;
  if (mesh.num_own_slots == mesh.num_slots) return;
  for (Node& node : nodes_) node.mass_sum = node.stiff_sum = node.damping_sum = 0;
  for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
    if (mesh.element_of_slot[at(s)] < 0) continue;
    const double mass = 0.25 * density_of(model, s) * mesh.volume[at(s)];
    const double damping = frequency_[at(s)] * viscous_ratio(params_of(model, s));
    for (int c = 0; c < 4; ++c) {
      Node& node = nodes_[at(mesh.corner_node(s, c) - mesh.num_own_nodes())];
      node.mass_sum += mass;
      node.stiff_sum += mass * frequency_[at(s)];
      node.damping_sum += mass * damping;
    }
  }
  for (Node& node : nodes_) {
    if (!(node.mass_sum > 0)) continue;
    node.element = node.stiff_sum / node.mass_sum;
    node.damping = node.damping_sum / node.mass_sum;
  }
}

StepShare ElementShares::of(const StepModel& model, Index slot) const {
  const LocalMesh& mesh = model.mesh;
  StepShare share;
  if (mesh.element_of_slot[at(slot)] < 0) return share;
  share.by_face = slot < mesh.num_own_slots;
  if (share.by_face) {
    share.element.fill(frequency_[at(slot)]);
    share.joint = joint_[at(slot)];
    share.damping = damping(model, slot);
    return share;
  }
  share.damping = damping(model, slot);
  for (std::size_t c = 0; c < 4; ++c) {
    const Node& node = nodes_[at(mesh.corner_node(slot, static_cast<int>(c)) - mesh.num_own_nodes())];
    share.element[c] = node.element;
    share.joint[c] = node.joint;
  }
  return share;
}

double ElementShares::largest(const LocalMesh& mesh, Index slot) const {
  if (slot < mesh.num_own_slots) return frequency_[at(slot)] + stiffest_joint_[at(slot)];
  double most = 0;
  for (int c = 0; c < 4; ++c) {
    const Node& node = nodes_[at(mesh.corner_node(slot, c) - mesh.num_own_nodes())];
    most = std::max(most, node.element + node.joint);
  }
  return most;
}

double ElementShares::damping(const StepModel& model, Index slot) const {
  const LocalMesh& mesh = model.mesh;
  if (slot < mesh.num_own_slots) return frequency_[at(slot)] * viscous_ratio(params_of(model, slot));
  double most = 0;
  for (int c = 0; c < 4; ++c)
    most = std::max(most, nodes_[at(mesh.corner_node(slot, c) - mesh.num_own_nodes())].damping);
  return most;
}

double ElementShares::stiffest(const LocalMesh& mesh) const {
  double most = 0;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (mesh.is_original(s)) most = std::max(most, largest(mesh, s));
  }
  return most;
}

}  // namespace breccia
