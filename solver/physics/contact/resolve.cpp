#include "physics/contact/resolve.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {

std::span<Candidate> Resolver::candidates(Index point, std::span<const Nearby> inside, std::span<Nearby> beside) {
  candidates_.clear();
  end_before(point);
  for (const Nearby& here : inside) consider(view_.point(point), here.couple->contactor, here.lambda);
  if (!beside.empty()) bridge_gaps(point, beside);
  if (candidates_.size() > 1 && view_.rules().one_of_neighbours) drop_ambiguous();
  if (!candidates_.empty()) find_histories(point);
  return candidates_;
}

void Resolver::finish() {
  for (; old_ < contact_.touching_before.size(); ++old_) ended_.end(contact_.touching_before[old_]);
}

Candidate Resolver::candidate_of(const ContactPoint& point, Index contactor,
                                 const std::array<double, 4>& lambda) const {
  if (!view_.is_changed(contactor) && !view_.has_several_sides(contactor)) {
    const OverlapFunction least = view_.least_function_of(contactor, lambda);
    return {contactor, lambda, kAllRows, least.row, least.g, least.g};
  }
  const OverlapRows rows = sides_for(point, contactor);
  const OverlapShape& shape = view_.shape_of(contactor);
  const std::size_t least = least_row(shape, lambda, rows);
  const double g = row_value(shape, least, lambda);
  Candidate candidate{contactor, lambda, rows, shape.row[least], g, g};
  if (view_.is_changed(contactor))
    candidate.g_before = overlap_value(view_.shape_of(contactor, Instant::step_before), lambda, rows);
  return candidate;
}

/// The functions of a contactor that count for a point: as long as it presses those that counted before, so that no
/// side comes or goes while bodies turn, otherwise those whose sides face the point.
OverlapRows Resolver::sides_for(const ContactPoint& point, Index contactor) const {
  if (!view_.has_several_sides(contactor)) return kAllRows;
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  for (std::size_t k = old_; k < old.size() && contact_.id(old[k].point) == point.id; ++k) {
    if (old[k].history.d > 0 && old[k].contactor == contactor) return sides_of(old[k].history);
  }
  return rows_for(view_.shape_of(contactor), view_.tetra_of(contactor), view_.outward_of(point));
}

/// Adds the contactor to the candidates of a point if its overlap is positive now or was so before the field changed.
void Resolver::consider(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda) {
  const Candidate candidate = candidate_of(point, contactor, lambda);
  if (candidate.g > 0 || candidate.g_before > 0) candidates_.push_back(candidate);
}

/// A point that pressed on an element and is now in a joint that opens beside it, in none of its neighbours, keeps its
/// couple: the force would end within a step, and with it the energy that the couple holds. A point that did not press
/// cannot matter to the element before it is inside.
void Resolver::bridge_gaps(Index point, std::span<Nearby> beside) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  const std::size_t inside = candidates_.size();
  for (const Nearby& here : beside) {
    const Index contactor = here.couple->contactor;
    bool pressed = false;
    for (std::size_t k = old_; k < old.size() && old[k].point == point; ++k)
      pressed = pressed || (old[k].contactor == contactor && old[k].history.d > 0);
    if (!pressed) {
      here.couple->apart_until = contact_.travel + here.safe;
      continue;
    }
    const bool continues =
        std::any_of(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(inside),
                    [&](const Candidate& c) { return view_.are_neighbours(c.contactor, contactor); });
    if (!continues && view_.rules().bridge_gaps) consider(view_.point(point), contactor, here.lambda);
  }
  if (candidates_.size() == inside) return;
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.contactor < b.contactor; });
}

