#include "physics/contact/queue.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {

namespace {

constexpr Index kRemoved = -1;

Vec3 vector_of(const ContactRow (&rows)[3], std::size_t lane) { return {rows[0][lane], rows[1][lane], rows[2][lane]}; }

}  // namespace

void PairQueue::push(Index point, std::span<const Candidate> candidates) {
  if (candidates.empty()) return;
  std::vector<TouchingCouple>& touching = contact_.touching;
  for (const Candidate& candidate : candidates) touching.push_back({point, candidate.contactor, {}});
  if (candidates.size() == 1 && (touching.size() == 1 || touching[touching.size() - 2].point != point))
    return push(point, candidates.front(), touching.size() - 1);
  // What is left of couples of the point that have just ended came first.
  std::size_t first = touching.size();
  while (first > 0 && touching[first - 1].point == point) --first;
  sort_by_contactor(std::span(touching).subspan(first));
  for (const Candidate& candidate : candidates) {
    std::size_t place = first;
    while (touching[place].contactor != candidate.contactor) ++place;
    push(point, candidate, place);
  }
}

void PairQueue::push(Index point, const Candidate& candidate, std::size_t place) {
  const std::size_t lane = filled_++;
  lanes_[lane] = {point, place, candidate, 0.0, nullptr};
  fill_place(view_.point(point), candidate, lane);
  const auto put_number = [lane](const PairNumber&, const double& x, ContactRow& row) { row[lane] = x; };
  if (candidate.old >= 0) {
    for_each_pair_number(put_number, contact_.touching_before[at(candidate.old)].history, block_.history);
  } else {
    const PairHistory<double> fresh{.delayed = candidate.delayed};
    for_each_pair_number(put_number, fresh, block_.history);
  }
  block_.history.gained_before[lane] += candidate.gained;
  block_.history.sides[lane] = candidate.rows;
  fill_laws(point, candidate, lane);
  if (filled_ == lanes_.size()) evaluate();
}

void PairQueue::push_forces_of_ended() {
  for (const KnownForce& known : ended_.forces()) {
    if (filled_ == 0)
      add_force(known);
    else
      waiting_.push_back({filled_, known});
  }
  ended_.clear();
}

void PairQueue::finish() {
  if (filled_ > 0) evaluate();
  sort_disordered();
}

PairHistory<double> PairQueue::history_before(const Candidate& candidate) const {
  if (candidate.old >= 0) return contact_.touching_before[at(candidate.old)].history;
  return {.delayed = candidate.delayed};
}

void PairQueue::add_force(const KnownForce& known) {
  view_.add_force(view_.point(known.point), known.contactor, known.lambda, known.force);
}

void PairQueue::fill_place(const ContactPoint& point, const Candidate& candidate, std::size_t lane) {
  const std::array<double, 3>& shape = view_.shape_at(point);
  const StepElement& target = view_.moving_element(point.slot);
  for (std::size_t i = 0; i < 3; ++i) {
    block_.shape[i][lane] = shape[i];
    block_.velocity[i][lane] = target.velocity[kFaceCorners[at(point.face)][i]];
  }
  block_.target[lane] = &target;
  block_.contactor[lane] = &view_.moving_element(view_.slot_of(candidate.contactor));
  for (std::size_t a = 0; a < 4; ++a) {
    block_.lambda[a][lane] = candidate.lambda[a];
    block_.depth[a][lane] = candidate.depth[a];
  }
  block_.overlap[lane] = candidate.g;
  block_.overlap_before[lane] = candidate.g_before;
}

void PairQueue::fill_laws(Index index, const Candidate& candidate, std::size_t lane) {
  const ContactPoint& point = view_.point(index);
  const Index contactor = candidate.contactor;
  const ContactLaw& law = view_.law_of(index, contactor);
  lanes_[lane].law = &law;
  double& share = block_.history.share[lane];
  if (!(block_.history.d[lane] > 0)) share = view_.share_of(index, contactor, candidate.lambda);
  block_.weight[lane] = share * point.weight;
  block_.length[lane] = view_.length_of(contactor);
  block_.longest_delay[lane] = view_.rules().friction_lag_stages > 0 ? view_.longest_delay(law, index, contactor) : 0.0;
  block_.continues[lane] = candidate.old >= 0 ? 1 : 0;
  block_.stored_by_old_law[lane] = block_.damping_before[lane] = 0;
  if (candidate.old < 0) return;
  const TouchingCouple& old = contact_.touching_before[at(candidate.old)];
  const PairHistory<double>& h = old.history;
  if (old.contactor == contactor || &view_.law_of(index, old.contactor) == &law) return;
  block_.stored_by_old_law[lane] = pair_step::stored_energy(view_.pair_of(index, old.contactor, h.share), h) -
                                   pair_step::stored_energy(view_.pair_of(index, contactor, h.share), h);
}

/// Makes the block whole: what is computed of empty lanes is discarded.
void PairQueue::fill_empty_lanes() {
  for (std::size_t lane = filled_; lane < lanes_.size(); ++lane) {
    block_.target[lane] = block_.target[0];
    block_.contactor[lane] = block_.contactor[0];
    for (auto& node : block_.velocity) node[lane] = node[0];
  }
  block_.common_law = lanes_[0].law;
  for (std::size_t lane = 1; lane < filled_; ++lane) {
    if (lanes_[lane].law != lanes_[0].law) block_.common_law = nullptr;
  }
  for (std::size_t lane = 0; block_.common_law == nullptr && lane < filled_; ++lane)
    for_each_law_number([lane](const double& x, ContactRow& row) { row[lane] = x; }, *lanes_[lane].law, block_.law);
}

