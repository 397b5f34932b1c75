#pragma once

#include <limits>
#include <type_traits>

#include "physics/elasticity.hpp"

namespace breccia {

/// Interaction of two volume groups at a contact point, over the number type. The default means: these groups do not
/// touch.
template <class T>
struct ContactLawOf {
  T penalty = 0.0;                                      ///< Pa, sigma_p: stress at overlap d = 1; 0: no contact
  T plateau = std::numeric_limits<double>::infinity();  ///< Pa, sigma_T; infinite: none
  T exponent = 1.0;                                     ///< b >= 1 of the unloading curve
  T friction = 0.0;                                     ///< Coulomb mu >= 0
  T tangential_ratio = 1.0;                             ///< tangential over normal stiffness, 0..1
  T damping = 0.0;                                      ///< Pa s/m, stress per speed of approach
  T friction_delay = 0.0;                               ///< s/m, longest, over the extent of the smaller body

  [[nodiscard]] bool active() const { return penalty > 0; }
};
using ContactLaw = ContactLawOf<double>;

/// Calls f(the number in each of the laws) for all numbers of a law.
template <class F, class... Laws>
[[gnu::always_inline]] constexpr void for_each_law_number(F&& f, Laws&... laws) {
  f(laws.penalty...);
  f(laws.plateau...);
  f(laws.exponent...);
  f(laws.friction...);
  f(laws.tangential_ratio...);
  f(laws.damping...);
  f(laws.friction_delay...);
}

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
/// For T = double and for a SIMD vector, lane by lane with the same bits.
namespace normal_law {

using elasticity::greater;
using elasticity::lesser;
using elasticity::select;

/// ratio^exponent, by multiplication where the exponent is whole. Not inline: units of wider instruction sets call it.
[[nodiscard]] double power(double ratio, double exponent);

template <class T>
[[nodiscard]] inline T unloaded(const T& ratio, const T& exponent) {
  if constexpr (std::is_same_v<T, double>) {
    return power(ratio, exponent);
  } else {
    return T([&](auto lane) { return power(ratio[lane], exponent[lane]); });
  }
}

/// State after the overlap has become d.
template <class T>
[[nodiscard]] inline T largest(const T& d, const T& d_max) {
  return select(d > 0.0, greater(d, d_max), T(0.0));
}

/// sigma, Pa, compression positive. @pre d <= d_max unless d <= 0
template <class T>
[[nodiscard]] inline T stress(const ContactLawOf<T>& law, const T& d, const T& d_max) {
  // Never a d^b with a = sigma_max / d_max^b, which overflows for b = 6.
  const auto overlaps = d > 0.0;
  const T peak = lesser(T(law.penalty * d_max), law.plateau);
  const T ratio = select(overlaps, T(d / d_max), T(0.0));
  return select(overlaps, T(peak * unloaded(ratio, law.exponent)), T(0.0));
}

/// Energy that unloading from d would return, J/m3: the integral of sigma from 0 to d along the unloading curve.
/// @param stress  Pa, sigma there
template <class T>
[[nodiscard]] inline T stored_under(const ContactLawOf<T>& law, const T& d, const T& stress) {
  return select(d > 0.0, T(stress * d / (law.exponent + 1.0)), T(0.0));
}
template <class T>
[[nodiscard]] inline T stored(const ContactLawOf<T>& law, const T& d, const T& d_max) {
  return stored_under(law, d, stress(law, d, d_max));
}

/// Energy that loading up to d_max has cost beyond what unloading returns, J/m3; never decreases with d_max.
template <class T>
[[nodiscard]] inline T dissipated(const ContactLawOf<T>& law, const T& d_max) {
  const T returned = 1.0 / (law.exponent + 1.0);
  const T yield = law.plateau / law.penalty;
  const T beyond = select(d_max <= yield, T(law.penalty * d_max * d_max * (0.5 - returned)),
                          T(law.plateau * (d_max * (1.0 - returned) - 0.5 * yield)));
  return select(d_max > 0.0, beyond, T(0.0));
}

/// Stress with damping, Pa: sigma + c dg/dt, never a pull. What it adds to sigma times dg/dt is dissipated, and never
/// negative. With c = 2 zeta sqrt(sigma_p rho) a layer of thickness H and density rho on the stiffness sigma_p / H is
/// damped at the damping ratio zeta. @param rate  m/s, dg/dt of the overlap g in m
template <class T>
[[nodiscard]] inline T damped(const ContactLawOf<T>& law, const T& stress, const std::type_identity_t<T>& rate) {
  return greater(T(0.0), T(stress + law.damping * rate));
}

}  // namespace normal_law
}  // namespace breccia
