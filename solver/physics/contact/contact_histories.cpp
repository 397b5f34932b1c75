#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/contact/contact_balance.hpp"
#include "physics/contact/contact_field.hpp"
#include "physics/contact/contact_pass.hpp"
#include "physics/contact/friction.hpp"

/// Continues the couples of the last step in those of this one, and ends the others.
namespace breccia::contact_pass {

/// A point that pressed on an element and is now in a joint that opens beside it, in none of its neighbours, keeps its
/// couple: the force would end within a step, and with it the energy that the couple holds. A point that did not press
/// cannot matter to the element before it is inside, unless that takes it over from a neighbour.
void Pass::bridge_gaps(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  forget_before(point);
  const std::size_t inside_one = candidates_.size();
  for (Nearby& here : beside_) {
    const Index contactor = here.couple->contactor;
    bool pressed = false;
    for (std::size_t k = old_; k < old.size() && old[k].point == point; ++k)
      pressed = pressed || (old[k].contactor == contactor && old[k].d > 0);
    if (!pressed) {
      // Nearby a side it may come to lie under it at any time, without coming nearer.
      if (has_sides(params_, contact_, contactor)) continue;
      here.couple->apart_until = contact_.travel + here.safe;
      continue;
    }
    const bool goes_on = std::any_of(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(inside_one),
                                     [&](const Candidate& c) { return are_neighbours(c.contactor, contactor); });
    if (!goes_on) consider(point_at(point), contactor, here.lambda);
  }
  prefer_facing_sides(point_at(point), inside_one);
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.contactor < b.contactor; });
  // One may have replaced two that share the place of the point.
  const auto last = std::unique(candidates_.begin(), candidates_.end(),
                                [](const Candidate& a, const Candidate& b) { return a.contactor == b.contactor; });
  candidates_.erase(last, candidates_.end());
}

/// How the side faces under which the point would lie if the contactor reached so far. @pre it has sides
Facing Pass::side_over(const ContactPoint& point, const Nearby& here) const {
  const Index contactor = here.couple->contactor;
  const OverlapShape& shape = shape_of(contactor);
  const FacingRows most = rows_facing(shape, prepared(contactor), outward_of(point));
  return most.rows != 0 && overlap_value(shape, here.lambda, most.rows) > 0 ? most.facing : Facing::away;
}

/// The nearest neighbour of a candidate with a side that faces the point's face more; null: none.
const Nearby* Pass::facing_more(const ContactPoint& point, Index candidate) const {
  const Nearby* best = nullptr;
  std::optional<Facing> most;
  for (const Nearby& here : beside_) {
    const Index contactor = here.couple->contactor;
    // Most surfaces of debris have no distinguished sides.
    if (!has_sides(params_, contact_, contactor) || !are_neighbours(contactor, candidate)) continue;
    if (!most) most = rows_facing(shape_of(candidate), prepared(candidate), outward_of(point)).facing;
    if (best == nullptr && *most == Facing::well) return nullptr;
    const Facing facing = side_over(point, here);
    const bool nearer = best != nullptr && facing == *most && smallest(here.lambda) > smallest(best->lambda);
    if (!(facing > *most) && !nearer) continue;
    most = facing;
    best = &here;
  }
  return best;
}

/// Just beside an edge a point may be in an element that has only the other side of the edge: the nearest neighbour
/// with a side that faces the point's face more replaces it, as if it extended so far.
/// @param inside  number of candidates that the point is in, which come first
void Pass::prefer_facing_sides(const ContactPoint& point, std::size_t inside) {
  for (std::size_t i = 0; i < inside; ++i) {
    const Nearby* best = facing_more(point, candidates_[i].contactor);
    if (best != nullptr) candidates_[i] = candidate_of(point, best->couple->contactor, best->lambda);
  }
}

void Pass::touch_point(Index point) {
  if (candidates_.size() > 1) drop_ambiguous();
  find_histories(point);
  for (Candidate& candidate : candidates_) act(point, candidate);
  // Couples that have just ended came first.
  auto first = contact_.touching.end();
  while (first != contact_.touching.begin() && std::prev(first)->point == point) --first;
  std::sort(first, contact_.touching.end(),
            [](const TouchingCouple& a, const TouchingCouple& b) { return a.contactor < b.contactor; });
}

