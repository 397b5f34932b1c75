#include "physics/contact/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <tuple>

#include "base/error.hpp"
#include "physics/contact/contact_balance.hpp"
#include "physics/contact/contact_field.hpp"
#include "physics/contact/contact_pass.hpp"
#include "physics/contact/friction.hpp"
#include "physics/contact/spherical_boundary.hpp"

namespace breccia {

namespace contact_pass {

namespace {

/// Couples that are located before the first of their points is evaluated: few, so that they remain in the cache.
constexpr std::size_t kMostLocated = 64;

}  // namespace

void Pass::run() {
  advance_field(contact_);
  contact_.touching_before.swap(contact_.touching);
  contact_.touching.clear();
  work_.stored = work_.friction_stored = ExactSum{};
  work_.touching = 0;
  spherical_boundary(params_, local_, state_, dt_, contact_, forces_, work_.stored);
  ++contact_.calls;
  contact_.prepared.resize(contact_.in_couples.size());
  contact_.prepared_in.resize(contact_.in_couples.size(), 0);
  contact_.turns.resize(static_cast<std::size_t>(local_.num_slots));

  ContactCouple* first = contact_.couples.data();
  for (PointCouples& point : contact_.by_point) {
    const std::span<ContactCouple> couples{first, static_cast<std::size_t>(point.count)};
    if (!(contact_.travel < point.apart_until)) look_at(point, couples);
    if (located_.size() >= kMostLocated) evaluate_located();
    first += point.count;
  }
  evaluate_located();
  for (; old_ < contact_.touching_before.size(); ++old_) forget(contact_.touching_before[old_]);
  press_waiting();
  contact_.fresh.clear();
}

/// Finds the contactors that a point is in, and the forces between them. @param end  of its couples
void Pass::evaluate_point(const LocatedPoint& located_point, std::size_t end) {
  const Index point = located_point.point->point;
  candidates_.clear();
  inside_.clear();
  beside_.clear();
  for (std::size_t k = located_point.first; k < end; ++k) {
    const Located& located = located_[k];
    switch (located.where) {
      case Whereabouts::inside:
        inside_.push_back({located.couple, located.lambda, located.safe});
        break;
      case Whereabouts::beside:
        beside_.push_back({located.couple, located.lambda, located.safe});
        break;
      case Whereabouts::outside:
        located.couple->apart_until = contact_.travel + located.safe;
        break;
      case Whereabouts::nowhere:
        break;
    }
  }
  if (!press_aside(point)) {
    for (const Nearby& here : inside_) consider(point_at(point), here.couple->contactor, here.lambda);
    if (!beside_.empty()) bridge_gaps(point);
    if (!candidates_.empty()) touch_point(point);
  }
  double& apart_until = located_point.point->apart_until;
  apart_until = std::numeric_limits<double>::infinity();
  for (const ContactCouple& couple : located_point.couples) apart_until = std::min(apart_until, couple.apart_until);
}

PreparedTetra Pass::prepare_element(Index slot) const {
  return prepare(load_corners(local_, state_.position.data(), slot), local_.volume[static_cast<std::size_t>(slot)]);
}

/// Prepares the contactor if it is not prepared yet in this step.
const PreparedTetra& Pass::prepare_contactor(Index contactor) {
  const auto place = static_cast<std::size_t>(contact_.place[static_cast<std::size_t>(contactor)]);
  if (contact_.prepared_in[place] != contact_.calls) {
    contact_.prepared_in[place] = contact_.calls;
    contact_.prepared[place] = prepare_element(slot_of(contactor));
  }
  return contact_.prepared[place];
}

/// Of a contactor that may have left all couples with a search in this step.
PreparedTetra Pass::prepare_past_contactor(Index contactor) {
  const bool in_couples = contact_.place[static_cast<std::size_t>(contactor)] >= 0;
  return in_couples ? prepare_contactor(contactor) : prepare_element(slot_of(contactor));
}

const OverlapShape& Pass::shape_of(Index contactor, Instant instant) const {
  if (!is_growing(contactor)) instant = Instant::now;
  if (contactor != shape_of_ || instant != shape_at_) {
    shape_ = overlap_shape(params_, local_, contact_, contactor, instant);
    shape_of_ = contactor;
    shape_at_ = instant;
  }
  return shape_;
}

OverlapFunction Pass::least_function_of(Index contactor, const std::array<double, 4>& lambda) const {
  const auto at = static_cast<std::size_t>(contactor);
  if (params_.field == OverlapField::body) return least_function(contact_.height[at], contact_.field[at], lambda);
  const OverlapShape& shape = shape_of(contactor);
  const std::size_t row = least_row(shape, lambda);
  return {row_value(shape, row, lambda), shape.row[row]};
}

Candidate Pass::candidate_of(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda) const {
  const OverlapShape& shape = shape_of(contactor);
  const OverlapRows rows = rows_of(point, contactor, shape, prepared(contactor));
  const Overlap here = overlap(shape, prepared(contactor), lambda, rows);
  Candidate candidate{contactor, lambda, rows, here.g, here.gradient, here.g};
  if (is_growing(contactor))
    candidate.g_before = overlap_value(shape_of(contactor, Instant::step_before), lambda, rows);
  return candidate;
}

void Pass::consider(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda) {
  const Candidate candidate = candidate_of(point, contactor, lambda);
  if (candidate.g > 0 || candidate.g_before > 0) candidates_.push_back(candidate);
}

/// Motion of the point relative to the contactor's material at lambda during the last step, m.
Vec3 Pass::relative_motion(const ContactPoint& point, Index slot, const std::array<double, 4>& lambda) const {
  const double* v = state_.velocity.data();
  Vec3 relative = at_point(rule_, point, v);
  for (int a = 0; a < 4; ++a)
    relative -= lambda[static_cast<std::size_t>(a)] * load_node(v, local_.corner_node(slot, a));
  return dt_ * relative;
}

const Vec3& Pass::motion_of(const ContactPoint& point, Candidate& candidate) const {
  if (!candidate.motion) candidate.motion = relative_motion(point, slot_of(candidate.contactor), candidate.lambda);
  return *candidate.motion;
}

/// Of an element's velocities, 1/s; 0 of an inert one. An element is in many couples: once a step.
const Vec3& Pass::curl_of(Index slot) {
  ElementTurn& turn = contact_.turns[static_cast<std::size_t>(slot)];
  if (turn.in == contact_.calls) return turn.curl;
  turn = {Vec3::Zero(), contact_.calls};
  const Index contactor = contact_.contactor_of_slot[static_cast<std::size_t>(slot)];
  const PreparedTetra tetra = contactor >= 0 ? prepare_past_contactor(contactor) : prepare_element(slot);
  if (inert(tetra)) return turn.curl;
  const std::array<Vec3, 4> v = load_corners(local_, state_.velocity.data(), slot);
  for (std::size_t c = 1; c < 4; ++c) {
    const std::array<double, 3>& row = tetra.gradient[c - 1];
    turn.curl += Vec3(row[0], row[1], row[2]).cross(v[c] - v[0]);
  }
  return turn.curl;
}

/// Rotation of the two elements of a couple in the mean during the last step, rad: half the curl of their motions.
Vec3 Pass::mean_turn(Index target, Index contactor) {
  return 0.25 * dt_ * (curl_of(target) + curl_of(slot_of(contactor)));
}

/// The overlap becomes g. @return  J dissipated
double Pass::go_to(const ContactLaw& law, double scale, double length, double g, TouchingCouple& h) {
  h.offset = std::min(h.offset, std::max(g, 0.0));
  const double d = std::max(0.0, g - h.offset) / length;
  const double d_max = normal_law::largest(d, h.d_max);
  const double lost = std::max(0.0, normal_law::dissipated(law, d_max) - normal_law::dissipated(law, h.d_max));
  h.d = d;
  h.d_max = d_max;
  return scale * lost;
}

/// The law follows the motion (field at rest), then the field (points at rest), so that the energy each of them moves
/// is known apart. @return  J dissipated
double Pass::follow(const ContactLaw& law, double scale, double length, const Candidate& candidate, TouchingCouple& h) {
  const double lost = go_to(law, scale, length, candidate.g_before, h);
  if (candidate.g == candidate.g_before) return lost;
  // The offset follows the change of the field: a rise adds no force, a fall reduces the force once the offset is 0.
  const double stored = normal_law::stored(law, h.d, h.d_max);
  h.offset = std::max(0.0, h.offset + (candidate.g - candidate.g_before));
  std::ignore = go_to(law, scale, length, candidate.g, h);
  // d does not rise here: the difference is negative by round-off only.
  return lost + scale * std::max(0.0, stored - normal_law::stored(law, h.d, h.d_max));
}

Vec3 Pass::gradient_before(const Candidate& candidate) const {
  if (!is_growing(candidate.contactor)) return candidate.gradient;
  const OverlapShape& shape = shape_of(candidate.contactor, Instant::step_before);
  return overlap(shape, prepared(candidate.contactor), candidate.lambda, candidate.rows).gradient;
}

/// A contactor, the place of a point in it and what counts for it one step ago, by the field of then.
Pass::Before Pass::one_step_ago(const ContactPoint& point, Index contactor) const {
  const Index slot = slot_of(contactor);
  const double *x = state_.position.data(), *v = state_.velocity.data();
  std::array<Vec3, 4> corners = load_corners(local_, x, slot);
  const std::array<Vec3, 4> velocity = load_corners(local_, v, slot);
  for (std::size_t a = 0; a < 4; ++a) corners[a] -= dt_ * velocity[a];
  const PreparedTetra tetra = prepare(corners, local_.volume[static_cast<std::size_t>(slot)]);
  const OverlapShape& shape = shape_of(contactor, Instant::step_before);
  return {tetra, barycentric(tetra, at_point(rule_, point, x) - dt_ * at_point(rule_, point, v)),
          inert(tetra) ? kAllRows : rows_of(point, contactor, shape, tetra, dt_)};
}

/// The overlap is the least of several functions, and of other ones in the next element: where the point has passed
/// from one to another, the mean of the two gradients times the motion is what the forces do work for. The offset takes
/// up what the overlap has changed by beyond that, as far as the turn of the gradient explains it; the rest is a change
/// of field, not of place. Along one and the same function of an element there is nothing to take up: however fast that
/// turns, the law has a potential, and the errors of single steps cancel. Without motion the places have been given,
/// not moved to.
/// @param h  of the last step; changed: offset, and of the candidate g_before and turn
void Pass::keep_step(const ContactPoint& point, double length, TouchingCouple& h, Candidate& candidate) const {
  const Vec3& motion = motion_of(point, candidate);
  if (motion == Vec3::Zero()) {
    // A neighbour that now has the point beside an edge continues with the same force.
    if (h.contactor != candidate.contactor) h.offset = candidate.g_before - h.d * length;
    return;
  }
  const Vec3 gradient = gradient_before(candidate);
  const double change = candidate.g_before - (h.d * length + h.offset), along = gradient.dot(motion);
  // A couple that has ended may come back from outside, where its place was not kept.
  const bool was_kept = h.d > 0 || h.offset != 0;
  if (was_kept) candidate.turn = along - change;
  if (std::abs(change - along) <= kSameSlope * motion.norm()) return;
  const Before last = one_step_ago(point, h.contactor);
  double along_before = 0;
  if (!inert(last.tetra)) {
    const OverlapShape& shape = shape_of(h.contactor, Instant::step_before);
    const bool same = h.contactor == candidate.contactor &&
                      least_row(shape, last.lambda, last.rows) == least_row(shape, candidate.lambda, candidate.rows);
    if (was_kept && same) return;
    along_before = overlap(shape, last.tetra, last.lambda, last.rows).gradient.dot(motion);
  }
  candidate.turn = 0;
  if (!(h.d > 0)) {  // as a new couple: no force has done work for more than the motion inwards
    h.offset = std::max(candidate.g_before - std::max(along, 0.0), 0.0);
    return;
  }
  const double beyond = change - 0.5 * (along + along_before), most = 0.5 * std::abs(along - along_before);
  const double turned = std::clamp(beyond, -most, most);
  h.offset += turned;
  candidate.g_before -= beyond - turned;
}

void Pass::act(Index index, Candidate& candidate) { touch(index, candidate, contact_.touching.emplace_back()); }

/// @param h  of contact_.touching, the last one where the overlap ends; out
void Pass::touch(Index index, Candidate& candidate, TouchingCouple& h) {
  const ContactPoint& point = point_at(index);
  const Index slot = slot_of(candidate.contactor);
  const ContactLaw& law = law_of(index, candidate.contactor);
  const double length = length_of(slot);
  if (candidate.old >= 0) {
    h = contact_.touching_before[static_cast<std::size_t>(candidate.old)];
    // Where the overlap stays below the offset there is no force before or after.
    if (h.d > 0 || candidate.g_before > h.offset) keep_step(point, length, h, candidate);
  } else {
    h = {.point = index, .contactor = candidate.contactor, .offset = first_offset(index, candidate)};
    h.delayed = candidate.delayed;
  }
  h.gained_before += candidate.gained;
  if (!(h.d > 0) && candidate.g_before > h.offset && comes_from_beside(point, candidate, h.offset))
    h.offset = candidate.g_before;
  const TouchingCouple last = h;
  h.point = index;
  h.contactor = candidate.contactor;
  h.force = h.friction = Vec3::Zero();
  h.balance = 0;
  const double lost = follow(law, point.weight * length, length, candidate, h);
  account(point, work_.dissipated).add(lost);
  if (!(h.d > 0)) forget_normal_force(dt_, h.delayed);
  if (!(candidate.g > 0)) {
    contact_.touching.pop_back();
    forget(last, lost);  // by the law and on the contactor that it had
  } else if (h.d > 0 || last.force != Vec3::Zero()) {
    // Freshly broken surfaces are full of couples that lie together without force: nothing more to do for those.
    const Vec3& motion = motion_of(point, candidate);
    const double before = candidate.old >= 0 ? held(point, last) : 0.0;
    const double kept = press(law, point, length, motion, candidate, h);
    // What a couple holds that was there before anything moved has been put in.
    if (candidate.old >= 0 || motion != Vec3::Zero()) {
      h.gained += 0.5 * (last.force + h.force).dot(motion) + kept - before + lost;
      balance(law, point, length, motion, h);
    }
    distribute(point, candidate.contactor, candidate.lambda, h.force);
    if (h.force == Vec3::Zero()) end(point, last, motion, candidate.lambda, h);
  }
}

/// @return  J that the couple holds and that friction and damping have dissipated, less the work of this step's force
/// that comes from the rotation of its direction: no gain, since the law has a potential and such work cancels
double Pass::press(const ContactLaw& law, const ContactPoint& point, double length, const Vec3& motion,
                   const Candidate& candidate, TouchingCouple& h) {
  const Vec3& gradient = candidate.gradient;
  const double stress = normal_law::stress(law, h.d, h.d_max);
  Damping normal{point.weight * stress, 0.0};
  if (law.damping > 0 && h.d > 0 && dt_ > 0 && gradient != Vec3::Zero())
    normal = damp(law, point, motion, candidate, normal.pressure);
  account(point, work_.dissipated).add(normal.dissipated);
  h.force = -normal.pressure * gradient;
  const double stored = point.weight * length * normal_law::stored_under(law, h.d, stress);
  double kept = stored + normal.dissipated;
  const double slope = gradient.norm();
  if (law.friction > 0 && law.tangential_ratio > 0 && slope > 0) {
    const double k = law.tangential_ratio * stiffness(law, point, length);
    const Vec3 outward = -gradient / slope;
    if (h.spring != Vec3::Zero())
      turn_spring(outward, outward.dot(mean_turn(point.slot, candidate.contactor)), h.spring);
    if (h.d > 0) follow_normal_force(normal.pressure * slope, dt_, longest_delay(law, h), h.delayed);
    const double limit = h.d > 0 ? law.friction * h.delayed.force : 0.0;
    const FrictionStep<Vec3> friction = friction_step(outward, motion, k, limit, h.spring);
    const double spring = 0.5 * k * h.spring.squaredNorm();
    account(point, work_.friction_dissipated).add(friction.dissipated);
    account(point, work_.friction_stored).add(spring);
    h.friction = friction.force;
    h.force += friction.force;
    kept += spring + friction.dissipated;
  }
  account(point, work_.stored).add(stored);
  kept += 0.5 * normal.pressure * candidate.turn;
  if (h.d > 0 && local_.is_original(point.slot)) ++work_.touching;
  return kept;
}

/// @param h  force by its law and what it has gained with it; changed
void Pass::balance(const ContactLaw& law, const ContactPoint& point, double length, const Vec3& motion,
                   TouchingCouple& h) const {
  const Vec3 normal = h.force - h.friction;
  const double work = normal.dot(motion);
  if (work == 0 || !(normal.norm() > kNoForce)) return;
  const double out = work / normal.norm(), k = stiffness(law, point, length);
  const bool leaves = out > h.d * length;  // in the next step, with the motion of this one
  const double gained = h.gained + (leaves ? 0.5 * work - normal_held(point, h) : 0.0);
  const BalancingLimits limits =
      law.exponent > 1 && work > 0 ? steep_limits(work, k, law.exponent, out) : balancing_limits(work, k, out);
  const BalancingShares shares = balancing_shares(gained, h.gained_before, work, limits);
  h.balance = shares.own + shares.before;
  h.gained_before += shares.before * work;
  h.gained += 0.5 * (shares.own - shares.before) * work;  // the next step counts the other halves
  h.force += h.balance * normal;
}

/// Its work is that of the mean of this and the last force over the motion, each along the gradient that it had: where
/// the point has passed an edge of the overlap they point elsewhere. Where the motion turns round there is none.
Damping Pass::damp(const ContactLaw& law, const ContactPoint& point, const Vec3& motion, const Candidate& candidate,
                   double elastic) const {
  const Vec3& gradient = candidate.gradient;
  const double deeper = gradient.dot(motion) - candidate.turn;  // m, during the last step
  const double pressure = point.weight * normal_law::damped(law, elastic / point.weight, deeper / dt_);
  double work_before = 0;
  if (candidate.old >= 0) {
    const TouchingCouple& old = contact_.touching_before[static_cast<std::size_t>(candidate.old)];
    const double share = std::abs(1 + old.balance);
    if (old.d > 0 && share > 0) {
      const Before then = one_step_ago(point, old.contactor);
      const OverlapShape& shape = shape_of(old.contactor, Instant::step_before);
      const Vec3 last = inert(then.tetra) ? gradient : overlap(shape, then.tetra, then.lambda, then.rows).gradient;
      const double before = (old.force - old.friction).norm() / (share * last.norm()) -
                            point.weight * normal_law::stress(law, old.d, old.d_max);
      work_before = before * (candidate.turn == 0 ? last.dot(motion) : deeper);
    }
  }
  return {pressure, std::max(0.0, 0.5 * (work_before + (pressure - elastic) * deeper))};
}

void Pass::distribute(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda,
                      const Vec3& force) {
  if (force == Vec3::Zero()) return;
  if (filled_ > 0) {
    waiting_.push_back({&point, contactor, lambda, force});
  } else {
    add_force(point, contactor, lambda, force);
  }
}

void Pass::add_force(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda,
                     const Vec3& force) {
  const std::array<double, 3>& shape = rule_.shape[static_cast<std::size_t>(point.k)];
  const std::array<double*, 3> target = forces_.places(point.nodes);
  for (std::size_t i = 0; i < 3; ++i) NodalForces::add(target[i], shape[i], force);
  const Index slot = slot_of(contactor);
  const std::array<double*, 4> corners =
      slot < local_.num_own_slots
          ? forces_.own_places(own_corner_node(slot, 0))
          : forces_.places(local_.shared_corners[static_cast<std::size_t>(slot - local_.num_own_slots)]);
  for (std::size_t a = 0; a < 4; ++a) NodalForces::add(corners[a], -lambda[a], force);
}

}  // namespace contact_pass

namespace {

ContactKernels kernels_for(Simd simd) {
  DEMAND(simd_available(simd), std::string(name_of(simd)));
  switch (simd) {
    case Simd::avx512:
      return contact_kernels_avx512();
    case Simd::avx2:
      return contact_kernels_avx2();
    case Simd::sse2:
      break;
  }
  return contact_kernels_sse2();
}

}  // namespace

void contact_forces(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                    ContactState& contact, NodalForces& forces, ContactWork& work, Simd simd, bool side_by_side) {
  ContactKernels kernels = kernels_for(simd);
  if (!side_by_side) kernels.press = nullptr;
  contact_pass::Pass(params, local, state, dt, contact, forces, work, kernels).run();
}

}  // namespace breccia
