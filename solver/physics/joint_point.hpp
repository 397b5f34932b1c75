#pragma once

// The joint law of physics/joint_law.hpp at a point, for T = double and for T = std::experimental::simd<double, ...>,
// lane by lane: the same operations in the same order for every T, hence the same bits. Branches on the law's
// parameters, which all lanes share, are branches; those on data are `select`, and a branch is left out only when no
// lane takes it. No function here is compiled for a plain type in a unit of a wider instruction set (sweep_kernel.hpp
// says why): all are templates over T.

#include <experimental/simd>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "physics/elasticity.hpp"
#include "physics/joint_history.hpp"
#include "physics/joint_law_params.hpp"

namespace breccia::joint_point {

using elasticity::select;
using elasticity::Vector;

template <class T>
struct MaskOf {
  using type = typename T::mask_type;
};
template <>
struct MaskOf<double> {
  using type = bool;
};
template <class T>
using Mask = typename MaskOf<T>::type;

template <class M>
[[nodiscard]] inline bool any(const M& mask) {
  if constexpr (std::is_same_v<M, bool>) {
    return mask;
  } else {
    return std::experimental::any_of(mask);
  }
}
template <class M>
[[nodiscard]] inline bool all(const M& mask) {
  if constexpr (std::is_same_v<M, bool>) {
    return mask;
  } else {
    return std::experimental::all_of(mask);
  }
}

template <class T>
[[nodiscard]] inline T root(const T& x) {
  using std::sqrt;
  return sqrt(x);
}
/// The lesser; a when they are equal or one is not a number.
template <class T>
[[nodiscard]] inline T lesser(const T& a, const T& b) {
  return select(b < a, b, a);
}
template <class T>
[[nodiscard]] inline T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
[[nodiscard]] inline Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
[[nodiscard]] inline Vector<T> plus(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
[[nodiscard]] inline Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
[[nodiscard]] inline Vector<T> times(const T& factor, const Vector<T>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
template <class T>
[[nodiscard]] inline Vector<T> select3(const Mask<T>& mask, const Vector<T>& a, const Vector<T>& b) {
  return {select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])};
}

/// JointFrame.
template <class T>
struct Frame {
  Vector<T> normal;
  Vector<T> tangent[2];
};

template <class T>
using Point = JointPointHistory<T>;

/// JointPointResponse.
template <class T>
struct Response {
  Vector<T> traction;
  T mode_1, mode_2, friction;
  Mask<T> elastic;
};

/// An opening in the joint's axes.
template <class T>
struct Components {
  T normal;    // delta_n
  T open;      // <delta_n>
  T pressure;  // p, Pa
  Vector<T> shear_vector;
  T shear2;  // |delta_s|^2
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
  return c;
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

/// Takes the damage of an opening where it may grow. Returns the share of the opening, along its ray, at which the
/// elastic range ends; at most 1.
template <class T>
[[nodiscard]] inline T grow_mixed_mode(const JointLawParams& law, const Components<T>& c, const Mask<T>& may,
                                       Point<T>& h) {
  const T one = 1.0;
  const T coulomb = law.friction * c.pressure;
  const T onset_shear = (law.cohesion + coulomb) / law.stiffness;
  const T normal2 = (c.open / law.onset_normal) * (c.open / law.onset_normal);
  const T shear2 = c.shear2 / (onset_shear * onset_shear);
  const T r2 = normal2 + shear2;
  const Mask<T> beyond = may && r2 > one;
  if (!any(beyond)) return one;
  const T r = root(r2);
  const T reach = select(c.pressure > 0.0, T((law.stiffness * root(c.shear2) - coulomb) / law.cohesion), r);
  const T end_of_elastic = select(beyond, lesser(T(1.0 / reach), one), one);
  const Mask<T> growing = beyond && h.damage < one;
  if (!any(growing)) return end_of_elastic;
  const T level =
      (r - 1.0) / r2 * (normal2 * law.onset_normal / law.width_normal + shear2 * onset_shear / law.width_shear);
  const Mask<T> full = growing && level >= one;
  // z falls with the level, so below the last one 1 - z/reach bounds the trial from above: no exp on unloading.
  const Mask<T> trying = growing && !full && !(level <= h.level && 1.0 - h.strength_share / reach <= h.damage);
  if (any(trying)) {
    const T z = softened(law.curve, level, trying), trial = 1.0 - z / reach;
    const Mask<T> grown = trying && trial > h.damage;
    h.damage = select(grown, trial, h.damage);
    h.level = select(grown, level, h.level);
    h.strength_share = select(grown, z, h.strength_share);
  }
  h.damage = select(full, one, h.damage);
  h.level = select(full, one, h.level);
  h.strength_share = select(full, T(0.0), h.strength_share);
  return end_of_elastic;
}

template <class T>
[[nodiscard]] inline T grow_independent_peaks(const JointLawParams& law, const Components<T>& c, const Mask<T>& may,
                                              Point<T>& h) {
  const T zero = 0.0, one = 1.0;
  const double factor = peak_factor(law.rise);
  const T coulomb = law.friction * c.pressure;
  const T onset_shear = factor * (law.cohesion + coulomb) / law.stiffness;
  const T shear = root(c.shear2);
  const Mask<T> beyond_normal = may && c.open > law.onset_normal, beyond_shear = may && shear > onset_shear;
  if (!any(beyond_normal) && !any(beyond_shear)) return one;
  const T secant_n = law.tensile_strength / (law.stiffness * c.open);
  h.secant_normal = select(beyond_normal, lesser(h.secant_normal, secant_n), h.secant_normal);
  const T beyond_n = select(beyond_normal, T((c.open - law.onset_normal) / law.width_normal), zero);
  T end_of_elastic = select(beyond_normal, T(factor * secant_n), one);
  const T secant_s = law.cohesion / (law.stiffness * shear - coulomb);
  h.secant_shear = select(beyond_shear, lesser(h.secant_shear, secant_s), h.secant_shear);
  const T beyond_s = select(beyond_shear, T((shear - onset_shear) / law.width_shear), zero);
  end_of_elastic = select(beyond_shear, lesser(end_of_elastic, T(factor * secant_s)), end_of_elastic);
  const T level = root(T(beyond_n * beyond_n + beyond_s * beyond_s));
  const Mask<T> grown = may && level > h.damage;
  if (any(grown)) {
    const T capped = lesser(level, one);
    h.strength_share = select(grown, softened(law.curve, capped, grown && capped < one), h.strength_share);
    h.damage = select(grown, capped, h.damage);
    h.level = select(grown, capped, h.level);
  }
  return lesser(end_of_elastic, one);
}

/// Takes the damage of an opening where it may grow, as the law wants it. Returns as grow_mixed_mode.
template <class T>
[[nodiscard]] inline T grow(const JointLawParams& law, const Components<T>& c, const Mask<T>& may, Point<T>& h) {
  switch (law.law) {
    case JointLaw::mixed_mode:
      return grow_mixed_mode(law, c, may, h);
    case JointLaw::independent_peaks:
      return grow_independent_peaks(law, c, may, h);
  }
  __builtin_unreachable();
}

/// Share of the stiffness k that remains to each component.
template <class T>
struct Remaining {
  T z;  // factor of both
  T secant_normal, secant_shear;
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

/// One component: traction over opening, Pa/m, and energy held, J/m2.
template <class T>
struct ComponentState {
  T stiffness, stored;
};

template <class T>
[[nodiscard]] inline ComponentState<T> component_state(const JointLawParams& law, double onset, const T& z,
                                                       const T& secant, const T& opening2) {
  const T stiffness = z * secant * law.stiffness;
  const ComponentState<T> linear{stiffness, 0.5 * stiffness * opening2};
  if (rises_linearly(law.rise)) return linear;
  // f (2x - x^2), x = opening/onset, onset = 2f/k: before the peak of this component.
  const Mask<T> rising = secant == 1.0;
  const T x = lesser(T(root(opening2) / onset), T(1.0));
  return {select(rising, T(z * law.stiffness * (1.0 - 0.5 * x)), linear.stiffness),
          select(rising, T(z * law.stiffness * opening2 * (0.5 - x / 6.0)), linear.stored)};
}

/// State of a point after its damage is known.
template <class T>
struct PointState {
  T normal;           // sigma
  T shear_stiffness;  // tau = shear_stiffness delta_s + friction
  T friction[2];      // along the tangents
  T stored_normal, stored_shear, stored_friction;
};

template <class T>
[[nodiscard]] inline PointState<T> state_of(const JointLawParams& law, const Components<T>& c,
                                            const Remaining<T>& remaining) {
  const T zero = 0.0;
  const ComponentState<T> open =
      component_state(law, law.onset_normal, remaining.z, remaining.secant_normal, T(c.normal * c.normal));
  const ComponentState<T> s = component_state(law, law.onset_shear, remaining.z, remaining.secant_shear, c.shear2);
  const Mask<T> is_open = c.normal > zero;
  const T normal = select(is_open, open.stiffness, T(law.stiffness)) * c.normal;
  const T stored = select(is_open, open.stored, T(0.5 * law.stiffness * c.normal * c.normal));
  return {normal, s.stiffness, {zero, zero}, stored, s.stored, zero};
}

/// sigma n + tau without friction.
template <class T>
[[nodiscard]] inline Vector<T> cohesive_traction(const Frame<T>& frame, const Components<T>& c,
                                                 const PointState<T>& now) {
  return plus(times(now.normal, frame.normal), times(now.shear_stiffness, c.shear_vector));
}

/// Friction of the damaged share: moves the slip so that the spring stays within Coulomb's limit. Returns what friction
/// of the last state and this one, in the mean, dissipates on this slip.
template <class T>
[[nodiscard]] inline T slide(const JointLawParams& law, const Frame<T>& frame, const Components<T>& c, const T& weight,
                             const Mask<T>& on, Point<T>& h, PointState<T>& now) {
  const T zero = 0.0;
  const T limit = law.friction * c.pressure / law.stiffness;
  T spring[2], moved[2];
  for (std::size_t i = 0; i < 2; ++i) spring[i] = dot(c.shear_vector, frame.tangent[i]) - h.slip[i];
  const T length2 = spring[0] * spring[0] + spring[1] * spring[1];
  const Mask<T> sliding = on && length2 > limit * limit;
  const T keep = limit / root(length2);
  for (std::size_t i = 0; i < 2; ++i) {
    moved[i] = select(sliding, T((1.0 - keep) * spring[i]), zero);
    spring[i] = select(sliding, T(spring[i] * keep), spring[i]);
    h.slip[i] = select(sliding, T(h.slip[i] + moved[i]), h.slip[i]);
  }
  T dissipated = zero;
  for (std::size_t i = 0; i < 2; ++i) {
    now.friction[i] = select(on, T(weight * law.stiffness * spring[i]), zero);
    dissipated += 0.5 * (h.friction_traction[i] + now.friction[i]) * moved[i];
  }
  now.stored_friction =
      select(on, T(0.5 * weight * law.stiffness * (spring[0] * spring[0] + spring[1] * spring[1])), zero);
  // The slip that the first damage finds was not slid: nothing weighed on it.
  return select(on && h.friction_weight > 0.0, dissipated, zero);
}

/// The last evaluation, for the work of this one, where it was not made or was made without the normal: a fresh history
/// is put where the ray of the opening left the elastic range, at `share` of it; an elastic one gets its parts along
/// the normal.
template <class T>
inline void complete_memory(const JointLawParams& law, const Frame<T>& frame, const Vector<T>& opening, const T& share,
                            const Mask<T>& wanted, Point<T>& h) {
  const T zero = 0.0, one = 1.0;
  const Mask<T> fresh = wanted && h.memory == kFresh, missing = wanted && h.memory < kDivided;
  if (!any(missing)) return;
  h.opening = select3<T>(fresh, times(share, opening), h.opening);
  const Components<T> c = split(law, frame, h.opening);
  const PointState<T> now = state_of(law, c, Remaining<T>{one, one, one});
  h.traction = select3<T>(fresh, cohesive_traction(frame, c, now), h.traction);
  h.normal_opening = select(missing, c.normal, h.normal_opening);
  h.normal_traction = select(missing, now.normal, h.normal_traction);
  for (T& traction : h.friction_traction) traction = select(missing, zero, traction);
  h.stored_normal = select(missing, now.stored_normal, h.stored_normal);
  h.stored_shear = select(missing, now.stored_shear, h.stored_shear);
  h.stored_friction = select(missing, zero, h.stored_friction);
}

/// Contract: evaluate_point of joint_law.hpp.
template <class T>
[[nodiscard]] inline Response<T> evaluate(const JointLawParams& law, const Frame<T>& frame, const Vector<T>& opening,
                                          Point<T>& h) {
  const T zero = 0.0;
  const Components<T> c = split(law, frame, opening);
  T end_of_elastic = 1.0;
  if (law.breakable()) end_of_elastic = grow(law, c, Mask<T>(h.damage < 1.0 || h.memory == kFresh), h);
  const Remaining<T> remaining = remaining_of(law, h);
  PointState<T> now = state_of(law, c, remaining);
  const Vector<T> elastic_traction = times(T(law.stiffness), opening);
  Response<T> response{elastic_traction, zero, zero, zero, Mask<T>(rises_linearly(law.rise)) && h.damage == 0.0};
  const Mask<T> damaged = !response.elastic;
  if (any(damaged)) {
    complete_memory(law, frame, opening, end_of_elastic, damaged, h);
    Vector<T> traction = cohesive_traction(frame, c, now);
    T friction = zero;
    if (law.friction > 0) {
      const T weight = 1.0 - remaining.shear();
      const Mask<T> rubs = damaged && weight > 0.0;
      friction = slide(law, frame, c, weight, rubs, h, now);
      const Vector<T> rubbed =
          plus(traction, plus(times(now.friction[0], frame.tangent[0]), times(now.friction[1], frame.tangent[1])));
      traction = select3<T>(rubs, rubbed, traction);
      h.friction_weight = select(damaged, weight, h.friction_weight);
    }
    response.traction = select3<T>(damaged, traction, elastic_traction);
    const T work = 0.5 * dot(plus(h.traction, response.traction), minus(opening, h.opening));
    const T normal_work = 0.5 * (h.normal_traction + now.normal) * (c.normal - h.normal_opening);
    const T mode_1 = normal_work - (now.stored_normal - h.stored_normal);
    const T mode_2 = (work - normal_work) - (now.stored_shear - h.stored_shear) -
                     (now.stored_friction - h.stored_friction) - friction;
    const Mask<T> without_hold = h.memory == kWithoutHold;
    response.friction = select(damaged, select(without_hold, T(friction + (mode_1 + mode_2)), friction), zero);
    response.mode_1 = select(damaged && !without_hold, mode_1, zero);
    response.mode_2 = select(damaged && !without_hold, mode_2, zero);
  }
  h.memory = select(damaged && h.damage >= 1.0, T(kWithoutHold), T(kDivided));
  h.opening = opening;
  h.traction = response.traction;
  h.normal_opening = c.normal;
  h.normal_traction = now.normal;
  for (std::size_t i = 0; i < 2; ++i) h.friction_traction[i] = now.friction[i];
  h.stored_normal = now.stored_normal;
  h.stored_shear = now.stored_shear;
  h.stored_friction = now.stored_friction;
  return response;
}

/// The same where the caller knows the point to be elastic and without damage, without a frame: what it remembers of
/// it.
template <class T>
inline void set_elastic(const JointLawParams& law, const Vector<T>& opening, Point<T>& h) {
  h.memory = kUndivided;
  h.opening = opening;
  h.traction = times(T(law.stiffness), opening);
  h.stored_normal = 0.5 * law.stiffness * dot(opening, opening);
  h.stored_shear = 0.0;
}

}  // namespace breccia::joint_point