/// A point on the border of neighbouring elements is inside all of them (kInside): the first one counts. So it does
/// where they overlap, as a joint between them is pressed together, unless a crack runs there: two fragments each push.
void Pass::drop_ambiguous() {
  const auto is_one = [&](const Candidate& a, const Candidate& b) {
    const bool on_border = smallest(a.lambda) < kInside && smallest(b.lambda) < kInside;
    const bool whole = has_sides(params_, contact_, a.contactor) && has_sides(params_, contact_, b.contactor);
    return (on_border || whole) && are_neighbours(a.contactor, b.contactor);
  };
  std::size_t kept = 1;
  for (std::size_t i = 1; i < candidates_.size(); ++i) {
    const Candidate& here = candidates_[i];
    const bool counted = std::any_of(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(kept),
                                     [&](const Candidate& c) { return is_one(c, here); });
    if (!counted) candidates_[kept++] = Candidate(here);
  }
  candidates_.resize(kept);
}

/// Points come in ascending order: what is left of those before is over.
void Pass::forget_before(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  const GlobalId id = contact_.id(point);
  while (old_ < old.size() && contact_.id(old[old_].point) < id) forget(old[old_++]);
}

void Pass::find_histories(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  forget_before(point);
  const std::size_t first = old_;
  while (old_ < old.size() && old[old_].point == point) ++old_;
  if (old_ > first) take_over(first, old_);
}

/// Old histories [first, last) go to the candidates: the same contactor first, then a neighbour in the same body. Of a
/// couple that has ended, a candidate there gets what is left to put right and the delayed force.
void Pass::take_over(std::size_t first, std::size_t last) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  // The usual case: a point remains in its element.
  if (candidates_.size() == 1 && last == first + 1 && old[first].contactor == candidates_[0].contactor &&
      !has_ended(old[first])) {
    candidates_[0].old = static_cast<std::ptrdiff_t>(first);
    return;
  }
  taken_.assign(last - first, false);
  const auto assign = [&](auto&& belongs) {
    for (Candidate& candidate : candidates_) {
      for (std::size_t k = first; k < last && candidate.old < 0; ++k) {
        if (taken_[k - first] || has_ended(old[k]) || !belongs(old[k].contactor, candidate.contactor)) continue;
        candidate.old = static_cast<std::ptrdiff_t>(k);
        taken_[k - first] = true;
      }
    }
  };
  assign([](Index from, Index to) { return from == to; });
  assign([&](Index from, Index to) { return are_neighbours(from, to); });
  for (std::size_t k = first; k < last; ++k) {
    if (taken_[k - first] || !has_ended(old[k])) continue;
    const auto to = std::find_if(candidates_.begin(), candidates_.end(), [&](const Candidate& c) {
      return c.contactor == old[k].contactor || are_neighbours(old[k].contactor, c.contactor);
    });
    if (to == candidates_.end()) continue;
    to->gained += old[k].gained_before;
    if (old[k].delayed.age > to->delayed.age) to->delayed = old[k].delayed;
    taken_[k - first] = true;
  }
  for (std::size_t k = first; k < last; ++k) {
    if (!taken_[k - first]) forget(old[k]);
  }
}

/// The overlap has ended. The stored energy of the normal law was returned as work, or is lost; the spring is released.
/// @param lost  J, by the normal law
void Pass::forget(const TouchingCouple& old, double lost) {
  if (!(old.d > 0) && old.force == Vec3::Zero() && old.gained_before == 0 && old.delayed.age == 0) return;
  const ContactPoint& point = point_at(old.point);
  const Index slot = slot_of(old.contactor);
  const PreparedTetra tetra = prepare_past_contactor(old.contactor);
  const bool crushed = inert(tetra);
  const Vec3 place = at_point(rule_, point, state_.position.data());
  std::array<double, 4> lambda{};
  Vec3 motion = Vec3::Zero();
  const bool settled = lost == 0 && is_settled(old);
  if (!crushed) {
    lambda = barycentric(tetra, place);
    if (!settled) motion = relative_motion(point, slot, lambda);
  }
  if (old.friction != Vec3::Zero()) {
    const double released = released_by_friction(motion, spring_stiffness(point, old), old.spring);
    account(point, work_.friction_dissipated).add(released);
    lost += released;
  }
  // A contactor that was crushed while it was touched gives nothing back.
  if (crushed) return account(point, work_.dissipated).add(normal_held(point, old));
  // By the sides of the last step: those of now may be others, where a body rolls and a side has turned away.
  const bool has_own_sides = has_sides(params_, contact_, old.contactor);
  const double overlap = has_own_sides
                             ? overlap_value(shape_of(old.contactor), lambda, one_step_ago(point, old.contactor).rows)
                         : is_growing(old.contactor) ? overlap_value(shape_of(old.contactor), lambda)
                                                     : least_function_of(old.contactor, lambda).g;
  // The point has not left through the side that it pressed on. If a crack has opened under it, the stored energy is
  // dissipated; if the point left across an edge, the same less the work of its force over half of the last step.
  if (overlap > 0) {
    const double work = has_own_sides ? 0.5 * (old.force - old.friction).dot(motion) : 0.0;
    const double gone = std::max(normal_held(point, old) - work, 0.0);
    account(point, work_.dissipated).add(gone);
    if (!has_own_sides) return;
    lost += gone;
  }
  TouchingCouple ended{
      .point = old.point, .contactor = old.contactor, .delayed = old.delayed, .gained_before = old.gained_before};
  forget_normal_force(dt_, ended.delayed);
  if (!settled) {
    ended.gained = old.gained + 0.5 * old.force.dot(motion) - held(point, old) + lost;
    end(point, old, motion, lambda, ended);
  }
  const double remembered = overlap / kRememberedGap;  // m
  const double least = kLargestWorkError * stiffness(point, ended) * remembered * remembered;
  const bool matters = std::abs(ended.gained_before) > least || ended.delayed.age > 0;
  if (ended.force != Vec3::Zero() || (matters && is_near(lambda, slot, place))) contact_.touching.push_back(ended);
}

