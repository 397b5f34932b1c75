#pragma once

#include <array>
#include <cstddef>

#include "physics/material/bulk_law.hpp"
#include "physics/material/principal.hpp"

/// Drucker-Prager plasticity with a cut-off of tension and a cap on pressure, non-associated, with linear hardening, at
/// finite strain.
///
/// Elasticity: Hencky's. The elastic left Cauchy-Green tensor b = F G F^T, G = C_p^-1, has eigenvalues x_i and axes
/// n_i; with the logarithmic strains e_i = ln(x_i) / 2 the stored energy is
///   W = mu sum e_i^2 + lambda/2 (sum e_i)^2,  J/m3 of reference volume,
/// and the Kirchhoff stress tau = J T has the same axes and the values tau_i = 2 mu e_i + lambda sum e_j.
/// Plasticity: the yield surface and the flow of physics/material/drucker_prager_return.hpp in tau. With these strains
/// and the exponential map for the flow the return is that of small strains [Simo 1992]; the plastic strains de_i leave
///   G <- G + F^-1 [sum x_i (exp(-2 de_i) - 1) n_i n_i^T] F^-T.
/// Strengths bound the Kirchhoff stress: the Cauchy stress is larger by 1/J, J the volume over that at rest.
/// Objective: the memory does not feel a rotation. Elastic loops are closed to the bit.
///
/// Crushed and turned-over elements (J <= j_min) do not flow, and their memory stays as it was at the last step above:
/// with S_0 and C_0, the second Piola stress and C of that step,
///   W = W_0 + S_0 : (C - C_0) / 2 + K_c/2 (J - j_min)^2,   P = F S_0 + K_c (J - j_min) cof F,
/// K_c the curvature of the neo-Hookean law at j_min. Continuous, finite for every F; it pushes the element open.
namespace breccia::material {

/// What an element remembers; all zero when virgin.
struct DruckerPragerMemory {
  Symmetric inverse_plastic{};  ///< C_p^-1 - I
  Symmetric deformation{};      ///< F^T F - I of the last step
  double plastic_shear = 0;     ///< alpha: sum of the cone's flow, engineering shear strain
  double compaction = 0;        ///< kappa: volume lost at the cap, logarithmic
  double plastic_work = 0;      ///< J/m3 of reference volume
};
inline constexpr std::array<MemoryField, 5> kDruckerPragerFields{{
    {"inverse_plastic", "1", 6},
    {"deformation", "1", 6},
    {"plastic_shear", "1", 1},
    {"compaction", "1", 1},
    {"plastic_work", "J/m3", 1},
}};
inline constexpr std::size_t kDruckerPragerMemory = 15;
static_assert(sizeof(DruckerPragerMemory) == kDruckerPragerMemory * sizeof(double));

/// First Piola stress at a deformation gradient, Pa, and what the element remembers from there on.
///
/// plastic_work grows by the trapezoid (tau_before + tau)/2 : de_p, tau_before = tau_trial - (stress of the step's
/// strain): to second order what the internal forces do under central differences beyond the change of W; the implicit
/// tau : de_p, which is never negative, lies above it by first order. Where one step leads from one side of the surface
/// to the other the trapezoid can be negative; then nothing is added.
///
/// @param f       F, row-major;  @param memory  kDruckerPragerMemory numbers, read and written
/// @param piola   out: row-major 3 x 3.  @pre p.law == drucker_prager. Throws nothing, allocates nothing.
void drucker_prager_piola(const ElasticParams& p, const double* f, double* memory, double* piola);

/// Stored energy, J/m3 of reference volume. @param memory  as of the step that ended at f
[[nodiscard]] double drucker_prager_energy(const ElasticParams& p, const double* f, const double* memory);

/// Bound of the elastic tangent for the stable step, Pa/m2: the largest eigenvalue of an element's stiffness is at most
/// its volume times this. Plastic flow only softens.
///   sum_a [(lambda + 2 mu r) |F^-T g_a|^2 + max |tau_i / x_i| g_a . G g_a],
/// r the largest ratio of elastic stretches; for crushed elements
///   sum_a [K_c |cof F g_a|^2 + (|S_0| + K_c (j_min - J) |F|) |g_a|^2].
/// @param gradient  D_m^-1, row-major, 1/m: rows are g_1 g_2 g_3, and g_0 = -(g_1 + g_2 + g_3)
[[nodiscard]] double drucker_prager_stiffness(const ElasticParams& p, const double* f, const double* memory,
                                              const double* gradient);

}  // namespace breccia::material
