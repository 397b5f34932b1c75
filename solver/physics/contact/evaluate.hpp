#pragma once

#include "physics/contact/correction.hpp"
#include "physics/contact/history.hpp"
#include "physics/contact/law/coulomb.hpp"
#include "physics/contact/law/lag.hpp"
#include "physics/contact/law/normal.hpp"
#include "physics/lanes.hpp"

// The step of one couple in contact: for T = double and for several couples side by side, lane by lane with the same
// bits. No branch on rules: which element holds the point, which side of the surface counts and which history continues
// has been decided (resolve.hpp). Functions are templates over T, so that none is compiled for a plain number in a unit
// of a wider instruction set (reason: sweep_kernel.hpp).

namespace breccia {

/// Change of overlap over motion that is put down to the deformation and rotation of an element in one step.
inline constexpr double kSameSlope = 1e-3;

/// Those of ContactRules that are evaluated side by side.
struct EvaluationRules {
  bool correction = true, steep_correction = true, friction_age = true, second_stage = true, spring_turns = true;
};

/// A couple in contact, over the number type.
template <class T>
struct ContactPair {
  using Vector = VectorOf<T>;
  ContactLawOf<T> law;
  T weight, length;                       ///< m2 of the point; m, H of the contactor's body
  T overlap = 0.0, overlap_before = 0.0;  ///< m, g by the field of now and of one step ago
  Vector motion{0.0, 0.0, 0.0};           ///< m, of the point relative to the contactor's material in the last step
  Vector gradient{0.0, 0.0, 0.0};         ///< -, of the overlap, inwards
  T turn = 0.0;                           ///< m, gradient times motion less the change of the overlap
  T longest_delay = 0.0;                  ///< s, of friction
  Vector rotation{0.0, 0.0, 0.0};         ///< rad, of the two elements in the mean
  T continues = 0.0;                      ///< 1: it touched one step ago, 0: not
  T stored_by_old_law = 0.0;              ///< J, energy by its former law less that by the present one
  T damping_before = 0.0;                 ///< J, twice the work of the damping force of one step ago over the motion
  int whole_exponent = 0;                 ///< of the law, if it is whole and the same for all of them, else 0
  EvaluationRules rules{};

  /// N/m, along the normal.
  [[nodiscard]] T stiffness() const { return weight * law.penalty / length; }
  /// N/m, across it.
  [[nodiscard]] T spring_stiffness() const { return law.tangential_ratio * stiffness(); }
};

/// J, of one couple in one step.
template <class T>
struct PairEnergies {
  T stored = 0.0, stored_in_spring = 0.0;    ///< now
  T lost = 0.0, damped = 0.0, rubbed = 0.0;  ///< dissipated by the normal law, by damping, by friction
};

namespace pair_step {

using elasticity::greater;
using elasticity::lesser;
using elasticity::select;
using lanes::any;
using lanes::Mask;

template <class M, class Vector>
[[nodiscard]] inline Vector select_vector(const M& mask, const Vector& a, const Vector& b) {
  return {select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])};
}
template <class Vector>
[[nodiscard]] inline auto any_component(const Vector& v) {
  return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0;
}

/// J, of the normal law; and of the spring as well.
template <class T>
[[nodiscard]] inline T stored_in_overlap(const ContactPair<T>& pair, const PairHistory<T>& h) {
  return pair.weight * pair.length * normal_law::stored(pair.law, h.d, h.d_max, pair.whole_exponent);
}
template <class T>
[[nodiscard]] inline T stored_energy(const ContactPair<T>& pair, const PairHistory<T>& h) {
  return stored_in_overlap(pair, h) + 0.5 * pair.spring_stiffness() * h.spring.squaredNorm();
}

/// The overlap becomes g. @return  J/(m2 m) dissipated
template <class T>
[[nodiscard]] inline T go_to(const ContactPair<T>& pair, const T& g, PairHistory<T>& h) {
  h.offset = lesser(h.offset, greater(g, T(0.0)));
  const T d = greater(T(0.0), T(g - h.offset)) / pair.length;
  const T d_max = normal_law::largest(d, h.d_max);
  const T lost = normal_law::dissipated(pair.law, d_max) - normal_law::dissipated(pair.law, h.d_max);
  h.d = d;
  h.d_max = d_max;
  return greater(T(0.0), lost);
}

