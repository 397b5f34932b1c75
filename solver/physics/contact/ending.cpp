#include "physics/contact/ending.hpp"

#include <algorithm>
#include <cmath>

#include "physics/contact/correction.hpp"

namespace breccia {

namespace {

/// Whether in addition no force of it is to be balanced.
bool is_at_rest(const PairHistory<double>& h) {
  return has_ended(h) && h.gained == 0 && h.friction == Vec3::Zero() && h.spring == Vec3::Zero();
}

}  // namespace

void EndedCouples::end(const TouchingCouple& old, double lost) {
  const PairHistory<double>& last = old.history;
  if (!(last.d > 0) && last.force == Vec3::Zero() && last.gained_before == 0 && last.delayed.age == 0) return;
  const ContactPoint& point = view_.point(old.point);
  const ContactPair<double> pair = view_.pair_of(old.point, old.contactor, last.share);
  const PreparedTetra& tetra = view_.tetra_of(old.contactor);
  const bool crushed = inert(tetra), at_rest = lost == 0 && is_at_rest(last);
  const Vec3 place = view_.place_of(point);
  std::array<double, 4> lambda{};
  Vec3 motion = Vec3::Zero();
  if (!crushed) {
    lambda = barycentric(tetra, place);
    if (!at_rest) motion = view_.relative_motion(point, old.contactor, lambda);
  }
  if (last.friction != Vec3::Zero()) {
    const double released = released_by_friction(motion, pair.spring_stiffness(), last.spring);
    view_.account(point, released, work_.friction_dissipated);
    lost += released;
  }
  // A contactor that was crushed while it was touched gives nothing back.
  if (crushed) return view_.account(point, pair_step::stored_in_overlap(pair, last), work_.dissipated);
  const Escape escape = escape_of(old, pair, lambda, motion);
  const bool is_pushed = view_.rules().opening_push && !escape.is_over;
  if (!is_pushed) {
    view_.account(point, escape.left, work_.dissipated);
    lost += escape.left;
  }
  if (escape.is_over) return;
  TouchingCouple ended{
      old.point, old.contactor, {.share = last.share, .delayed = without_overlap(view_.dt(), last.delayed)}};
  if (view_.rules().remembered_gain) ended.history.gained_before = last.gained_before;
  if (!at_rest) {
    ended.history.gained = last.gained + 0.5 * last.force.dot(motion) - pair_step::stored_energy(pair, last) + lost;
    Vec3 force;
    if (is_pushed && ended.history.gained < 0) {
      force = push(pair, way_out(old, lambda, motion, escape.left > 0), motion, ended.history);
      if (force != Vec3::Zero()) view_.account(point, -ended.history.gained, work_.stored);
    } else {
      force = pull(pair, last, motion, ended.history);
    }
    if (force != Vec3::Zero()) forces_.push_back({old.point, old.contactor, lambda, force});
  }
  keep(ended, escape.overlap, pair, lambda, place);
}

/// What is left of the stored energy where the point has not left through the side that it pressed on: if a crack has
/// opened under it, all; if it has left across an edge, what its force has not returned over half of the last step.
EndedCouples::Escape EndedCouples::escape_of(const TouchingCouple& old, const ContactPair<double>& pair,
                                             const std::array<double, 4>& lambda, const Vec3& motion) const {
  const Index contactor = old.contactor;
  // By the sides of the last step: those of now may be others, where a body rolls and a side has turned away.
  const bool has_sides = view_.has_sides(contactor);
  const auto depth_by_sides = [&] { return overlap_value(view_.shape_of(contactor), lambda, sides_of(old.history)); };
  const double overlap = has_sides ? depth_by_sides() : view_.least_function_of(contactor, lambda).g;
  if (!(overlap > 0)) return {overlap, 0.0, false};
  const PairHistory<double>& last = old.history;
  const double work = has_sides ? 0.5 * (last.force - last.friction).dot(motion) : 0.0;
  return {overlap, std::max(pair_step::stored_in_overlap(pair, last) - work, 0.0), !has_sides};
}

/// Direction in which a point has left: against the gradient of the side that it has come through, or that of its last
/// force. If it moves along neither, as an element may not have the side beside an edge, along the motion across the
/// force.
/// @param across_edge  not through the side that it pressed on
Vec3 EndedCouples::way_out(const TouchingCouple& old, const std::array<double, 4>& lambda, const Vec3& motion,
                           bool across_edge) const {
  const OverlapShape& shape = view_.shape_of(old.contactor);
  const std::size_t least = least_row(shape, lambda);
  const Vec3 outward = -row_gradient(shape, least, view_.tetra_of(old.contactor));
  if (row_value(shape, least, lambda) < 0 && outward.dot(motion) > 0) return outward;
  const Vec3 along = (old.history.force - old.history.friction).normalized();
  if (!across_edge && along.dot(motion) > 0) return along;
  return motion - motion.dot(along) * along;
}

/// Keeps a couple that has ended as long as it exerts a force, or may soon touch again and has something to correct.
void EndedCouples::keep(const TouchingCouple& ended, double overlap, const ContactPair<double>& pair,
                        const std::array<double, 4>& lambda, const Vec3& place) {
  const PairHistory<double>& h = ended.history;
  const double remembered = overlap / kRememberedGap;  // m
  const double least = kLargestWorkError * pair.stiffness() * remembered * remembered;
  const bool is_relevant = std::abs(h.gained_before) > least || h.delayed.age > 0;
  if (h.force != Vec3::Zero() || (is_relevant && is_near(lambda, view_.slot_of(ended.contactor), place)))
    contact_.touching.push_back(ended);
}

/// Whether the point of a couple that has ended may soon touch again. Every search finds those that are so near, so all
/// ranks that evaluate the point's next couple know of this one.
bool EndedCouples::is_near(const std::array<double, 4>& lambda, Index slot, const Vec3& place) const {
  if (!(smallest(lambda) >= -kGap)) return false;
  const std::array<Vec3, 4> corners = load_corners(view_.local(), view_.nodes().position.data(), slot);
  const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3]));
  const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3]));
  return (low - place).cwiseMax(place - high).maxCoeff() <= contact_.near;
}

Vec3 EndedCouples::pull(const ContactPair<double>& pair, const PairHistory<double>& last, const Vec3& motion,
                        PairHistory<double>& h) const {
  const bool pushed = last.d > 0 && last.balance > -1;
  const bool pulls = view_.rules().correction && view_.rules().closing_pull;
  h.force = pulls ? closing_force(h.gained, last.force, motion, pushed, pair.stiffness()) : Vec3(Vec3::Zero());
  return account_force(motion, h);
}

Vec3 EndedCouples::push(const ContactPair<double>& pair, const Vec3& outward, const Vec3& motion,
                        PairHistory<double>& h) const {
  h.force = outward != Vec3::Zero() ? opening_force(-h.gained, Vec3(outward.normalized()), motion, pair.stiffness())
                                    : Vec3(Vec3::Zero());
  return account_force(motion, h);
}

/// Counts half of the work of the force of a couple that has ended; where it has none, the next overlap has the rest.
Vec3 EndedCouples::account_force(const Vec3& motion, PairHistory<double>& h) const {
  h.gained += 0.5 * h.force.dot(motion);
  if (h.force == Vec3::Zero()) {
    if (view_.rules().remembered_gain) h.gained_before += h.gained;
    h.gained = 0;
  }
  return h.force;
}

}  // namespace breccia
