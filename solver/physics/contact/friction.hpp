#pragma once

#include <type_traits>

#include "physics/elasticity.hpp"

// For Vector = Vec3 and for LaneVector (physics/lane_vector.hpp), whose numbers are those of several contact points:
// the same operations in the same order, hence the same bits.

namespace breccia {

/// What friction does to a contact point in a step.
template <class Vector>
struct FrictionStep {
  Vector force;                        ///< N, tangential, on the point
  typename Vector::Scalar dissipated;  ///< J, >= 0
};

/// Coulomb friction of one contact point by a tangential spring. Source: [Cundall and Strack 1979], rotated with the
/// normal.
///
///   xi <- (I - n n^T) xi, brought back to its old length: xi_0;  xi <- xi_0 + (I - n n^T) motion
///   f_t = -k xi;  if |f_t| > limit: f_t is shortened to it and xi = -f_t / k, the rest of xi is the slip s
///   dissipated: <k/2 (xi_0 + xi) . s>, the mean force of the step over the slip
///
/// While the spring only turns or stretches nothing is dissipated: what a turning spring does to the work of the step
/// is left to the residual of the energy budget.
///
/// @param normal  unit vector
/// @param motion  m, of the point relative to the contactor during the step
/// @param k       N/m, > 0;  @param limit  N, mu f_n >= 0
/// @param xi      m, elongation of the spring, read and written
template <class Vector, class Real = typename Vector::Scalar>
[[nodiscard]] FrictionStep<Vector> friction_step(const std::type_identity_t<Vector>& normal,
                                                 const std::type_identity_t<Vector>& motion,
                                                 const std::type_identity_t<Real>& k,
                                                 const std::type_identity_t<Real>& limit, Vector& xi) {
  using elasticity::select;
  const Real zero(0.0), one(1.0);
  const Real length = xi.norm();
  xi -= normal.dot(xi) * normal;
  const Real turned = xi.norm();
  xi *= select(turned > zero, Real(length / turned), one);
  const Vector before = xi;
  xi += motion - normal.dot(motion) * normal;
  const Real trial = k * xi.norm();
  const auto slides = trial > limit;
  const Vector stretched = xi;
  xi *= select(slides, Real(limit / trial), one);
  const Real dissipated = elasticity::greater(zero, Real(0.5 * k * (before + xi).dot(stretched - xi)));
  return {-k * xi, select(slides, dissipated, zero)};
}

/// The delayed normal force that limits friction.
template <class Real>
struct DelayedForceOf {
  Real force = 0.0;    ///< N
  Real age = 0.0;      ///< s, of the overlap, up to kSteadyAge longest delays; counts down while there is none
  Real halfway = 0.0;  ///< N, delayed by half of the delay: `force` follows it
};
using DelayedForce = DelayedForceOf<double>;

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
/// @param normal  N, f_n;  @param dt  s, >= 0;  @param longest  s, >= 0;  @param delayed  read and written
template <class Real>
void follow_normal_force(const std::type_identity_t<Real>& normal, const std::type_identity_t<Real>& dt,
                         const std::type_identity_t<Real>& longest, DelayedForceOf<Real>& delayed) {
  using elasticity::select;
  delayed.age = elasticity::lesser(Real(delayed.age + dt), Real(kSteadyAge * longest));
  const Real settled = select(longest > 0.0, Real(delayed.age / (kSteadyAge * longest)), Real(0.0));
  const Real half = 0.5 * longest * settled * settled;
  const auto late = dt < half;
  const Real share = dt / half;
  delayed.halfway = select(late, Real(delayed.halfway + (normal - delayed.halfway) * share), Real(normal));
  delayed.force = select(late, Real(delayed.force + (delayed.halfway - delayed.force) * share), Real(normal));
}

/// One step without overlap: what lifts off again and again stays old. If the age fell to a third as fast, blocks that
/// hop would slide 1 % too far in the mean instead of 0.4 %; three times as fast, driven blocks would vibrate with a
/// coefficient of 0.8.
inline void forget_normal_force(double dt, DelayedForce& delayed) {
  delayed.age -= dt;
  if (!(delayed.age > 0)) delayed = {};
}

/// Turns a spring with the surfaces that it lies between, by an angle about their normal: a point that sticks to a body
/// spinning about the normal is treated as on one at rest. Cayley's form of the rotation keeps lengths; it turns by
/// a - a^3/12 for an angle a.
/// @param normal  unit vector;  @param angle  rad, of both surfaces in the mean during the step
template <class Vector, class Real = typename Vector::Scalar>
void turn_spring(const std::type_identity_t<Vector>& normal, const std::type_identity_t<Real>& angle, Vector& xi) {
  const Vector half = 0.5 * angle * normal;
  const Vector across = half.cross(xi);
  xi += 2.0 / (1.0 + half.squaredNorm()) * (across + half.cross(across));
}

/// Of a spring that is released in a step, J, >= 0: the same with the limit 0. @param motion  as above, along the
/// surface
template <class Vector>
[[nodiscard]] double released_by_friction(const std::type_identity_t<Vector>& motion, double k, const Vector& xi) {
  return elasticity::greater(0.0, 0.5 * k * xi.dot(xi + motion));
}

}  // namespace breccia
