#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "physics/elasticity.hpp"
#include "physics/work_error.hpp"

namespace breccia {

/// Forces that keep the work of a contact equal to what its law stores and dissipates. Central differences do the work
/// of a force over a step as the mean of its values at both ends times the motion. That is exact for a linear law but
/// for the steps in which the overlap begins or ends: of a motion D the force k d of an overlap d < D takes 1/2 k d D
/// where 1/2 k d^2 is stored, so up to k D^2 / 8 is lost where it begins and gained where it ends.
/// For Real = double and for several couples side by side, lane by lane with the same bits.

/// Largest pull of a couple, N, after a motion D out of the overlap: k D / 4. With a pull of k D a mass comes back
/// faster than it left where steps are long, and such contacts gain energy.
template <class Real>
[[nodiscard]] constexpr Real largest_pull(const Real& k, const Real& out) {
  return 2 * kLargestWorkError * k * out;
}

/// How much a force may be changed in a step of a motion D along it, J each.
template <class Real>
struct BalancingLimitsOf {
  Real own = 0.0;   ///< beyond it what the couple has gained is not that of a step at which an overlap begins or ends
  Real give = 0.0;  ///< of work given back to the motion
  Real take = 0.0;  ///< taken from it
};
using BalancingLimits = BalancingLimitsOf<double>;

template <class Mask, class Real>
[[nodiscard]] BalancingLimitsOf<Real> select_limits(const Mask& mask, const BalancingLimitsOf<Real>& a,
                                                    const BalancingLimitsOf<Real>& b) {
  using elasticity::select;
  return {select(mask, a.own, b.own), select(mask, a.give, b.give), select(mask, a.take, b.take)};
}

/// Of a linear law. Half of the force is that of one which begins at the very end of a step.
/// @param work  J, of the normal force over the motion;  @param k  N/m
template <class Real>
[[nodiscard]] BalancingLimitsOf<Real> balancing_limits(const Real& work, const Real& k, const Real& out) {
  using std::abs;
  const Real most = elasticity::lesser(Real(kLargestWorkError * k * out * out), Real(0.5 * abs(work)));
  return {most, most, most};
}

/// While a couple unloads along a steep curve (b > 1), any step of which may leave next to no force of one that was
/// large before: what that has gained is taken back by a pull. Of the force itself no more is taken than its steepest
/// slope b k could take within the motion: what has hardly begun to leave comes back within the next step, which has to
/// be borne. Not while it loads, where larger changes make the contact stiffer than the time step allows.
/// @param work  J, > 0;  @param exponent  b
template <class Real>
[[nodiscard]] BalancingLimitsOf<Real> steep_limits(const Real& work, const Real& k,
                                                   const std::type_identity_t<Real>& exponent, const Real& out) {
  const Real most = elasticity::lesser(work, Real(exponent * k * out * out));
  return {std::numeric_limits<double>::infinity(), balancing_limits(work, k, out).give,
          most + largest_pull(k, out) * out};
}

/// N; a pull as a fraction of less, at the far end of a steep curve, may overflow.
inline constexpr double kNoForce = 1e-60;

/// Shares of the normal force to be added to it.
template <class Real>
struct BalancingSharesOf {
  Real own = 0.0;     ///< for this overlap
  Real before = 0.0;  ///< for earlier ones
};
using BalancingShares = BalancingSharesOf<double>;

/// With these shares this step and the next one, taken to move as this one, give back what the couple has taken too
/// much or take what it has gained. None for this overlap where that is more than the steps at which an overlap begins
/// or ends can have left over: such a force would be too large for the motion. Up to that limit, and step by step, what
/// earlier overlaps have left is put right: contacts that last for a few steps end before they can do so themselves.
/// @param gained  J, what the couple would have gained with the force as it is;  @param before  J, of earlier overlaps
/// @param work    J, of the normal force over the motion, not 0
template <class Real>
[[nodiscard]] BalancingSharesOf<Real> balancing_shares(const std::type_identity_t<Real>& gained,
                                                       const std::type_identity_t<Real>& before,
                                                       const std::type_identity_t<Real>& work,
                                                       const BalancingLimitsOf<Real>& limits) {
  using elasticity::select, std::abs;
  const auto clamp = [](const Real& value, const Real& low, const Real& high) {
    return select(value < low, low, select(high < value, high, value));
  };
  const Real own = select(abs(gained) <= limits.own, clamp(gained, -limits.give, limits.take), Real(0.0));
  const Real earlier = clamp(before, -limits.give - own, limits.take - own);
  return {-own / work, -earlier / work};
}

/// Gap beyond which what a couple has left over is forgotten, over the motion within which a step can leave so much.
/// Undamped platens on rock lose 17 % of the energy in 20,000 steps where all is forgotten at once, 4 % with 16, 1 %
/// with 32, 0.06 % with 128, 0.03 % with 1000. What flies apart is soon farther away.
inline constexpr double kRememberedGap = 1000;

/// Force of a couple whose overlap has ended, N: takes back what it has gained, over this step and the next one,
/// assuming that the next motion equals this one. None while the gap closes, or where there is next to nothing left.
/// Never larger than the force before or than the largest pull.
/// @param last  N, force one step ago: of the law (`pushed`), or of this function
template <class Vector>
[[nodiscard]] Vector closing_force(double gained, const Vector& last, const Vector& motion, bool pushed, double k) {
  const double work = last.dot(motion), against = pushed ? work : -work;
  if (!(against > 0)) return Vector::Zero();
  const double out = against / last.norm(), most = largest_pull(k, out) * out;
  if (!(gained > 0.5 * kNegligibleWorkError * most)) return Vector::Zero();
  return std::min(std::min(gained, most) / against, 1.0) * (pushed ? Vector(-last) : last);
}

/// Force of a couple whose overlap has ended, N: returns energy that it has taken too much, or that it still stores as
/// its point has left across an edge, as a slope beyond the edge would. A stable step allows k dt^2 <= 4 m: the next
/// motion is at most 4 F / k longer, so that no more is returned than is missing. None where the point comes back, or
/// where there is next to nothing to return.
/// @param missing  J;  @param outward  unit vector;  @param k  N/m
template <class Vector>
[[nodiscard]] Vector opening_force(double missing, const Vector& outward, const Vector& motion, double k) {
  const double out = outward.dot(motion);
  if (!(out > 0) || !(missing > 0.5 * kNegligibleWorkError * largest_pull(k, out) * out)) return Vector::Zero();
  return 0.25 * k * (std::sqrt(out * out + 8 * missing / k) - out) * outward;
}

}  // namespace breccia
