#pragma once

// The joint law of physics/joint_law.hpp at a point, over the number type (joint_lanes.hpp).

#include "physics/joint_growth.hpp"

namespace breccia::joint_point {

/// What a point holds, J/m2.
template <class T>
struct Stored {
  T open, shear, pressed, spring;  // by the cohesion normal and along the joint, by pressure, by friction
  [[nodiscard]] T all() const { return open + shear + pressed + spring; }
};

/// JointPointResponse, and what the point holds.
template <class T>
struct Response {
  Vector<T> traction;
  T mode_1, mode_2, friction, viscous;
  Stored<T> stored;
  Mask<T> elastic;
};

/// One component: traction over opening, Pa/m, and energy held, J/m2.
template <class T>
struct ComponentState {
  T stiffness, stored;
};

/// @param z, secant  Remaining;  @param opening, opening2  its length and the square of it
template <class T>
[[nodiscard]] inline ComponentState<T> component_state(const JointLawParams& law, double onset, const T& z,
                                                       const T& secant, const T& opening, const T& opening2) {
  const T stiffness = z * secant * law.stiffness;
  const ComponentState<T> linear{stiffness, 0.5 * stiffness * opening2};
  if (rises_linearly(law.rise)) return linear;
  // f (2x - x^2), x = opening/onset, onset = 2f/k: before the peak of this component.
  const Mask<T> rising = secant == 1.0;
  const T x = lesser(T(opening / onset), T(1.0));
  return {select(rising, T(z * law.stiffness * (1.0 - 0.5 * x)), linear.stiffness),
          select(rising, T(z * law.stiffness * opening2 * (0.5 - x / 6.0)), linear.stored)};
}

/// State of a point after its damage is known.
template <class T>
struct PointState {
  T normal;           // sigma
  T shear_stiffness;  // tau = shear_stiffness delta_s + friction
  T friction[2];      // along the tangents
  Stored<T> stored;
};

template <class T>
[[nodiscard]] inline PointState<T> state_of(const JointLawParams& law, const Components<T>& c,
                                            const Remaining<T>& remaining) {
  const T zero = 0.0;
  const ComponentState<T> open =
      component_state(law, law.onset_normal, remaining.z, remaining.secant_normal, c.open, T(c.open * c.open));
  const ComponentState<T> shear =
      component_state(law, law.onset_shear, remaining.z, remaining.secant_shear, c.shear, c.shear2);
  const Mask<T> is_open = c.normal > zero;
  const T pressed = select(is_open, zero, T(0.5 * law.stiffness * c.normal * c.normal));
  return {select(is_open, open.stiffness, T(law.stiffness)) * c.normal,
          shear.stiffness,
          {zero, zero},
          {open.stored, shear.stored, pressed, zero}};
}

/// What friction does in an evaluation.
template <class T>
struct Sliding {
  T dissipated;  // J/m2
  T spring2;     // m2, square of the spring's length afterwards
};

/// Friction of the damaged share: moves the slip so that the spring stays within Coulomb's limit. It dissipates
/// tau_f . ds along the spring, of the mean of the limits before and after the step, of which the one before is no more
/// than what the spring would hold if it had not slid.
template <class T>
[[nodiscard]] inline Sliding<T> slide(const JointLawParams& law, const Frame<T>& frame, const Components<T>& c,
                                      const T& weight, const Mask<T>& on, Point<T>& h, PointState<T>& now) {
  const T zero = 0.0;
  const T limit = law.friction * c.pressure / law.stiffness;
  T spring[2], moved[2];
  for (std::size_t i = 0; i < 2; ++i) spring[i] = dot(c.shear_vector, frame.tangent[i]) - h.slip[i];
  const T length2 = spring[0] * spring[0] + spring[1] * spring[1], length = root(length2);
  const Mask<T> sliding = on && length2 > limit * limit;
  const T keep = limit / length;
  for (std::size_t i = 0; i < 2; ++i) {
    moved[i] = select(sliding, T((1.0 - keep) * spring[i]), zero);
    spring[i] = select(sliding, T(spring[i] * keep), spring[i]);
    h.slip[i] = select(sliding, T(h.slip[i] + moved[i]), h.slip[i]);
    now.friction[i] = select(on, T(weight * law.stiffness * spring[i]), zero);
  }
  const T spring2 = select(on, T(spring[0] * spring[0] + spring[1] * spring[1]), zero);
  now.stored.spring = 0.5 * weight * law.stiffness * spring2;
  const T limit_before = law.friction * greater(T(-h.normal_opening), zero);
  const T mean = 0.5 * (h.friction_weight * lesser(limit_before, length) + weight * limit);
  // The slip that the first damage finds was not slid: nothing weighed on it.
  const Mask<T> slid = sliding && h.friction_weight > zero;
  return {select(slid, T(law.stiffness * mean * (length - limit)), zero), spring2};
}

/// Twice the energy, J/m2, that central differences gain where a point opens from pressure within a step: of what it
/// stores now, less what it stored at `last` < 0, less the trapezoidal work on it. @param moved  from last to c.normal
template <class T>
[[nodiscard]] inline T gained_by_opening(const JointLawParams& law, const Components<T>& c,
                                         const Remaining<T>& remaining, const PointState<T>& now, const T& moved,
                                         const T& last) {
  if (rises_linearly(law.rise)) {
    const T lost_stiffness = law.stiffness * (1.0 - remaining.normal());
    return -lost_stiffness * c.normal * last;
  }
  const T pressure = -law.stiffness * last;
  return (pressure - now.normal) * moved + pressure * last + 2.0 * now.stored.open;
}

/// Damping of a damaged point's normal opening.
template <class T>
struct Damping {
  T traction;    // Pa
  T dissipated;  // J/m2
};

/// A damaged point is stiffer closed than open by d k, and central differences lose energy, 1/2 d k |delta_n before|
/// |delta_n|, where it closes within a step, and gain as much where it opens; what damage takes on that way they do not
/// feel at all. Both are taken back by a pull whose work over the step is that: nothing is dissipated by it beyond what
/// the law says, but for its work in the step that follows. A viscous traction c k' (delta_n - delta_n before), k' the
/// present normal stiffness, damps what chatters so, and dissipates its trapezoidal work. Neither is there without
/// viscosity. For the parabolic rise the gain is that of its own curve: what is stored now less what was, less the
/// trapezoidal work on the point.
/// @param now  normal traction and stored energy, friction and damping apart
/// @param on  damaged before this evaluation;  @param damaged  after it;  @param loss  J/m2, of normal stiffness, in it
template <class T>
[[nodiscard]] inline Damping<T> damp(const JointLawParams& law, const Components<T>& c, const Remaining<T>& remaining,
                                     const PointState<T>& now, const Mask<T>& on, const Mask<T>& damaged, const T& loss,
                                     Point<T>& h) {
  const T zero = 0.0;
  if (!(law.viscosity > 0)) return {zero, zero};
  const T moved = c.normal - h.normal_opening;
  const Mask<T> is_open = c.normal > zero;
  const T share = select(is_open, remaining.normal(), T(1.0));
  const T viscous = select(on, T(law.viscosity * law.stiffness * share * moved), zero);
  const Mask<T> opens = damaged && is_open && h.normal_opening < zero;
  const T gain = gained_by_opening(law, c, remaining, now, moved, h.normal_opening);
  const T pull = select(opens, T((2.0 * loss + gain) / moved), zero);
  const T work = 0.5 * (h.viscous_traction + viscous) * moved;
  h.viscous_traction = viscous + pull;
  return {h.viscous_traction, select(on, greater(work, zero), zero)};
}

/// Contract: evaluate_point of joint_law.hpp.
/// @param failed  of the joint: its points let go of what they still hold
template <class T>
[[nodiscard]] inline Response<T> evaluate(const JointLawParams& law, const Frame<T>& frame, const Vector<T>& opening,
                                          const Mask<T>& failed, Point<T>& h) {
  const T zero = 0.0;
  const Components<T> c = split(law, frame, opening);
  const Remaining<T> before = remaining_of(law, h);
  const Mask<T> damaged_before = h.damage > zero;
  LossOpenings<T> loss{zero, zero};
  if (law.breakable()) {
    loss = grow(law, c, h);
    let_go(law, failed, h);
  }
  const Remaining<T> remaining = remaining_of(law, h);
  PointState<T> now = state_of(law, c, remaining);
  const Vector<T> elastic_traction = times(T(law.stiffness), opening);
  Response<T> response{
      elastic_traction, zero, zero, zero, zero, now.stored, Mask<T>(rises_linearly(law.rise)) && h.damage == 0.0};
  const Mask<T> damaged = !response.elastic;
  if (any(damaged)) {
    Vector<T> traction = plus(times(now.normal, frame.normal), times(now.shear_stiffness, c.shear_vector));
    const T normal_loss = component_loss(law, law.onset_normal, before.secant_normal, before.normal(),
                                         remaining.secant_normal, remaining.normal(), loss.normal2);
    T shear_loss = component_loss(law, law.onset_shear, before.secant_shear, before.shear(), remaining.secant_shear,
                                  remaining.shear(), loss.shear2);
    if (law.friction > 0) {
      const T weight = 1.0 - remaining.shear();
      const Mask<T> rubs = damaged && weight > zero;
      const Sliding<T> sliding = slide(law, frame, c, weight, rubs, h, now);
      const Vector<T> rubbed =
          plus(traction, plus(times(now.friction[0], frame.tangent[0]), times(now.friction[1], frame.tangent[1])));
      traction = select3<T>(rubs, rubbed, traction);
      response.friction = sliding.dissipated;
      // What the friction spring takes over of the cohesion's energy is not lost.
      shear_loss =
          greater(T(shear_loss - 0.5 * law.stiffness * (before.shear() - remaining.shear()) * sliding.spring2), zero);
      h.friction_weight = select(damaged, weight, h.friction_weight);
    }
    const Damping<T> damping = damp(law, c, remaining, now, damaged_before, h.damage > zero, normal_loss, h);
    traction = plus(traction, times(damping.traction, frame.normal));
    response.viscous = damping.dissipated;
    response.traction = select3<T>(damaged, traction, elastic_traction);
    response.mode_1 = select(damaged, normal_loss, zero);
    response.mode_2 = select(damaged, shear_loss, zero);
  }
  response.stored = now.stored;
  h.normal_opening = c.normal;
  h.shear_opening = c.shear;
  h.stored = now.stored.all();
  return response;
}

/// The same where the caller knows the point to be elastic and without damage, without a frame: what it remembers of
/// it.
template <class T>
inline void set_elastic(const JointLawParams& law, const Vector<T>& opening, Point<T>& h) {
  h.stored = 0.5 * law.stiffness * dot(opening, opening);
}

}  // namespace breccia::joint_point
