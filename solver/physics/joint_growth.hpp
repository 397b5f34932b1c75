#pragma once

// Growth of the damage of a joint point, and the energy that it takes (for T see joint_lanes.hpp). Branches on the
// law's parameters, which all lanes share, are branches; those on data are `select`, and a branch is left out only when
// no lane takes it.

#include "physics/joint_history.hpp"
#include "physics/joint_lanes.hpp"
#include "physics/joint_law_params.hpp"

namespace breccia::joint_point {

template <class T>
using Point = JointPointHistory<T>;

/// JointFrame.
template <class T>
struct Frame {
  Vector<T> normal;
  Vector<T> tangent[2];
};

/// An opening in the joint's axes.
template <class T>
struct Components {
  T normal;    // delta_n
  T open;      // <delta_n>
  T pressure;  // p, Pa
  Vector<T> shear_vector;
  T shear2;  // |delta_s|^2
  T shear;   // |delta_s|
};

template <class T>
[[nodiscard]] inline Components<T> split(const JointLawParams& law, const Frame<T>& frame, const Vector<T>& opening) {
  const T zero = 0.0;
  Components<T> c;
  c.normal = dot(opening, frame.normal);
  c.open = select(c.normal > zero, c.normal, zero);
  c.pressure = select(c.normal < zero, T(-law.stiffness * c.normal), zero);
  c.shear_vector = minus(opening, times(c.normal, frame.normal));
  c.shear2 = dot(c.shear_vector, c.shear_vector);
  c.shear = root(c.shear2);
  return c;
}

/// Squares of the openings at which the stiffness of each component was lost in an evaluation, m2: the opening at which
/// the loss began times the one at which it ended. With these the loss 1/2 k (loss of the share) (square) is, on a
/// straight path, the trapezoidal work less the change of the stored energy, and never negative on any path.
template <class T>
struct LossOpenings {
  T normal2, shear2;
};

/// Share of the stiffness k that remains to each component.
template <class T>
struct Remaining {
  T z;  // factor of both
  T secant_normal, secant_shear;
  [[nodiscard]] T normal() const { return z * secant_normal; }
  [[nodiscard]] T shear() const { return z * secant_shear; }
};

template <class T>
[[nodiscard]] inline Remaining<T> remaining_of(const JointLawParams& law, const Point<T>& h) {
  T z = h.strength_share;
  switch (law.law) {
    case JointLaw::mixed_mode:
      z = 1.0 - h.damage;
      break;
    case JointLaw::independent_peaks:
      break;
  }
  return {select(h.damage >= 1.0, T(0.0), z), h.secant_normal, h.secant_shear};
}

/// z(D) where it is wanted.
template <class T>
[[nodiscard]] inline T softened(const SofteningCurve& z, const T& level, const Mask<T>& wanted) {
  if constexpr (std::is_same_v<T, double>) {
    return wanted ? z(level) : 0.0;
  } else {
    T value = 0.0;
    for (std::size_t l = 0; l < T::size(); ++l) {
      if (wanted[l]) value[l] = z(level[l]);
    }
    return value;
  }
}

/// R of an opening: r, or (k |delta_s| - mu p)/c under pressure.
/// @param r  of an open one;  @param coulomb  mu p
template <class T>
[[nodiscard]] inline T reach_of(const JointLawParams& law, const T& r, const T& shear, const T& coulomb,
                                const Mask<T>& pressed) {
  return select(pressed, T((law.stiffness * shear - coulomb) / law.cohesion), r);
}

/// Lengths of both components of an opening, m.
template <class T>
struct Lengths {
  T open, shear;
};

/// Where a loss of the opening's stiffness begins. Without damage before, where its ray, on which R is 1 at the onset,
/// has the share 1/R of it, under pressure where k |delta_s| = c + mu p. What is damaged has been followed from
/// evaluation to evaluation: there on the way from the last opening, where R reaches R_old = z/(1-d). The ray would
/// miss that by what a component that falls meanwhile has changed by, an error of the work that is of first order in
/// the step.
/// @param reach  R of the opening
template <class T>
[[nodiscard]] inline Lengths<T> begin_of_loss(const JointLawParams& law, const Components<T>& c, const T& coulomb,
                                              const T& reach, const Point<T>& h) {
  const T zero = 0.0, one = 1.0;
  const T share = lesser(T(one / reach), one);
  const T onset = lesser(T((law.cohesion + coulomb) / law.stiffness), c.shear);
  const Lengths<T> ray{share * c.open, select(c.pressure > zero, onset, T(share * c.shear))};
  const Mask<T> damaged = h.damage > zero;
  if (!any(damaged)) return ray;
  const Lengths<T> last{greater(h.normal_opening, zero), h.shear_opening};
  const T x_n = last.open / law.onset_normal, x_s = last.shear / law.onset_shear;
  const T last_coulomb = law.friction * law.stiffness * greater(T(-h.normal_opening), zero);
  const T last_reach = reach_of(law, root(T(x_n * x_n + x_s * x_s)), last.shear, last_coulomb, h.normal_opening < zero);
  const T left = h.strength_share / (1.0 - h.damage) - last_reach, way = reach - last_reach;
  const T part = select(left > zero, select(left < way, T(left / way), one), zero);
  return {select(damaged, T(last.open + part * (c.open - last.open)), ray.open),
          select(damaged, T(last.shear + part * (c.shear - last.shear)), ray.shear)};
}

/// Takes the damage of an opening where it grows. The loss ends at the opening, but no farther than where, on its ray,
/// the damage is 1, (r - 1) Q = 1.
template <class T>
inline void grow_mixed_mode(const JointLawParams& law, const Components<T>& c, Point<T>& h, LossOpenings<T>& loss) {
  const T zero = 0.0, one = 1.0;
  const T coulomb = law.friction * c.pressure;
  const T onset_shear = (law.cohesion + coulomb) / law.stiffness;
  const T normal2 = (c.open / law.onset_normal) * (c.open / law.onset_normal);
  const T shear2 = c.shear2 / (onset_shear * onset_shear);
  const T r2 = normal2 + shear2;
  const Mask<T> growing = r2 > one && h.damage < one;
  if (!any(growing)) return;
  const T r = root(r2);
  const T reach = reach_of(law, r, c.shear, coulomb, c.pressure > zero);
  const T slope = (normal2 * law.onset_normal / law.width_normal + shear2 * onset_shear / law.width_shear) / r2;  // Q
  const T level = (r - 1.0) * slope;
  const Mask<T> full = growing && level >= one;
  // z falls with the level, so below the last one 1 - z/reach bounds the trial from above: no exp on unloading.
  const Mask<T> trying = growing && !full && !(level <= h.level && 1.0 - h.strength_share / reach <= h.damage);
  if (!any(trying) && !any(full)) return;
  const T z = softened(law.curve, level, trying), trial = 1.0 - z / reach;
  const Mask<T> partly = trying && trial > h.damage, grown = partly || full;
  const Lengths<T> begin = begin_of_loss(law, c, coulomb, reach, h);
  const T end = select(full, lesser(T((1.0 + 1.0 / slope) / r), one), one);
  const auto loss_of = [&](const T& from, const T& to) { return from * lesser(greater(T(end * to), from), to); };
  loss.normal2 = select(grown, loss_of(begin.open, c.open), loss.normal2);
  loss.shear2 = select(grown, loss_of(begin.shear, c.shear), loss.shear2);
  h.damage = select(full, one, select(partly, trial, h.damage));
  h.level = select(full, one, select(partly, level, h.level));
  h.strength_share = select(full, zero, select(partly, z, h.strength_share));
}

/// The same for independent peaks: where a component's own secant falls, its loss begins at f_t/(k s_n), (c/s_s + mu
/// p)/k of the last secants, and ends at the opening, but no farther than where that component alone is at damage 1.
template <class T>
inline void grow_independent_peaks(const JointLawParams& law, const Components<T>& c, Point<T>& h,
                                   LossOpenings<T>& loss) {
  const T zero = 0.0, one = 1.0;
  const double factor = peak_factor(law.rise);
  const T coulomb = law.friction * c.pressure;
  const T onset_shear = factor * (law.cohesion + coulomb) / law.stiffness;
  const Mask<T> may = h.damage < one;
  const Mask<T> beyond_normal = may && c.open > law.onset_normal, beyond_shear = may && c.shear > onset_shear;
  if (!any(beyond_normal) && !any(beyond_shear)) return;
  const T secant_n = law.tensile_strength / (law.stiffness * c.open);
  const Mask<T> falls_n = beyond_normal && secant_n < h.secant_normal;
  const T begin_n = greater(T(law.tensile_strength / (law.stiffness * h.secant_normal)), T(law.onset_normal));
  loss.normal2 = select(falls_n, T(begin_n * lesser(c.open, T(law.onset_normal + law.width_normal))), loss.normal2);
  h.secant_normal = select(falls_n, secant_n, h.secant_normal);
  const T secant_s = law.cohesion / (law.stiffness * c.shear - coulomb);
  const Mask<T> falls_s = beyond_shear && secant_s < h.secant_shear;
  const T begin_s = lesser(greater(T((law.cohesion / h.secant_shear + coulomb) / law.stiffness), onset_shear), c.shear);
  loss.shear2 = select(falls_s, T(begin_s * lesser(c.shear, T(onset_shear + law.width_shear))), loss.shear2);
  h.secant_shear = select(falls_s, secant_s, h.secant_shear);
  const T beyond_n = select(beyond_normal, T((c.open - law.onset_normal) / law.width_normal), zero);
  const T beyond_s = select(beyond_shear, T((c.shear - onset_shear) / law.width_shear), zero);
  const T level = root(T(beyond_n * beyond_n + beyond_s * beyond_s));
  const Mask<T> grown = may && level > h.damage;
  if (!any(grown)) return;
  const T capped = lesser(level, one);
  h.strength_share = select(grown, softened(law.curve, capped, grown && capped < one), h.strength_share);
  h.damage = select(grown, capped, h.damage);
  h.level = select(grown, capped, h.level);
}

/// Takes the damage of an opening where it grows, as the law wants it.
template <class T>
[[nodiscard]] inline LossOpenings<T> grow(const JointLawParams& law, const Components<T>& c, Point<T>& h) {
  // Where a component's stiffness falls without an opening beyond its own last one, it does so on the way from the last
  // evaluation.
  LossOpenings<T> loss{greater(T(h.normal_opening * c.open), T(0.0)), h.shear_opening * c.shear};
  switch (law.law) {
    case JointLaw::mixed_mode:
      grow_mixed_mode(law, c, h, loss);
      break;
    case JointLaw::independent_peaks:
      grow_independent_peaks(law, c, h, loss);
      break;
  }
  return loss;
}

/// In a failed joint the points with cohesion lose it in as many evaluations, for any opening: no force jumps.
inline constexpr double kFailureSteps = 64;

template <class T>
inline void let_go(const JointLawParams& law, const Mask<T>& failed, Point<T>& h) {
  const Mask<T> holds = failed && h.damage < 1.0;
  if (!any(holds)) return;
  h.damage = select(holds, lesser(T(h.damage + 1.0 / kFailureSteps), T(1.0)), h.damage);
  if (has_secants(law.law)) {
    h.strength_share = select(holds, softened(law.curve, h.damage, holds && h.damage < 1.0), h.strength_share);
  }
}

/// Energy that one component has lost with its stiffness, J/m2.
/// @param secant_before, share_before, secant, share  s and z s before and after
/// @param opening2  LossOpenings
template <class T>
[[nodiscard]] inline T component_loss(const JointLawParams& law, double onset, const T& secant_before,
                                      const T& share_before, const T& secant, const T& share, const T& opening2) {
  const T linear = 0.5 * law.stiffness * (share_before - share) * opening2;
  if (rises_linearly(law.rise)) return linear;
  // Before its peak the component holds z k delta^2 (1/2 - x/6), x = delta/onset; there it passes from k/3 to k/4.
  const T x = lesser(T(root(opening2) / onset), T(1.0));
  const T rising = law.stiffness * (share_before - share) * opening2 * (0.5 - x / 6.0);
  const T peak =
      law.stiffness * (share_before * (onset * onset / 12.0) + 0.5 * (0.5 * share_before - share) * opening2);
  return select(secant_before == 1.0, select(secant == 1.0, rising, peak), linear);
}

}  // namespace breccia::joint_point