/// The law follows the motion (field at rest), then the field (points at rest), so that the energy each of them moves
/// is known separately. @return  J dissipated
template <class T>
[[nodiscard]] inline T follow(const ContactPair<T>& pair, PairHistory<T>& h) {
  const T scale = pair.weight * pair.length;
  const T lost = scale * go_to(pair, pair.overlap_before, h);
  const auto grows = pair.overlap != pair.overlap_before;
  if (!any(grows)) return lost;
  // The offset follows the change of the field: a rise adds no force, a fall reduces the force once the offset is 0.
  PairHistory<T> grown = h;
  const T stored = normal_law::stored(pair.law, h.d, h.d_max, pair.whole_exponent);
  grown.offset = greater(T(0.0), T(h.offset + (pair.overlap - pair.overlap_before)));
  static_cast<void>(go_to(pair, pair.overlap, grown));
  grown.d = lesser(grown.d, h.d);  // it rises by round-off only
  const T released =
      scale * greater(T(0.0), T(stored - normal_law::stored(pair.law, grown.d, grown.d_max, pair.whole_exponent)));
  h.offset = select(grows, grown.offset, h.offset);
  h.d = select(grows, grown.d, h.d);
  h.d_max = select(grows, grown.d_max, h.d_max);
  return select(grows, T(lost + released), lost);
}

/// Normal force over the slope of the overlap with damping, N. Its work is that of the mean of this and the last force
/// over the motion, each along the gradient that it had. Where the motion turns round there is none.
/// @param elastic  N, without;  @param damped  J, out
template <class T>
[[nodiscard]] inline T damp(const ContactPair<T>& pair, double dt, const PairHistory<T>& h, const T& elastic,
                            T& damped) {
  damped = 0.0;
  const auto damps = pair.law.damping > 0.0 && h.d > 0.0 && T(dt) > 0.0 && any_component(pair.gradient);
  if (!any(damps)) return elastic;
  const T deeper = pair.gradient.dot(pair.motion) - pair.turn;  // m, during the last step
  const T pressure = pair.weight * normal_law::damped(pair.law, T(elastic / pair.weight), T(deeper / dt));
  damped = select(damps, greater(T(0.0), T(0.5 * (pair.damping_before + (pressure - elastic) * deeper))), T(0.0));
  return select(damps, pressure, elastic);
}

/// Adds the force of friction to that along the normal. @param normal  N, over the slope
/// @param acts  couples that exert a force now or did so one step ago;  @param e  energies, out
template <class T>
inline void rub(const ContactPair<T>& pair, double dt, const T& normal, const Mask<T>& acts, PairHistory<T>& h,
                PairEnergies<T>& e) {
  using Vector = VectorOf<T>;
  const T slope = pair.gradient.norm();
  const auto rubs = acts && pair.law.friction > 0.0 && pair.law.tangential_ratio > 0.0 && slope > 0.0;
  if (!any(rubs)) return;
  const T k = pair.spring_stiffness();
  const Vector outward = -pair.gradient / slope;
  Vector spring = h.spring;
  turn_spring(outward, outward.dot(pair.rotation), spring);
  spring = select_vector(any_component(h.spring), spring, h.spring);
  const auto presses = h.d > 0.0;
  DelayedForceOf<T> delayed = h.delayed;
  if (!pair.rules.friction_age) delayed.age = kSteadyAge * pair.longest_delay;
  follow_normal_force(normal * slope, dt, pair.longest_delay, delayed, pair.rules.second_stage);
  const T limit = select(presses, T(pair.law.friction * delayed.force), T(0.0));
  const FrictionStep<Vector> friction = friction_step(outward, pair.motion, k, limit, spring);
  h.delayed = select_delayed(rubs && presses, delayed, h.delayed);
  h.spring = select_vector(rubs, spring, h.spring);
  h.friction = select_vector(rubs, friction.force, h.friction);
  h.force = select_vector(rubs, Vector(h.force + friction.force), h.force);
  e.stored_in_spring = select(rubs, T(0.5 * k * spring.squaredNorm()), T(0.0));
  e.rubbed = select(rubs, friction.dissipated, T(0.0));
}

