#pragma once

#include <array>
#include <span>

#include "base/exact_sum.hpp"
#include "base/types.hpp"
#include "discretisation/joint_links.hpp"
#include "discretisation/local_mesh.hpp"
#include "physics/elasticity.hpp"
#include "physics/material/bulk_law.hpp"

namespace breccia {

/// Terms of the energy budget that are functions of the state: this rank's part. Sums run over the originals, nodes
/// that this rank counts, joints whose lower element is an original; computed only when a history line is due.
/// O(elements), no allocation, throws nothing.

/// Kinetic energy of central differences at t_n, J: sum of m v_(n-1/2) . v_(n+1/2) / 2, the form that together with the
/// potential energy at x_n is conserved exactly by a linear system. Where the step changes, with s m (v_(n+1/2) -
/// v_(n-1/2)) . v_(n+1/2) / 2 more: what holds from t_n on under the new step. With it a change of the step by D moves
/// the energy of free vibrations by -D/(4 kick) sum of m |v_(n+1/2) - v_(n-1/2)|^2 and no more: what central
/// differences conserve depends on the step, for a vibration of frequency omega as 1 - (omega dt / 2)^2 at the same
/// amplitude. The budget has a term of its own for it (step_change_energy).
/// @param change  s = (before - dt)/(before + dt), 0 where the step stays the same (physics/kick.hpp)
[[nodiscard]] ExactSum kinetic_energy(const LocalMesh& mesh, const double* velocity_before,
                                      const double* velocity_after, double change = 0);

/// What a change of the step moves kinetic_energy by, J: s/2 sum of m |v_(n+1/2) - v_(n-1/2)|^2.
[[nodiscard]] ExactSum step_change_energy(const LocalMesh& mesh, const double* velocity_before,
                                          const double* velocity_after, double change);

/// Strain energy of all elements whose law has one, J.
struct ElasticEnergy {
  ExactSum total;
  double largest_density = 0;  ///< J/m3
  Index worst_slot = -1;       ///< element with that density
};
[[nodiscard]] ElasticEnergy elastic_energy(const LocalMesh& mesh, std::span<const ElasticParams> params_of_group,
                                           const double* position, const MaterialMemory& memory = {});

/// Plastic work of all elements so far, J.
[[nodiscard]] ExactSum plastic_work(const LocalMesh& mesh, std::span<const ElasticParams> params_of_group,
                                    const MaterialMemory& memory);

/// Energy of the joints the sweep evaluates (intact, elastic), J: k A0/3 |opening|^2 / 2 over the corners, each joint
/// once.
[[nodiscard]] ExactSum intact_joint_energy(const LocalMesh& mesh, const JointLinks& links, const double* position);

/// Linear momentum, kg m/s, and angular momentum about the origin, kg m2/s.
struct Momentum {
  std::array<ExactSum, 3> linear, angular;
};
/// @param position  x_n;  @param velocity  v_(n-1/2): with x_n the pair that internal forces leave unchanged to
/// round-off
[[nodiscard]] Momentum momentum(const LocalMesh& mesh, const double* position, const double* velocity);

}  // namespace breccia