/// Evaluates the block, and adds all forces in the order in which they came.
void PairQueue::evaluate() {
  fill_empty_lanes();
  kernels_.move(view_.dt(), block_);
  for (std::size_t lane = 0; lane < filled_; ++lane) {
    adjust(lane);
    lanes_[lane].offset = block_.history.offset[lane];
  }
  kernels_.evaluate(view_.dt(), rules_, block_);
  auto next = waiting_.begin();
  for (std::size_t lane = 0; lane < filled_; ++lane) {
    for (; next != waiting_.end() && next->before == lane; ++next) add_force(next->known);
    take_results(lane);
  }
  for (; next != waiting_.end(); ++next) add_force(next->known);
  waiting_.clear();
  filled_ = 0;
}

/// Applies the rules to a couple, but to those that continue under the same function of the overlap, nearly all of
/// debris at rest.
void PairQueue::adjust(std::size_t lane) {
  const auto& [index, place, candidate, offset, law] = lanes_[lane];
  const bool presses = candidate.old >= 0 && block_.history.d[lane] > 0;
  if (!presses || block_.same_slope[lane] == 0 || view_.is_changed(candidate.contactor)) {
    const Adjusted now = resolver_.adjust(index, candidate, history_before(candidate), vector_of(block_.motion, lane),
                                          vector_of(block_.gradient, lane));
    block_.history.offset[lane] = now.offset;
    block_.overlap_before[lane] = now.overlap_before;
    block_.turn[lane] = now.turn;
  }
  if (law->damping > 0) block_.damping_before[lane] = damping_before(lane);
}

/// J, twice the work of the damping force of one step ago over the motion, along the gradient that it had.
double PairQueue::damping_before(std::size_t lane) const {
  const auto& [index, place, candidate, offset, law] = lanes_[lane];
  if (candidate.old < 0) return 0;
  const TouchingCouple& old = contact_.touching_before[at(candidate.old)];
  const PairHistory<double>& h = old.history;
  const double factor = std::abs(1 + h.balance), turn = block_.turn[lane];
  if (!(h.d > 0) || !(factor > 0)) return 0;
  const ContactPoint& point = view_.point(index);
  const Vec3 motion = vector_of(block_.motion, lane), gradient = vector_of(block_.gradient, lane);
  const ContactView::Before then = view_.one_step_ago(point, old.contactor);
  const OverlapShape& shape = view_.shape_of(old.contactor, Instant::step_before);
  const Vec3 last = inert(then.tetra) ? gradient : overlap(shape, then.tetra, then.lambda, sides_of(h)).gradient;
  const double elastic = h.share * point.weight * normal_law::stress(*law, h.d, h.d_max);
  const double before = (h.force - h.friction).norm() / (factor * last.norm()) - elastic;
  return before * (turn == 0 ? last.dot(motion) : gradient.dot(motion) - turn);
}

/// Takes a couple out of the block, accounts its energies and adds its force.
void PairQueue::take_results(std::size_t lane) {
  const auto& [index, place, candidate, offset, law] = lanes_[lane];
  const ContactPoint& point = view_.point(index);
  view_.account(point, block_.lost[lane], work_.dissipated);
  if (!(candidate.g > 0)) return end_inside(lane);
  view_.account(point, block_.damped[lane], work_.dissipated);
  view_.account(point, block_.rubbed[lane], work_.friction_dissipated);
  view_.account(point, block_.stored_in_spring[lane], work_.friction_stored);
  view_.account(point, block_.stored[lane], work_.stored);
  PairHistory<double>& h = contact_.touching[place].history;
  for_each_pair_number([lane](const PairNumber&, double& x, const ContactRow& row) { x = row[lane]; }, h,
                       block_.history);
  if (h.d > 0 && view_.local().is_original(point.slot)) ++work_.touching;
  Vec3 force = h.force;
  if (force == Vec3::Zero()) {
    const PairHistory<double> last = history_before(candidate);
    if (!(h.d > 0) && last.force == Vec3::Zero()) return;
    force = ended_.pull(view_.pair_of(index, candidate.contactor, h.share), last, vector_of(block_.motion, lane), h);
    if (force == Vec3::Zero()) return;
  }
  view_.add_force(point, candidate.contactor, candidate.lambda, force);
}

/// The overlap has ended although the point is in the contactor: its field has changed. The couple ends by the law and
/// on the contactor that it had.
void PairQueue::end_inside(std::size_t lane) {
  const auto& [index, place, candidate, offset, law] = lanes_[lane];
  TouchingCouple last{index, candidate.contactor, history_before(candidate)};
  if (candidate.old >= 0) last.contactor = contact_.touching_before[at(candidate.old)].contactor;
  last.history.gained_before += candidate.gained;
  last.history.offset = offset;
  std::vector<TouchingCouple>& touching = contact_.touching;
  const std::size_t before = touching.size();
  ended_.end(last, block_.lost[lane]);
  if (touching.size() > before) {
    touching[place] = touching.back();
    touching.pop_back();
  } else {
    touching[place].contactor = kRemoved;
  }
  disordered_.push_back(place);
  for (const KnownForce& known : ended_.forces()) add_force(known);
  ended_.clear();
}

/// Brings the couples of each point into their order again after some have ended within their contactors.
void PairQueue::sort_disordered() {
  if (disordered_.empty()) return;
  std::vector<TouchingCouple>& touching = contact_.touching;
  for (const std::size_t place : disordered_) {
    const Index point = touching[place].point;
    std::size_t first = place, end = place;
    while (first > 0 && touching[first - 1].point == point) --first;
    while (end < touching.size() && touching[end].point == point) ++end;
    sort_by_contactor(std::span(touching).subspan(first, end - first));
  }
  std::erase_if(touching, [](const TouchingCouple& couple) { return couple.contactor == kRemoved; });
}

}  // namespace breccia