/// Changes the normal force by what makes its work equal to what the laws store and dissipate (correction.hpp).
/// @param stored  J, by the normal law;  @param counts  couples whose work is known
/// @param h  force by its laws and what it has gained with it; changed
template <class T>
inline void correct(const ContactPair<T>& pair, const T& stored, const Mask<T>& counts, PairHistory<T>& h) {
  using Vector = VectorOf<T>;
  const Vector normal = h.force - h.friction;
  const T work = normal.dot(pair.motion), size = normal.norm();
  const auto works = counts && work != 0.0 && size > kNoForce;
  if (!any(works)) return;
  const T out = work / size, k = pair.stiffness();
  // In the next step, with the motion of this one.
  const auto leaves = out > h.d * pair.length;
  const T gained = h.gained + select(leaves, T(0.5 * work - stored), T(0.0));
  const auto is_steep = pair.law.exponent > 1.0 && work > 0.0;
  BalancingLimitsOf<T> limits = balancing_limits(work, k, out);
  if (pair.rules.steep_correction && any(is_steep))
    limits = select_limits(is_steep, steep_limits(work, k, pair.law.exponent, out), limits);
  const BalancingSharesOf<T> shares = balancing_shares(gained, h.gained_before, work, limits);
  const T balance = shares.own + shares.before;
  h.balance = select(works, balance, h.balance);
  h.gained_before = select(works, T(h.gained_before + shares.before * work), h.gained_before);
  // The next step counts the other halves.
  h.gained = select(works, T(h.gained + 0.5 * (shares.own - shares.before) * work), h.gained);
  h.force = select_vector(works, Vector(h.force + balance * normal), h.force);
}

}  // namespace pair_step

/// One step of a couple: overlap -> normal force -> damping -> friction -> correction.
/// @param h  one step ago, its offset that of now; out: now. Without force where overlap and last force are none.
template <class T>
[[nodiscard]] inline PairEnergies<T> evaluate(const ContactPair<T>& pair, double dt, PairHistory<T>& h) {
  using namespace pair_step;
  using Vector = VectorOf<T>;
  const Vector none{T(0.0), T(0.0), T(0.0)};
  const PairHistory<T> last = h;
  PairEnergies<T> e;
  e.lost = follow(pair, h);
  const auto presses = h.d > 0.0;
  h.delayed = select_delayed(presses, h.delayed, without_overlap(dt, h.delayed));
  h.balance = 0.0;
  h.force = h.friction = none;
  // Freshly broken surfaces are full of couples that lie together without force: nothing more to do for those.
  const auto acts = presses || any_component(last.force);
  if (!any(acts)) return e;
  const T stress = normal_law::stress(pair.law, h.d, h.d_max, pair.whole_exponent);
  e.stored = pair.weight * pair.length * normal_law::stored_under(pair.law, h.d, stress);
  const T pressure = damp(pair, dt, h, T(pair.weight * stress), e.damped);
  h.force = select_vector(acts, Vector(-pressure * pair.gradient), none);
  rub(pair, dt, pressure, acts, h, e);
  // What a couple holds that was there before anything moved has been put in.
  const auto counts = acts && (pair.continues > 0.0 || any_component(pair.motion));
  const T kept = e.stored + e.damped + (e.stored_in_spring + e.rubbed) + 0.5 * pressure * pair.turn;
  const T before = select(pair.continues > 0.0, T(stored_energy(pair, last) + pair.stored_by_old_law), T(0.0));
  const T gain = 0.5 * (last.force + h.force).dot(pair.motion) + kept - before + e.lost;
  h.gained = select(counts, T(h.gained + gain), h.gained);
  if (pair.rules.correction) correct(pair, e.stored, counts, h);
  return e;
}

}  // namespace breccia
