#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "physics/elasticity.hpp"

// Where a point is in a tetrahedron: for Real = double and for several couples side by side, lane by lane with the same
// bits.

namespace breccia {

/// A contactor made ready for many points: its corner 0 and the gradients of lambda_1..3 in the current configuration.
template <class Real>
struct PreparedTetraOf {
  std::array<Real, 3> origin;
  std::array<std::array<Real, 3>, 3> gradient;  ///< 1/m; NaN for an inert contactor
};
using PreparedTetra = PreparedTetraOf<double>;

/// Below this fraction of its reference volume an element is crushed or inverted and touches nothing.
inline constexpr double kInertVolumeRatio = 0.01;

/// @param x  corners, m, x[corner][axis];  @param volume  m3, at rest. O(1)
template <class Real, class Corners>
[[nodiscard]] PreparedTetraOf<Real> prepared_tetra(const Corners& x, const Real& volume) {
  const Real a0 = x[1][0] - x[0][0], a1 = x[1][1] - x[0][1], a2 = x[1][2] - x[0][2];
  const Real b0 = x[2][0] - x[0][0], b1 = x[2][1] - x[0][1], b2 = x[2][2] - x[0][2];
  const Real c0 = x[3][0] - x[0][0], c1 = x[3][1] - x[0][1], c2 = x[3][2] - x[0][2];
  const Real p0 = b1 * c2 - b2 * c1, p1 = b2 * c0 - b0 * c2, p2 = b0 * c1 - b1 * c0;
  const Real det = a0 * p0 + a1 * p1 + a2 * p2;
  const auto alive = det > 6 * kInertVolumeRatio * volume;
  const Real s = elasticity::select(alive, Real(1.0 / det), Real(std::numeric_limits<double>::quiet_NaN()));
  return {{x[0][0], x[0][1], x[0][2]},
          {{{p0 * s, p1 * s, p2 * s},
            {(c1 * a2 - c2 * a1) * s, (c2 * a0 - c0 * a2) * s, (c0 * a1 - c1 * a0) * s},
            {(a1 * b2 - a2 * b1) * s, (a2 * b0 - a0 * b2) * s, (a0 * b1 - a1 * b0) * s}}}};
}

/// A point counts as inside down to this lambda, so that round-off opens no gap between neighbouring elements.
inline constexpr double kInside = 1e-9;
/// Share of its heights by which an element reaches beyond its faces for a point that was in it. Joints break before
/// they open so far: critical opening over height is 0.1 % in meshes/glass_impact, 0.4 % in block_wall, 0.8 % in disc.
inline constexpr double kGap = 0.01;

/// Barycentric coordinates of x. NaN for an inert contactor.
template <class Real, class Place>
[[nodiscard]] std::array<Real, 4> barycentric(const PreparedTetraOf<Real>& tetra, const Place& x) {
  const Real r0 = x[0] - tetra.origin[0], r1 = x[1] - tetra.origin[1], r2 = x[2] - tetra.origin[2];
  const auto along = [&](const std::array<Real, 3>& g) { return Real(g[0] * r0 + g[1] * r1 + g[2] * r2); };
  const Real l1 = along(tetra.gradient[0]), l2 = along(tetra.gradient[1]), l3 = along(tetra.gradient[2]);
  return {Real(1.0 - l1 - l2 - l3), l1, l2, l3};
}

/// How far all nodes may move before a point that is outside can come to within lambda >= -reach, m; 0 if it is there.
/// What has lambda >= -reach is the hull of four corners, each of which moves by at most (1 + 6 reach) times as much as
/// the nodes, and it lies on the other side of the plane lambda_k = -reach, k that of the smallest lambda.
/// @pre the contactor is not inert
template <class Real>
[[nodiscard]] Real safe_travel(const PreparedTetraOf<Real>& tetra, const std::array<Real, 4>& lambda,
                               const std::type_identity_t<Real>& reach) {
  using elasticity::select;
  using std::sqrt;
  const auto& g = tetra.gradient;
  Real least = lambda[0];
  std::array<Real, 3> slope;
  for (std::size_t i = 0; i < 3; ++i) slope[i] = -(g[0][i] + g[1][i] + g[2][i]);
  for (std::size_t k = 1; k < 4; ++k) {
    const auto less = lambda[k] < least;
    least = select(less, lambda[k], least);
    for (std::size_t i = 0; i < 3; ++i) slope[i] = select(less, g[k - 1][i], slope[i]);
  }
  const Real steepness = sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
  constexpr double kRoundOff = 1.001;
  return elasticity::greater(Real(0.0), Real(-least - reach)) / (steepness * (2 + 6 * reach) * kRoundOff);
}

}  // namespace breccia
