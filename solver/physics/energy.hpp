#pragma once

#include <span>

#include "base/types.hpp"
#include "physics/elasticity.hpp"
#include "state/joint_links.hpp"
#include "state/local_mesh.hpp"

namespace breccia {

/// Terms of the energy budget that are functions of the state. Sums run over elements or nodes in ascending slots and are
/// compensated; computed only when a history line is due. O(elements), no allocation, throws nothing.

/// Kinetic energy of central differences at t_n, J: sum of m v_(n-1/2) . v_(n+1/2) / 2, the form that together with the
/// potential energy at x_n is conserved exactly by a linear system.
[[nodiscard]] double kinetic_energy(const LocalMesh& mesh, const double* velocity_before, const double* velocity_after);

/// Strain energy of all elements whose law has one (neo-Hookean), J.
struct ElasticEnergy {
  double total = 0;
  double largest_density = 0;  ///< J/m3
  Index worst_slot = -1;       ///< element with that density
};
[[nodiscard]] ElasticEnergy elastic_energy(const LocalMesh& mesh, std::span<const ElasticParams> params_of_group, const double* position);

/// Energy of the joints the sweep looks after (intact, elastic), J: k A0/3 |opening|^2 / 2 over the corners, each joint once.
[[nodiscard]] double intact_joint_energy(const LocalMesh& mesh, const JointLinks& links, const double* position);

/// Linear momentum, kg m/s, and angular momentum about the origin, kg m2/s.
struct Momentum {
  Vec3 linear{0, 0, 0};
  Vec3 angular{0, 0, 0};
};
/// @param position  x_n;  @param velocity  v_(n-1/2): with x_n the pair that internal forces leave unchanged to round-off
[[nodiscard]] Momentum momentum(const LocalMesh& mesh, const double* position, const double* velocity);

}  // namespace breccia
