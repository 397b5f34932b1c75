#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/whole_power.hpp"

namespace breccia {

/// Interaction of two volume groups at a contact point. The default means: these groups do not touch.
struct ContactLaw {
  double penalty = 0;                                        ///< Pa, sigma_p: stress at overlap d = 1; 0: no contact
  double plateau = std::numeric_limits<double>::infinity();  ///< Pa, sigma_T; infinite: none
  double exponent = 1;                                       ///< b >= 1 of the unloading curve
  double friction = 0;                                       ///< Coulomb mu >= 0
  double tangential_ratio = 1;                               ///< tangential over normal stiffness, 0..1
  double damping = 0;                                        ///< Pa s/m, stress per speed of approach
  double friction_delay = 0;                                 ///< s/m, longest, over the extent of the smaller body

  [[nodiscard]] bool active() const { return penalty > 0; }
};

/// Least overlap over H at which a plateau begins, over b. Where a step does not resolve the way to the plateau a mass
/// gets all of that force or none: it chatters, sinks under half of the plateau, and gains energy. With this the
/// steepest slope of a law, of its unloading curve, is sigma_T / kLeastYield. With 1e-3 a tower that collapses
/// (meshes/cooling_tower) breaks 1,580 joints within 0.6 s instead of 1,597, in steps 1.6 times shorter.
inline constexpr double kLeastYield = 2.5e-3;
/// Largest penalty of a law with this plateau and exponent, Pa: sigma_T / (b kLeastYield).
[[nodiscard]] constexpr double largest_penalty(double plateau, double exponent) {
  return plateau / (exponent * kLeastYield);
}

/// Normal law with a plateau and a steeper unloading curve. Source: [Schiava, ch. 8] with the state reduced to one
/// number, the largest overlap d_max since the overlap began.
///
///   d <= 0:      sigma = 0, d_max forgotten
///   d >= d_max:  sigma = min(sigma_p d, sigma_T), d_max = d
///   d <  d_max:  sigma = sigma_max (d/d_max)^b,  sigma_max = min(sigma_p d_max, sigma_T); reloading follows the same
/// branch
///
/// d is dimensionless (overlap over H), energies are per contact area and per H: multiply by w H for J.
namespace normal_law {

/// State after the overlap has become d.
[[nodiscard]] inline double largest(double d, double d_max) { return d > 0 ? std::max(d, d_max) : 0.0; }

/// sigma_max, Pa.
[[nodiscard]] inline double peak(const ContactLaw& law, double d_max) {
  return std::min(law.penalty * d_max, law.plateau);
}

/// (d/d_max)^b, by multiplication where b is whole.
[[nodiscard]] inline double unloaded(double ratio, double exponent) {
  const int whole = static_cast<int>(exponent);
  return whole == exponent ? whole_power(ratio, whole) : std::pow(ratio, exponent);
}

/// sigma, Pa, compression positive. @pre d <= d_max unless d <= 0
[[nodiscard]] inline double stress(const ContactLaw& law, double d, double d_max) {
  if (!(d > 0)) return 0.0;
  // Never a d^b with a = sigma_max / d_max^b, which overflows for b = 6.
  return peak(law, d_max) * unloaded(d / d_max, law.exponent);
}

/// Energy that unloading from d would return, J/m3: the integral of sigma from 0 to d along the unloading curve.
/// @param stress  Pa, sigma there
[[nodiscard]] inline double stored_under(const ContactLaw& law, double d, double stress) {
  return d > 0 ? stress * d / (law.exponent + 1) : 0.0;
}
[[nodiscard]] inline double stored(const ContactLaw& law, double d, double d_max) {
  return stored_under(law, d, stress(law, d, d_max));
}

/// Energy that loading up to d_max has cost beyond what unloading returns, J/m3; never decreases with d_max.
[[nodiscard]] inline double dissipated(const ContactLaw& law, double d_max) {
  if (!(d_max > 0)) return 0.0;
  const double returned = 1 / (law.exponent + 1);
  const double yield = law.plateau / law.penalty;
  if (d_max <= yield) return law.penalty * d_max * d_max * (0.5 - returned);
  return law.plateau * (d_max * (1 - returned) - 0.5 * yield);
}

/// Stress with damping, Pa: sigma + c dg/dt, never a pull. What it adds to sigma times dg/dt is dissipated, and never
/// negative. With c = 2 zeta sqrt(sigma_p rho) a layer of thickness H and density rho on the stiffness sigma_p / H is
/// damped at the damping ratio zeta. @param rate  m/s, dg/dt of the overlap g in m
[[nodiscard]] inline double damped(const ContactLaw& law, double stress, double rate) {
  return std::max(0.0, stress + law.damping * rate);
}

}  // namespace normal_law
}  // namespace breccia
