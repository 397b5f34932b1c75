#include "physics/energy.hpp"

#include <array>
#include <span>
#include <utility>

#include <Eigen/Geometry>

namespace breccia {
namespace {

elasticity::Corners<double> corners_of(const LocalMesh& mesh, const double* field, Index slot) {
  elasticity::Corners<double> x;
  for (int c = 0; c < 4; ++c) {
    const double* p = field + nodal(mesh.corner_node(slot, c), 0);
    x[static_cast<std::size_t>(c)] = {p[0], p[8], p[16]};
  }
  return x;
}

/// Calls account(nodes) for all that this rank counts: an element with its own four nodes, whose terms are the same on
/// any rank, or a shared node.
template <class Account>
void for_each_carrier(const LocalMesh& mesh, Account&& account) {
  for (Index s = 0; s < mesh.num_own_originals; ++s) {
    if (!mesh.is_original(s)) continue;
    const std::array nodes{own_corner_node(s, 0), own_corner_node(s, 1), own_corner_node(s, 2), own_corner_node(s, 3)};
    account(std::span<const Index>(nodes));
  }
  for (Index n = mesh.num_own_nodes(); n < mesh.num_nodes; ++n) {
    if (mesh.counted[static_cast<std::size_t>(n)] != 0) account(std::span(&std::as_const(n), 1));
  }
}

/// Exact sum over carriers of what add(node, energy) adds to the energy of each.
template <class Add>
ExactSum sum_over_nodes(const LocalMesh& mesh, Add&& add) {
  ExactSum sum;
  for_each_carrier(mesh, [&](std::span<const Index> nodes) {
    double energy = 0;
    for (const Index n : nodes) add(n, energy);
    sum.add(energy);
  });
  return sum;
}

}  // namespace

ExactSum kinetic_energy(const LocalMesh& mesh, const double* velocity_before, const double* velocity_after,
                        double change) {
  return sum_over_nodes(mesh, [&](Index n, double& energy) {
    const std::size_t at = nodal(n, 0);
    const double product = velocity_before[at] * velocity_after[at] + velocity_before[at + 8] * velocity_after[at + 8] +
                           velocity_before[at + 16] * velocity_after[at + 16];
    const double mass = mesh.node_mass[static_cast<std::size_t>(n)];
    energy += 0.5 * mass * product;
    if (change == 0) return;
    const Vec3 before = load_node(velocity_before, n), after = load_node(velocity_after, n);
    energy += 0.5 * change * mass * (after - before).dot(after);
  });
}

ExactSum step_change_energy(const LocalMesh& mesh, const double* velocity_before, const double* velocity_after,
                            double change) {
  return sum_over_nodes(mesh, [&](Index n, double& energy) {
    const Vec3 kicked = load_node(velocity_after, n) - load_node(velocity_before, n);
    energy += 0.5 * change * mesh.node_mass[static_cast<std::size_t>(n)] * kicked.squaredNorm();
  });
}

ElasticEnergy elastic_energy(const LocalMesh& mesh, std::span<const ElasticParams> params_of_group,
                             const double* position, const MaterialMemory& memory) {
  ElasticEnergy energy;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    const auto i = static_cast<std::size_t>(s);
    const ElasticParams& p = params_of_group[static_cast<std::size_t>(mesh.block_group[i / kLanes])];
    if (!mesh.is_original(s) || !is_hyperelastic(p.law)) continue;
    elasticity::Tensor<double> inverse;
    for (std::size_t k = 0; k < 9; ++k) inverse[k] = mesh.gradient[i / kLanes * 72 + k * kLanes + i % kLanes];
    const elasticity::Tensor<double> f = elasticity::deformation<double>(corners_of(mesh, position, s), inverse);
    const double density = has_memory(p.law) ? stored_energy(p, f, memory.of(s)) : elasticity::neo_hookean_energy(f, p);
    if (density > energy.largest_density) {
      energy.largest_density = density;
      energy.worst_slot = s;
    }
    energy.total.add(mesh.volume[i] * density);
  }
  return energy;
}

ExactSum plastic_work(const LocalMesh& mesh, std::span<const ElasticParams> params_of_group,
                      const MaterialMemory& memory) {
  ExactSum sum;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    const auto i = static_cast<std::size_t>(s);
    const int place = plastic_work_place(params_of_group[static_cast<std::size_t>(mesh.block_group[i / kLanes])].law);
    if (place >= 0 && mesh.is_original(s)) sum.add(mesh.volume[i] * memory.of(s)[place]);
  }
  return sum;
}

ExactSum intact_joint_energy(const LocalMesh& mesh, const JointLinks& links, const double* position) {
  const auto id = [&](Index slot) { return mesh.element_of_slot[static_cast<std::size_t>(slot)]; };
  ExactSum sum;
  for (Index s = 0; s < mesh.num_own_originals; ++s) {
    for (int face = 0; face < 4; ++face) {
      const std::int32_t link = links.link[JointLinks::at(s, face)];
      const int code = JointLinks::code_of(link);
      if (code >= 12 || id(JointLinks::slot_of(link)) < id(s)) continue;
      double squares = 0;
      for (int i = 0; i < 3; ++i) {
        const Index own = own_corner_node(s, kFaceCorners[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)]);
        const Index other = own_corner_node(JointLinks::slot_of(link), linked_corner(code, i));
        squares += (load_node(position, other) - load_node(position, own)).squaredNorm();
      }
      sum.add(0.5 * links.stiffness[JointLinks::at(s, face)] * squares);
    }
  }
  return sum;
}

Momentum momentum(const LocalMesh& mesh, const double* position, const double* velocity) {
  Momentum sums;
  for_each_carrier(mesh, [&](std::span<const Index> nodes) {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (const Index n : nodes) {
      const Vec3 p = mesh.node_mass[static_cast<std::size_t>(n)] * load_node(velocity, n);
      linear += p;
      angular += load_node(position, n).cross(p);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      sums.linear[i].add(linear[static_cast<Eigen::Index>(i)]);
      sums.angular[i].add(angular[static_cast<Eigen::Index>(i)]);
    }
  });
  return sums;
}

}  // namespace breccia
