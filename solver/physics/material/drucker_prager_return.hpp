#pragma once

#include "physics/material/drucker_prager_params.hpp"

namespace breccia::material {

/// A point of the plane of mean stress and shear: m = tr tau / 3, tension positive, s = sqrt(J2), Pa.
struct MeanAndShear {
  double mean = 0, shear = 0;
};

/// The stress that a trial stress returns to, and how far each mechanism flowed on the way.
struct ReturnedStress {
  MeanAndShear stress;
  double cone = 0;  ///< gamma_s >= 0: plastic engineering shear
  double cap = 0;   ///< gamma_c >= 0: compaction
  double cut = 0;   ///< gamma_t >= 0: volume gained at the cut-off

  [[nodiscard]] bool flows() const { return cone > 0 || cap > 0 || cut > 0; }
};

/// Return of a trial stress to the yield surface by the closest-point projection (implicit Euler):
///
///   f_s = s + eta m - xi c <= 0,     c   = c0 + H alpha,       d alpha = gamma_s,   flow  d(sqrt J2 + eta_g m)/d tau
///   f_c = -m - p_c <= 0,             p_c = p_c0 + H_c kappa,   d kappa = gamma_c,   flow -d m / d tau
///   f_t = m - T <= 0,                                                               flow  d m / d tau
///
///   m = m_trial - K (eta_g gamma_s - gamma_c + gamma_t),   s = s_trial - mu gamma_s
///
/// with gamma >= 0, f <= 0, gamma f = 0 for each. All of it is linear in this plane, so each case is solved in closed
/// form: cone, cap or cut-off alone, or the corner of the cone with one of the other two (Koiter's rule: both flow).
/// The matrix of cone and cap, and that of cone and cut-off, has positive principal minors: the solution is unique.
/// The cone's apex lies at or beyond the cut-off, and the corner there takes its place.
/// Sources: [Drucker 1952] the cone; [Sandler 1979] cap and cut-off; [Simo 1998, section 5.2] several surfaces.
///
/// @param mu, bulk       Pa, elastic moduli;  @param trial  elastic trial stress, shear >= 0
/// @param plastic_shear  alpha before;  @param compaction  kappa before
/// @post the stress fulfils every f <= 0 to round-off of the trial stress. The dissipation
/// gamma_s (s + eta_g m) + gamma_c p_c + gamma_t T is not negative, since eta_g <= eta and T >= 0.
[[nodiscard]] ReturnedStress return_stress(const DruckerPragerParams& p, double mu, double bulk,
                                           const MeanAndShear& trial, double plastic_shear, double compaction);

}  // namespace breccia::material
