#pragma once

// The joint law of physics/joint_law.hpp at a point, over the number type (joint_lanes.hpp).

#include "physics/joint_growth.hpp"
#include "physics/work_error.hpp"

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

/// One component: traction over opening, Pa/m, and stored energy, J/m2.
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
  T along_slip;  // m2, the spring times the slip, both afterwards
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
  const T along_slip = select(on, T(spring[0] * h.slip[0] + spring[1] * h.slip[1]), zero);
  return {select(slid, T(law.stiffness * mean * (length - limit)), zero), spring2, along_slip};
}

/// Energy that the shear stiffness k of the cohesion loses with a share dK of itself, J/m2. The slipping share keeps
/// the energy of its spring; as delta_s = slip + spring, the rest is
///   1/2 k dK (delta_s^2 - spring^2) = dK (1/2 k slip^2 + k spring . slip).
/// The second term is what friction would have dissipated had this share slipped from the beginning; the first alone
/// adds up to G_II under any pressure. Source: [Palmer and Rice 1973]
template <class T>
struct ShearLoss {
  T cohesion, friction;
};

/// @param lost  dK;  @param loss  J/m2, 1/2 k dK delta_s^2
template <class T>
[[nodiscard]] inline ShearLoss<T> split_shear_loss(const JointLawParams& law, const Components<T>& c,
                                                   const Sliding<T>& sliding, const T& lost, const T& loss) {
  const T zero = 0.0;
  const T net = greater(T(loss - 0.5 * law.stiffness * lost * sliding.spring2), zero);
  const T beyond = c.shear2 - sliding.spring2, along = greater(T(2.0 * sliding.along_slip), zero);
  const T friction = select(beyond > along, T(net * (along / beyond)), select(along > zero, net, zero));
  return {net - friction, friction};
}

/// Normal traction, Pa, and what it holds, J/m2, at an opening.
template <class T>
struct NormalState {
  T traction, stored;
};

template <class T>
[[nodiscard]] inline NormalState<T> normal_state(const JointLawParams& law, const Remaining<T>& remaining,
                                                 const T& opening) {
  const T zero = 0.0;
  const Mask<T> is_open = opening > zero;
  const T open = greater(opening, zero), pressed = law.stiffness * opening;
  const ComponentState<T> held =
      component_state(law, law.onset_normal, remaining.z, remaining.secant_normal, open, T(open * open));
  return {select(is_open, T(held.stiffness * open), pressed), select(is_open, held.stored, T(0.5 * pressed * opening))};
}

/// A damaged point is stiffer closed than open by d k, and central differences lose 1/2 d k |delta_n before| |delta_n|
/// where it closes within a step, and gain as much where it opens; of what damage takes on the way they feel what a
/// straight line between both tractions takes. Nor is what the viscous traction gives back, where the motion turns
/// round, less dissipated. Each point counts what it has gained so, and a traction takes it or gives it back, half in
/// this step and half in the next one, taken to move as this one; what it does instead is counted again. It is no
/// larger than such a step can leave over, as in contact/correction.hpp. A point that chatters, to and fro from
/// step to step, is given nothing, and all is taken at once: of a force that acts over a way and back nothing is left.
/// @param last, now  at the last evaluation with the damage of then; at this one
/// @param on       damaged before this evaluation;  @param damaged  after it
/// @param loss     J/m2, of normal stiffness, in this evaluation
/// @param before   Pa, viscous traction of the last evaluation
/// @param viscous  J/m2, work of the viscous traction in this one
template <class T>
inline void balance(const JointLawParams& law, const Components<T>& c, const NormalState<T>& last,
                    const NormalState<T>& now, const Mask<T>& on, const Mask<T>& damaged, const T& loss,
                    const T& before, const T& viscous, Point<T>& h) {
  const T zero = 0.0;
  const T moved = c.normal - h.normal_opening;
  // What an elastic point remembers of its opening is of an evaluation long ago, but for one under pressure.
  const Mask<T> known = on || (damaged && c.normal > zero && h.normal_opening < zero);
  const T work = 0.5 * (last.traction + now.traction) * moved;
  const T error = select(known, T(loss + now.stored - last.stored - work), zero);
  const T gained = h.gained + error - lesser(viscous, zero) - 0.5 * h.balance * moved;
  const Mask<T> goes_on = h.viscous_traction * before > zero;
  const T most = kLargestWorkError * law.stiffness * moved * moved;
  const Mask<T> gives = goes_on && gained < -kNegligibleWorkError * most && gained >= -most;
  const Mask<T> takes = most > zero && gained > kNegligibleWorkError * most;
  const T part = select(goes_on, T(1.0), T(2.0));
  h.balance = select(damaged && (gives || takes), T(part * lesser(gained, most) / moved), zero);
  h.gained = select(damaged, T(gained - 0.5 * h.balance * moved), zero);
}

/// A damaged point's viscous traction c k' (delta_n - delta_n before), k' the present normal stiffness: damps what
/// chatters between open and closed.
/// @param on  damaged before this evaluation
/// @return    J/m2, its work as central differences do it; below 0 where the motion turns round
template <class T>
[[nodiscard]] inline T damp(const JointLawParams& law, const Components<T>& c, const Remaining<T>& remaining,
                            const Mask<T>& on, Point<T>& h) {
  const T zero = 0.0;
  const T moved = c.normal - h.normal_opening;
  const T share = select(c.normal > zero, remaining.normal(), T(1.0));
  const T viscous = select(on, T(law.viscosity * law.stiffness * share * moved), zero);
  const T work = 0.5 * (h.viscous_traction + viscous) * moved;
  h.viscous_traction = viscous;
  return select(on, work, zero);
}

/// Contract: evaluate_point of joint_law.hpp.
/// @param failed  of the joint: its points lose their remaining cohesion
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
      const ShearLoss<T> part = split_shear_loss(law, c, sliding, T(before.shear() - remaining.shear()), shear_loss);
      response.friction = sliding.dissipated + select(damaged, part.friction, zero);
      shear_loss = part.cohesion;
      h.friction_weight = select(damaged, weight, h.friction_weight);
    }
    if (law.viscosity > 0) {
      const T viscous_traction = h.viscous_traction, viscous = damp(law, c, remaining, damaged_before, h);
      const NormalState<T> last = normal_state(law, before, h.normal_opening);
      const NormalState<T> held{now.normal, now.stored.open + now.stored.pressed};
      balance(law, c, last, held, damaged_before, h.damage > zero, normal_loss, viscous_traction, viscous, h);
      response.viscous = greater(viscous, zero);
      traction = plus(traction, times(T(h.viscous_traction + h.balance), frame.normal));
    }
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
