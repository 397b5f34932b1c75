#pragma once

#include <cmath>
#include <limits>

namespace breccia {

/// Yield surface and flow of the Drucker-Prager law (physics/material/drucker_prager.hpp). Made by
/// `make_drucker_prager`.
struct DruckerPragerParams {
  double friction = 0;         ///< eta >= 0: slope of the cone
  double dilation = 0;         ///< eta_g: slope of the flow potential, 0 <= eta_g <= eta
  double cohesion_factor = 1;  ///< xi > 0
  double cohesion = 0;         ///< Pa, c0 >= 0
  double hardening = 0;        ///< Pa, H >= 0: dc / d(plastic shear)
  double tension_cutoff = std::numeric_limits<double>::infinity();  ///< Pa, T: 0 <= T <= xi c0 / eta
  double cap_pressure = std::numeric_limits<double>::infinity();    ///< Pa, p_c0 > 0
  double cap_hardening = 0;                                         ///< Pa, H_c >= 0: dp_c / d(compaction)
};

/// The cone through the triaxial compression edges of Mohr-Coulomb's pyramid [de Souza Neto 2008, eq. 6.123]:
/// eta = 6 sin(phi) / (sqrt 3 (3 - sin phi)), xi = 6 cos(phi) / (sqrt 3 (3 - sin phi)), eta_g likewise from psi.
/// So a sample under lateral pressure s fails at s (1 + sin phi)/(1 - sin phi) + 2 c cos(phi)/(1 - sin phi).
/// @param friction_angle, dilation_angle  phi, psi, rad;  @pre 0 <= psi <= phi < pi/2
[[nodiscard]] inline DruckerPragerParams make_drucker_prager(double friction_angle, double dilation_angle,
                                                             double cohesion) {
  const auto over = [](double angle) { return 6.0 / (std::sqrt(3.0) * (3.0 - std::sin(angle))); };
  DruckerPragerParams p;
  p.friction = over(friction_angle) * std::sin(friction_angle);
  p.dilation = over(dilation_angle) * std::sin(dilation_angle);
  p.cohesion_factor = over(friction_angle) * std::cos(friction_angle);
  p.cohesion = cohesion;
  if (p.friction > 0) p.tension_cutoff = p.cohesion_factor * cohesion / p.friction;
  return p;
}

}  // namespace breccia
