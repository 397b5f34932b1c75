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
