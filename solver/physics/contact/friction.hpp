#pragma once

#include "base/types.hpp"

namespace breccia {

/// Coulomb friction of one contact point by a tangential spring. Source: [Cundall and Strack 1979], rotated with the
/// normal.
///
///   xi <- (I - n n^T) xi, brought back to its old length;  xi <- xi + (I - n n^T) motion
///   f_t = -k xi;  if |f_t| > limit: f_t is shortened to it and xi = -f_t / k
///
/// @param normal  unit vector
/// @param motion  m, of the point relative to the contactor during the step
/// @param k       N/m, > 0;  @param limit  N, mu f_n >= 0
/// @param xi      m, elongation of the spring, read and written
/// @return tangential force on the point, N
[[nodiscard]] inline Vec3 friction_force(const Vec3& normal, const Vec3& motion, double k, double limit, Vec3& xi) {
  const double length = xi.norm();
  xi -= normal.dot(xi) * normal;
  const double turned = xi.norm();
  if (turned > 0) xi *= length / turned;
  xi += motion - normal.dot(motion) * normal;
  const double trial = k * xi.norm();
  if (trial > limit) xi *= limit / trial;
  return -k * xi;
}

}  // namespace breccia