/// Whether the point of a couple that has ended may soon touch again. Every search finds those that are so near, so all
/// ranks that evaluate the point's next couple know of this one.
bool Pass::is_near(const std::array<double, 4>& lambda, Index slot, const Vec3& place) const {
  if (!(smallest(lambda) >= -kGap)) return false;
  const std::array<Vec3, 4> corners = load_corners(local_, state_.position.data(), slot);
  const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3]));
  const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3]));
  return (low - place).cwiseMax(place - high).maxCoeff() <= contact_.near;
}

/// The couple exerts no force by its law any more. @param h  read and written: force, gained, gained_before
void Pass::end(const ContactPoint& point, const TouchingCouple& last, const Vec3& motion,
               const std::array<double, 4>& lambda, TouchingCouple& h) {
  const bool pushed = last.d > 0 && last.balance > -1;
  h.force = closing_force(h.gained, last.force, motion, pushed, stiffness(point, h));
  h.gained += 0.5 * h.force.dot(motion);
  distribute(point, h.contactor, lambda, h.force);
  if (h.force != Vec3::Zero()) return;
  h.gained_before += h.gained;
  h.gained = 0;
}

/// Whether no side of the surface faces the face of the point, for example at the front of a block, where a point of
/// the floor enters an element above the lower edge. A force there would stop the block, which slides over the point.
/// No force starts either if the nearest facing surface is deeper than kFarSide: on the lower side of a stone of an
/// arch, from the upper side of the next. Without motion the positions are initial ones.
/// @param offset  m, of the couple, which exerts no force
bool Pass::comes_from_beside(const ContactPoint& point, Candidate& candidate, double offset) const {
  if (motion_of(point, candidate) == Vec3::Zero()) return false;
  const OverlapShape& shape = shape_of(candidate.contactor, Instant::step_before);
  const std::size_t least = least_row(shape, candidate.lambda, candidate.rows);
  if (facing(outward_of(point), side_gradient(shape, least, prepared(candidate.contactor))) == Facing::away)
    return true;
  const std::array<double, 4>& depth = shape.row[least];
  const double g = row_value(shape, least, candidate.lambda);
  const bool is_far = g > kFarSide * *std::max_element(depth.begin(), depth.end());
  return is_far && offset > 0.5 * g && overlap_value(shape, candidate.lambda) < 0.5 * g;
}

/// Overlap that makes no force, m, of a couple seen for the first time.
double Pass::first_offset(Index point, Candidate& candidate) const {
  const ContactCouple couple{point, candidate.contactor};
  const auto& fresh = contact_.fresh;
  const bool is_fresh = !fresh.empty() && std::binary_search(fresh.begin(), fresh.end(), couple,
                                                             [&](const ContactCouple& a, const ContactCouple& b) {
                                                               return contact_.before(a, b);
                                                             });
  const Index slot = slot_of(candidate.contactor);
  if (is_fresh || share_vertex(local_, point_at(point).slot, slot)) return std::max(candidate.g_before, 0.0);
  // A point that comes through a gap between elements, such as an open joint, is deep inside at once: deeper than it
  // moved inwards.
  const Vec3& motion = motion_of(point_at(point), candidate);
  if (motion == Vec3::Zero()) {
    // Initial positions: for bodies on top of each other, a point at an edge is far behind the side that faces it.
    const double depth = overlap_value(shape_of(candidate.contactor), candidate.lambda);
    return depth > kOverlapTolerance * length_of(slot) ? 0.0 : std::max(candidate.g_before, 0.0);
  }
  const Vec3 gradient = gradient_before(candidate);
  return std::max(candidate.g_before - std::max(gradient.dot(motion), 0.0) - kSameSlope * motion.norm(), 0.0);
}

}  // namespace breccia::contact_pass
