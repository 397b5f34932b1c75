#pragma once

#include <type_traits>

#include "physics/elasticity.hpp"

namespace breccia {

/// The delayed normal force that limits friction.
template <class Real>
struct DelayedForceOf {
  Real force = 0.0;    ///< N
  Real age = 0.0;      ///< s, of the overlap, up to kSteadyAge longest delays; counts down while there is none
  Real halfway = 0.0;  ///< N, delayed by half of the delay: `force` follows it
};
using DelayedForce = DelayedForceOf<double>;

template <class Mask, class Real>
[[nodiscard]] DelayedForceOf<Real> select_delayed(const Mask& mask, const DelayedForceOf<Real>& a,
                                                  const DelayedForceOf<Real>& b) {
  using elasticity::select;
  return {select(mask, a.force, b.force), select(mask, a.age, b.age), select(mask, a.halfway, b.halfway)};
}

/// Age of an overlap from which on friction is latest, in longest delays. A half wave that presses for 0.3, 1 or 4 of
/// them rubs 0.1, 0.5 or 1.9 % more than by Coulomb's law.
inline constexpr double kSteadyAge = 14;

/// One step of a force f that follows the normal force f_n with a delay that grows with the age a of the overlap, in
/// two stages:
///
///   df/dt = (h - f) / (t/2),  dh/dt = (f_n - h) / (t/2),  t = longest min(1, (a / (kSteadyAge longest))^2)
///
/// Elastic bodies that slide on each other are unstable where the limit of friction follows the normal force at once:
/// friction feeds vibrations, which take it away [Adams 1995]. Where it follows over some crossings of the smaller body
/// by a wave they are not [Prakash and Clifton 1993; Ranjith and Rice 2001], but for what is left of the lag: a
/// vibration of frequency omega is fed in proportion to the part of f that is a quarter of a period behind,
/// 1/(omega t) with one stage, 16/(omega t)^3 with two. With one a block that slid down a slope of 30 degrees with a
/// coefficient of 0.5 came to hop within half a second. Between overlaps f stays as it is, so that in the mean over all
/// overlaps it is f_n.
/// @param second_stage  false: one stage, with a delay of t (ContactRules)
/// @param normal  N, f_n;  @param dt  s, >= 0;  @param longest  s, >= 0;  @param delayed  read and written
template <class Real>
void follow_normal_force(const std::type_identity_t<Real>& normal, const std::type_identity_t<Real>& dt,
                         const std::type_identity_t<Real>& longest, DelayedForceOf<Real>& delayed,
                         bool second_stage = true) {
  using elasticity::select;
  delayed.age = elasticity::lesser(Real(delayed.age + dt), Real(kSteadyAge * longest));
  const Real maturity = select(longest > 0.0, Real(delayed.age / (kSteadyAge * longest)), Real(0.0));
  const Real half = (second_stage ? 0.5 : 1.0) * longest * maturity * maturity;
  const auto late = dt < half;
  const Real share = dt / half;
  delayed.halfway = select(late, Real(delayed.halfway + (normal - delayed.halfway) * share), Real(normal));
  const Real force = second_stage ? Real(delayed.force + (delayed.halfway - delayed.force) * share) : delayed.halfway;
  delayed.force = select(late, force, Real(normal));
}

/// One step without overlap: what lifts off again and again stays old. If the age fell to a third as fast, blocks that
/// hop would slide 1 % too far in the mean instead of 0.4 %; three times as fast, driven blocks would vibrate with a
/// coefficient of 0.8.
template <class Real>
[[nodiscard]] DelayedForceOf<Real> without_overlap(const std::type_identity_t<Real>& dt,
                                                   const DelayedForceOf<Real>& delayed) {
  const Real age = delayed.age - dt;
  return select_delayed(age > 0.0, DelayedForceOf<Real>{delayed.force, age, delayed.halfway}, DelayedForceOf<Real>{});
}

}  // namespace breccia
