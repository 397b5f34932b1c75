#include <algorithm>

#include "physics/contact/contact_field.hpp"
#include "physics/contact/contact_pass.hpp"

/// Couples in continued contact, nearly all of those of debris at rest, are evaluated side by side (contact_block.hpp).
namespace breccia::contact_pass {

namespace {

/// Forces that wait for a block to be full: few, so that what they act on is still at hand.
constexpr std::size_t kMostWaiting = 64;

void put(const Vec3& value, std::size_t lane, ContactRow (&rows)[3]) {
  for (std::size_t axis = 0; axis < 3; ++axis) rows[axis][lane] = value[static_cast<Eigen::Index>(axis)];
}

Vec3 take(const ContactRow (&rows)[3], std::size_t lane) { return {rows[0][lane], rows[1][lane], rows[2][lane]}; }

}  // namespace

/// Locates a point in its contactors.
void Pass::look_at(PointCouples& point, std::span<ContactCouple> couples) {
  const Vec3 x = at_point(rule_, point_at(point.point), state_.position.data());
  points_.push_back({&point, couples, located_.size()});
  for (ContactCouple& couple : couples) {
    if (contact_.travel < couple.apart_until) continue;
    const std::size_t lane = located_.size() % kLanes;
    Located& located = located_.emplace_back();
    located.couple = &couple;
    locate_block_.tetra[lane] = &prepare_contactor(couple.contactor);
    put(x, lane, locate_block_.x);
    if (lane + 1 == kLanes) locate(located_.size() - kLanes);
  }
}

/// Evaluates the block. @param first  of its couples
void Pass::locate(std::size_t first) {
  const std::size_t count = located_.size() - first;
  for (std::size_t lane = count; lane < kLanes; ++lane) locate_block_.tetra[lane] = locate_block_.tetra[0];
  kernels_.locate(locate_block_);
  for (std::size_t lane = 0; lane < count; ++lane) {
    Located& located = located_[first + lane];
    for (std::size_t a = 0; a < 4; ++a) located.lambda[a] = locate_block_.lambda[a][lane];
    located.safe = locate_block_.safe[lane];
    located.where = locate_block_.where[lane];
  }
}

/// Evaluates the located points.
void Pass::evaluate_located() {
  if (const std::size_t rest = located_.size() % kLanes; rest > 0) locate(located_.size() - rest);
  for (std::size_t i = 0; i < points_.size(); ++i)
    evaluate_point(points_[i], i + 1 < points_.size() ? points_[i + 1].first : located_.size());
  points_.clear();
  located_.clear();
}

/// Whether the point may be one for the block: in one contactor, whose field is at rest and beside which no side could
/// take it over, by a law with friction and without damping.
bool Pass::is_ordinary(const ContactLaw& law, Index contactor) const {
  if (law.damping > 0 || !(law.friction > 0) || !(law.tangential_ratio > 0) || is_growing(contactor)) return false;
  return std::none_of(beside_.begin(), beside_.end(),
                      [&](const Nearby& here) { return has_sides(params_, contact_, here.couple->contactor); });
}

/// Of a point that pressed on this contactor in the last step and on nothing else; null: it did not.
const TouchingCouple* Pass::only_history(Index point, Index contactor) {
  forget_before(point);
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  if (old_ == old.size() || old[old_].point != point) return nullptr;
  if (old[old_].contactor != contactor || !(old[old_].d > 0)) return nullptr;
  const bool alone = old_ + 1 == old.size() || old[old_ + 1].point != point;
  return alone ? &old[old_] : nullptr;
}

/// Puts the point's couple into the block if it is one for it. @return  whether nothing is left to do for the point
bool Pass::press_aside(Index index) {
  if (kernels_.press == nullptr || inside_.size() != 1) return false;
  const Index contactor = inside_[0].couple->contactor;
  const std::array<double, 4>& lambda = inside_[0].lambda;
  const ContactLaw& law = law_of(index, contactor);
  if (!is_ordinary(law, contactor) || has_several_sides(params_, contact_, contactor)) return false;
  const TouchingCouple* old = only_history(index, contactor);
  if (old == nullptr) return false;
  const OverlapFunction least = least_function_of(contactor, lambda);
  if (!(least.g > 0)) return false;
  const ContactPoint& point = point_at(index);
  const double length = length_of(slot_of(contactor));
  TouchingCouple& h = contact_.touching.emplace_back(*old);
  const double lost = go_to(law, point.weight * length, length, least.g, h);
  if (!(h.d > 0)) {
    contact_.touching.pop_back();
    return false;
  }
  pass_over_beside();
  place_lane(point, contactor, lambda, least.row);
  fill_lane(law, length, *old, h, least.g, lost);
  lanes_[filled_] = {index, contact_.touching.size() - 1, static_cast<std::ptrdiff_t>(old_++)};
  waiting_.push_back({&point, contactor, lambda, Vec3::Zero(), static_cast<std::ptrdiff_t>(filled_++)});
  if (filled_ == lanes_.size() || waiting_.size() >= kMostWaiting) press_waiting();
  return true;
}

/// As bridge_gaps() does of contactors without sides on which the point did not press.
void Pass::pass_over_beside() {
  for (const Nearby& here : beside_) here.couple->apart_until = contact_.travel + here.safe;
}

/// Where the next couple of the block is. @param depth  m, coefficients of the overlap function
void Pass::place_lane(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda,
                      const std::array<double, 4>& depth) {
  const std::size_t lane = filled_;
  const std::array<double, 3>& shape = rule_.shape[static_cast<std::size_t>(point.k)];
  const PreparedTetra& tetra = prepared(contactor);
  for (std::size_t i = 0; i < 3; ++i) {
    block_.node[i][lane] = point.nodes[i];
    block_.shape[i][lane] = shape[i];
    for (std::size_t axis = 0; axis < 3; ++axis) block_.lambda_gradient[i][axis][lane] = tetra.gradient[i][axis];
  }
  const Index slot = slot_of(contactor);
  for (std::size_t a = 0; a < 4; ++a) {
    block_.node[3 + a][lane] = local_.corner_node(slot, static_cast<int>(a));
    block_.lambda[a][lane] = lambda[a];
    block_.depth[a][lane] = depth[a];
  }
}

/// What presses there. @param old, h  one step ago; now by the normal law alone;  @param g  m
void Pass::fill_lane(const ContactLaw& law, double length, const TouchingCouple& old, const TouchingCouple& h, double g,
                     double lost) {
  const std::size_t lane = filled_;
  const ContactPoint& point = point_at(h.point);
  const double scale = point.weight * length, stress = normal_law::stress(law, h.d, h.d_max);
  block_.change[lane] = g - (old.d * length + old.offset);
  block_.deep[lane] = h.d * length;
  block_.pressure[lane] = point.weight * stress;
  block_.stored[lane] = scale * normal_law::stored_under(law, h.d, stress);
  block_.stored_before[lane] = scale * normal_law::stored(law, old.d, old.d_max);
  block_.lost[lane] = lost;
  put(old.force, lane, block_.last_force);
  block_.stiffness[lane] = stiffness(law, point, length);
  block_.tangential[lane] = law.tangential_ratio * block_.stiffness[lane];
  block_.exponent[lane] = law.exponent;
  block_.friction[lane] = law.friction;
  block_.longest_delay[lane] = longest_delay(law, h);
  put(old.spring == Vec3::Zero() ? Vec3(Vec3::Zero()) : mean_turn(point.slot, h.contactor), lane, block_.turn);
  put(old.spring, lane, block_.spring);
  block_.delayed_force[lane] = old.delayed.force;
  block_.delayed_age[lane] = old.delayed.age;
  block_.delayed_halfway[lane] = old.delayed.halfway;
  block_.gained[lane] = old.gained;
  block_.gained_before[lane] = old.gained_before + 0.0;  // as touch() adds the former gain: no negative zero
}

/// Evaluates the block, and adds all forces in the order in which they came.
void Pass::press_waiting() {
  if (filled_ == 0) return;
  kernels_.press(dt_, state_.velocity.data(), block_);
  filled_ = 0;
  for (const Waiting& waiting : waiting_) {
    if (waiting.lane >= 0) {
      store_results(waiting);
    } else {
      add_force(*waiting.point, waiting.contactor, waiting.lambda, waiting.force);
    }
  }
  waiting_.clear();
}

/// Takes a couple out of the block. @pre no lane is filled
void Pass::store_results(const Waiting& waiting) {
  const auto lane = static_cast<std::size_t>(waiting.lane);
  const ContactPoint& point = *waiting.point;
  TouchingCouple& h = contact_.touching[lanes_[lane].touching];
  if (block_.other[lane] != 0) {
    Candidate candidate = candidate_of(point, waiting.contactor, waiting.lambda);
    candidate.old = lanes_[lane].old;
    return touch(lanes_[lane].point, candidate, h);
  }
  account(point, work_.dissipated).add(block_.lost[lane]);
  account(point, work_.friction_dissipated).add(block_.slip_energy[lane]);
  account(point, work_.friction_stored).add(block_.spring_energy[lane]);
  account(point, work_.stored).add(block_.stored[lane]);
  if (local_.is_original(point.slot)) ++work_.touching;
  h.spring = take(block_.spring, lane);
  h.friction = take(block_.tangential_force, lane);
  h.delayed = {block_.delayed_force[lane], block_.delayed_age[lane], block_.delayed_halfway[lane]};
  h.force = take(block_.force, lane);
  h.balance = block_.balance[lane];
  h.gained = block_.gained[lane];
  h.gained_before = block_.gained_before[lane];
  add_force(point, waiting.contactor, waiting.lambda, h.force);
}

}  // namespace breccia::contact_pass