/// A point on the border of neighbouring elements is inside all of them (kInside): the first one counts. So it does
/// where they overlap, as a joint between them is pressed together, unless a crack runs there: two fragments each push.
void Resolver::drop_ambiguous() {
  const auto is_one = [&](const Candidate& a, const Candidate& b) {
    const bool on_border = smallest(a.lambda) < kInside && smallest(b.lambda) < kInside;
    const bool whole = view_.has_sides(a.contactor) && view_.has_sides(b.contactor);
    return (on_border || whole) && view_.are_neighbours(a.contactor, b.contactor);
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
void Resolver::end_before(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  const GlobalId id = contact_.id(point);
  while (old_ < old.size() && contact_.id(old[old_].point) < id) ended_.end(old[old_++]);
}

void Resolver::find_histories(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  const std::size_t first = old_;
  while (old_ < old.size() && old[old_].point == point) ++old_;
  if (old_ > first) continue_histories(first, old_);
}

/// Old histories [first, last) go to the candidates: the same contactor first, then a neighbour in the same body. Of a
/// couple that has ended, a candidate there gets what is left to correct and the delayed force.
void Resolver::continue_histories(std::size_t first, std::size_t last) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  // The usual case: a point remains in its element.
  if (candidates_.size() == 1 && last == first + 1 && old[first].contactor == candidates_[0].contactor &&
      !has_ended(old[first].history)) {
    candidates_[0].old = static_cast<std::ptrdiff_t>(first);
    return;
  }
  continued_.assign(last - first, false);
  const auto assign = [&](auto&& belongs) {
    for (Candidate& candidate : candidates_) {
      for (std::size_t k = first; k < last && candidate.old < 0; ++k) {
        const bool is_free = !continued_[k - first] && !has_ended(old[k].history);
        if (!is_free || !belongs(old[k].contactor, candidate.contactor)) continue;
        candidate.old = static_cast<std::ptrdiff_t>(k);
        continued_[k - first] = true;
      }
    }
  };
  assign([](Index from, Index to) { return from == to; });
  assign([&](Index from, Index to) { return view_.are_neighbours(from, to); });
  for (std::size_t k = first; k < last; ++k) {
    if (continued_[k - first] || !has_ended(old[k].history)) continue;
    const auto to = std::find_if(candidates_.begin(), candidates_.end(), [&](const Candidate& c) {
      return c.contactor == old[k].contactor || view_.are_neighbours(old[k].contactor, c.contactor);
    });
    if (to == candidates_.end()) continue;
    to->gained += old[k].history.gained_before;
    if (old[k].history.delayed.age > to->delayed.age) to->delayed = old[k].history.delayed;
    continued_[k - first] = true;
  }
  for (std::size_t k = first; k < last; ++k) {
    if (!continued_[k - first]) ended_.end(old[k]);
  }
}

Adjusted Resolver::adjust(Index point, const Candidate& candidate, const PairHistory<double>& h, const Vec3& motion,
                          const Vec3& gradient) const {
  Adjusted now{h.offset, candidate.g_before};
  if (candidate.old < 0) {
    now.offset = first_offset(point, candidate, motion, gradient);
  } else if (h.d > 0 || now.overlap_before > h.offset) {
    // Where the overlap stays below the offset there is no force before or after.
    const TouchingCouple& old = contact_.touching_before[at(candidate.old)];
    switch_gradient(view_.point(point), candidate, old, motion, gradient, now);
  }
  if (view_.rules().facing_face && !(h.d > 0) && now.overlap_before > now.offset &&
      comes_from_beside(view_.point(point), candidate, motion))
    now.offset = now.overlap_before;
  return now;
}

Vec3 Resolver::gradient_before(const Candidate& candidate, const Vec3& gradient) const {
  if (!view_.is_changed(candidate.contactor)) return gradient;
  const OverlapShape& shape = view_.shape_of(candidate.contactor, Instant::step_before);
  return overlap(shape, view_.tetra_of(candidate.contactor), candidate.lambda, candidate.rows).gradient;
}

/// The overlap is the least of several functions, and of other ones in the next element: where the point has passed
/// from one to another, the mean of the two gradients times the motion is what the forces do work for. The offset takes
/// up what the overlap has changed by beyond that, as far as the turn of the gradient explains it; the rest is a change
/// of field, not of place. Along one and the same function of an element there is nothing to take up: however fast that
/// turns, the law has a potential, and the errors of single steps cancel. Without motion the places have been given,
/// not moved to.
/// @param now  read and written
void Resolver::switch_gradient(const ContactPoint& point, const Candidate& candidate, const TouchingCouple& old,
                               const Vec3& motion, const Vec3& gradient, Adjusted& now) const {
  const PairHistory<double>& h = old.history;
  const double deep = h.d * view_.length_of(candidate.contactor);
  if (motion == Vec3::Zero()) {
    // Another side counts, or a neighbour has the point: the force remains, none begins.
    if (old.contactor != candidate.contactor || !(h.d > 0)) now.offset = now.overlap_before - deep;
    return;
  }
  const double change = now.overlap_before - (deep + h.offset);
  const double along = gradient_before(candidate, gradient).dot(motion);
  // A couple that has ended may come back from outside, where its place was not kept.
  const bool was_kept = h.d > 0 || h.offset != 0;
  if (was_kept) now.turn = along - change;
  if (std::abs(change - along) <= kSameSlope * motion.norm() || !view_.rules().gradient_switch) return;
  const ContactView::Before last = view_.one_step_ago(point, old.contactor);
  double along_before = 0;
  if (!inert(last.tetra)) {
    const OverlapShape& shape = view_.shape_of(old.contactor, Instant::step_before);
    const bool same = old.contactor == candidate.contactor &&
                      least_row(shape, last.lambda, sides_of(h)) == least_row(shape, candidate.lambda, candidate.rows);
    if (was_kept && same) return;
    along_before = overlap(shape, last.tetra, last.lambda, sides_of(h)).gradient.dot(motion);
  }
  now.turn = 0;
  if (!(h.d > 0)) {  // as a new couple: no force has done work for more than the motion inwards
    now.offset = std::max(now.overlap_before - std::max(along, 0.0), 0.0);
    return;
  }
  const double beyond = change - 0.5 * (along + along_before), most = 0.5 * std::abs(along - along_before);
  const double turned = std::clamp(beyond, -most, most);
  now.offset += turned;
  now.overlap_before -= beyond - turned;
}

/// Whether the side that counts does not face the face of the point: at the front of a block, where a point of the
/// floor enters an element above the lower edge, a force would stop the block, which slides over the point; for a point
/// at the lower end of the front the points of the faces below press. Of initial positions this is not known.
bool Resolver::comes_from_beside(const ContactPoint& point, const Candidate& candidate, const Vec3& motion) const {
  if (candidate.old < 0 && motion == Vec3::Zero()) return false;
  const OverlapShape& shape = view_.shape_of(candidate.contactor, Instant::step_before);
  const std::size_t least = least_row(shape, candidate.lambda, candidate.rows);
  const Vec3 inward = row_gradient(shape, least, view_.tetra_of(candidate.contactor));
  return facing(view_.outward_of(point).face, inward) == Facing::away;
}

bool Resolver::is_fresh(const ContactCouple& couple) const {
  const auto& fresh = contact_.fresh;
  return std::binary_search(fresh.begin(), fresh.end(), couple,
                            [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); });
}

/// Overlap that makes no force, m, of a couple seen for the first time.
double Resolver::first_offset(Index point, const Candidate& candidate, const Vec3& motion, const Vec3& gradient) const {
  const Index contactor = candidate.contactor;
  if (is_fresh({point, contactor}) || view_.shares_vertex(point, contactor)) return std::max(candidate.g_before, 0.0);
  // A point that comes through a gap between elements, such as an open joint, is deep inside at once: deeper than it
  // moved inwards.
  if (motion == Vec3::Zero()) {
    // Initial positions: for bodies on top of each other, a point at an edge is far behind the side that faces it.
    const double depth = overlap_value(view_.shape_of(contactor), candidate.lambda);
    return depth > kOverlapTolerance * view_.length_of(contactor) ? 0.0 : std::max(candidate.g_before, 0.0);
  }
  if (!view_.rules().first_offset) return 0.0;
  const double inwards = std::max(gradient_before(candidate, gradient).dot(motion), 0.0);
  return std::max(candidate.g_before - inwards - kSameSlope * motion.norm(), 0.0);
}

}  // namespace breccia
