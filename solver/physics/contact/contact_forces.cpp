#include "physics/contact/contact_forces.hpp"

#include <algorithm>
#include <cmath>

#include "physics/contact/contact_balance.hpp"
#include "physics/contact/contact_field.hpp"
#include "physics/contact/friction.hpp"
#include "physics/contact/spherical_boundary.hpp"

namespace breccia {

namespace {

/// Slope that the overlap field hardly exceeds: 1 where it is a distance.
constexpr double kSteepest = 2.0;
/// Share of its heights by which an element reaches beyond its faces for a point that was in it: joints open by less
/// before they break.
constexpr double kGap = 0.01;

Index group_of(const LocalMesh& local, Index slot) {
  return local.block_group[static_cast<std::size_t>(slot / kLanes)];
}

bool share_vertex(const LocalMesh& local, Index slot, Index other) {
  const std::array<Index, 4>& a = local.vertex[static_cast<std::size_t>(slot)];
  const std::array<Index, 4>& b = local.vertex[static_cast<std::size_t>(other)];
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

/// A contactor that holds the point at hand.
struct Candidate {
  Index contactor;
  std::array<double, 4> lambda;
  double g;                 ///< m, now
  double g_before;          ///< m, with the field of one step ago
  std::ptrdiff_t old = -1;  ///< index of its history among those of the last step, -1: none
};

/// Normal force with damping over the slope of the overlap, N, and what the damping takes, J.
struct Damping {
  double pressure, dissipated;
};

/// One call of contact_forces.
class Pass {
 public:
  Pass(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt, ContactState& contact,
       NodalForces& forces, ContactWork& work)
      : params_(params),
        local_(local),
        state_(state),
        dt_(dt),
        contact_(contact),
        forces_(forces),
        work_(work),
        rule_(face_rule(params.points_per_face)) {}

  void run();

 private:
  void prepare_contactors();
  void bridge_gaps(Index point);
  void touch_point(Index point);
  void drop_ambiguous();
  void find_histories(Index point);
  void take_over(std::size_t first, std::size_t last);
  void forget(const TouchingCouple& old, double lost = 0);
  void end(const ContactPoint& point, const TouchingCouple& last, const Vec3& motion,
           const std::array<double, 4>& lambda, TouchingCouple& h);
  [[nodiscard]] Vec3 relative_motion(const ContactPoint& point, Index slot, const std::array<double, 4>& lambda) const;
  [[nodiscard]] double first_offset(Index point, const Candidate& candidate) const;
  [[nodiscard]] static double follow(const ContactLaw& law, double scale, double length, const Candidate& candidate,
                                     TouchingCouple& h);
  void keep_step(const ContactPoint& point, Index slot, double g_old, Candidate& candidate) const;
  void act(Index point, Candidate& candidate);
  [[nodiscard]] double press(const ContactLaw& law, const ContactPoint& point, double length, const Vec3& motion,
                             const Candidate& candidate, TouchingCouple& h);
  void balance(const ContactPoint& point, double length, const Vec3& motion, TouchingCouple& h) const;
  [[nodiscard]] Damping damp(const ContactLaw& law, const ContactPoint& point, const Vec3& motion,
                             const Candidate& candidate, const Vec3& gradient, double elastic) const;
  void distribute(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda, const Vec3& force);

  [[nodiscard]] const ContactPoint& point_at(Index point) const {
    return contact_.points[static_cast<std::size_t>(point)];
  }
  [[nodiscard]] Index slot_of(Index contactor) const {
    return contact_.contactors[static_cast<std::size_t>(contactor)];
  }
  [[nodiscard]] Index body_of(Index contactor) const {
    return local_.slot_body[static_cast<std::size_t>(slot_of(contactor))];
  }
  /// Whether two contactors are of one body and share a vertex of its mesh.
  [[nodiscard]] bool hangs_on(Index contactor, Index other) const {
    return body_of(contactor) == body_of(other) && share_vertex(local_, slot_of(contactor), slot_of(other));
  }
  [[nodiscard]] double length_of(Index slot) const {
    return contact_.body_length[static_cast<std::size_t>(local_.slot_body[static_cast<std::size_t>(slot)])];
  }
  [[nodiscard]] const ContactLaw& law_of(Index point, Index contactor) const {
    return params_.law(group_of(local_, point_at(point).slot), group_of(local_, slot_of(contactor)));
  }
  /// N/m, of a couple along its normal; times tangential_ratio of its friction.
  [[nodiscard]] double stiffness(const ContactPoint& point, const TouchingCouple& h) const {
    return point.weight * law_of(h.point, h.contactor).penalty / length_of(slot_of(h.contactor));
  }
  [[nodiscard]] double spring_stiffness(const ContactPoint& point, const TouchingCouple& h) const {
    return law_of(h.point, h.contactor).tangential_ratio * stiffness(point, h);
  }
  /// J, by the normal law of a couple.
  [[nodiscard]] double normal_held(const ContactPoint& point, const TouchingCouple& h) const {
    const double scale = point.weight * length_of(slot_of(h.contactor));
    return scale * normal_law::stored(law_of(h.point, h.contactor), h.d, h.d_max);
  }
  [[nodiscard]] double held(const ContactPoint& point, const TouchingCouple& h) const {
    return normal_held(point, h) + 0.5 * spring_stiffness(point, h) * h.spring.squaredNorm();
  }
  [[nodiscard]] const PreparedTetra& prepared(Index contactor) const {
    return contact_.prepared[static_cast<std::size_t>(contact_.place[static_cast<std::size_t>(contactor)])];
  }
  /// Where the work at a point is accounted: couples are computed wherever one side is at home, and accounted with
  /// their points.
  [[nodiscard]] ExactSum& account(const ContactPoint& point, ExactSum& sum) {
    return local_.is_original(point.slot) ? sum : ignored_;
  }
  /// Adds the contactor to the candidates if its overlap is positive now or was so before the field moved.
  void consider(Index contactor, const std::array<double, 4>& lambda);

  const ContactParams& params_;
  const LocalMesh& local_;
  const NodalState& state_;
  double dt_;
  ContactState& contact_;
  NodalForces& forces_;
  ContactWork& work_;
  const FaceRule& rule_;
  std::vector<Candidate> candidates_;  ///< of the point at hand, ascending
  std::vector<Candidate> beside_;      ///< the same of contactors that it lies just outside of
  std::vector<bool> taken_;            ///< old histories of the point at hand that live on
  std::size_t old_ = 0;                ///< first old history not yet looked at
  ExactSum ignored_;                   ///< what other ranks account
};

void Pass::run() {
  advance_field(contact_);
  contact_.touching_before.swap(contact_.touching);
  contact_.touching.clear();
  work_.stored = work_.friction_stored = ExactSum{};
  work_.touching = 0;
  spherical_boundary(params_, local_, state_, contact_, forces_, work_.stored);
  prepare_contactors();

  const std::vector<ContactCouple>& couples = contact_.couples;
  const double* position = state_.position.data();
  for (std::size_t i = 0; i < couples.size();) {
    const Index point = couples[i].point;
    const Vec3 x = at_point(rule_, point_at(point), position);
    candidates_.clear();
    beside_.clear();
    for (; i < couples.size() && couples[i].point == point; ++i) {
      const std::array<double, 4> lambda = barycentric(prepared(couples[i].contactor), x);
      if (inside(lambda)) {
        consider(couples[i].contactor, lambda);
      } else if (smallest(lambda) >= -kGap) {
        beside_.push_back({couples[i].contactor, lambda, 0, 0});
      }
    }
    if (!beside_.empty()) bridge_gaps(point);
    if (!candidates_.empty()) touch_point(point);
  }
  for (; old_ < contact_.touching_before.size(); ++old_) forget(contact_.touching_before[old_]);
  contact_.fresh.clear();
}

void Pass::prepare_contactors() {
  contact_.prepared.resize(contact_.in_couples.size());
  for (std::size_t i = 0; i < contact_.in_couples.size(); ++i) {
    const Index slot = slot_of(contact_.in_couples[i]);
    contact_.prepared[i] =
        prepare(load_corners(local_, state_.position.data(), slot), local_.volume[static_cast<std::size_t>(slot)]);
  }
}

void Pass::consider(Index contactor, const std::array<double, 4>& lambda) {
  Candidate candidate{contactor, lambda, 0, 0};
  candidate.g = candidate.g_before = overlap_value(overlap_shape(params_, local_, contact_, contactor), lambda);
  if (contact_.ramp_of_contactor[static_cast<std::size_t>(contactor)] >= 0)
    candidate.g_before =
        overlap_value(overlap_shape(params_, local_, contact_, contactor, Instant::step_before), lambda);
  if (candidate.g > 0 || candidate.g_before > 0) candidates_.push_back(candidate);
}

/// A point that pressed on an element stays with it while joints open under the point and it is in no other element
/// that the first one hangs on: the force would be gone in a step, and what it holds with it.
void Pass::bridge_gaps(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  const GlobalId id = contact_.id(point);
  std::size_t k = old_;
  while (k < old.size() && contact_.id(old[k].point) < id) ++k;
  const std::size_t inside_one = candidates_.size();
  for (; k < old.size() && old[k].point == point; ++k) {
    const auto here = std::find_if(beside_.begin(), beside_.end(),
                                   [&](const Candidate& c) { return c.contactor == old[k].contactor; });
    if (here == beside_.end() || !(old[k].d > 0)) continue;
    const bool goes_on = std::any_of(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(inside_one),
                                     [&](const Candidate& c) { return hangs_on(c.contactor, here->contactor); });
    if (!goes_on) consider(here->contactor, here->lambda);
  }
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.contactor < b.contactor; });
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

/// A point on the border of neighbouring elements is inside all of them (kInside): the first one counts.
void Pass::drop_ambiguous() {
  std::size_t kept = 1;
  for (std::size_t i = 1; i < candidates_.size(); ++i) {
    const Candidate& here = candidates_[i];
    const bool counted = smallest(here.lambda) < kInside &&
                         std::any_of(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(kept),
                                     [&](const Candidate& c) {
                                       return smallest(c.lambda) < kInside && hangs_on(c.contactor, here.contactor);
                                     });
    if (!counted) candidates_[kept++] = Candidate(here);
  }
  candidates_.resize(kept);
}

void Pass::find_histories(Index point) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  const GlobalId id = contact_.id(point);
  while (old_ < old.size() && contact_.id(old[old_].point) < id) forget(old[old_++]);
  const std::size_t first = old_;
  while (old_ < old.size() && old[old_].point == point) ++old_;
  if (old_ > first) take_over(first, old_);
}

/// Old histories [first, last) go to the candidates: the same contactor first, then a neighbour in the same body.
void Pass::take_over(std::size_t first, std::size_t last) {
  const std::vector<TouchingCouple>& old = contact_.touching_before;
  taken_.assign(last - first, false);
  const auto assign = [&](auto&& belongs) {
    for (Candidate& candidate : candidates_) {
      for (std::size_t k = first; k < last && candidate.old < 0; ++k) {
        if (taken_[k - first] || !belongs(old[k].contactor, candidate.contactor)) continue;
        candidate.old = static_cast<std::ptrdiff_t>(k);
        taken_[k - first] = true;
      }
    }
  };
  assign([](Index from, Index to) { return from == to; });
  assign([&](Index from, Index to) { return hangs_on(from, to); });
  for (std::size_t k = first; k < last; ++k) {
    if (!taken_[k - first]) forget(old[k]);
  }
}

/// Motion of the point relative to the contactor's material at lambda during the last step, m.
Vec3 Pass::relative_motion(const ContactPoint& point, Index slot, const std::array<double, 4>& lambda) const {
  const double* v = state_.velocity.data();
  Vec3 relative = at_point(rule_, point, v);
  for (int a = 0; a < 4; ++a)
    relative -= lambda[static_cast<std::size_t>(a)] * load_node(v, local_.corner_node(slot, a));
  return dt_ * relative;
}

/// The overlap is gone. What the normal law had stored was given back as work, or is lost; the spring lets go. The
/// contactor may have left all couples with a search in this step, so it is prepared here.
/// @param lost  J, by the normal law
void Pass::forget(const TouchingCouple& old, double lost) {
  if (!(old.d > 0) && old.force == Vec3::Zero()) return;
  const ContactPoint& point = point_at(old.point);
  const Index slot = slot_of(old.contactor);
  const PreparedTetra tetra =
      prepare(load_corners(local_, state_.position.data(), slot), local_.volume[static_cast<std::size_t>(slot)]);
  const bool crushed = inert(tetra);
  std::array<double, 4> lambda{};
  Vec3 motion = Vec3::Zero();
  if (!crushed) {
    lambda = barycentric(tetra, at_point(rule_, point, state_.position.data()));
    motion = relative_motion(point, slot, lambda);
  }
  if (old.friction != Vec3::Zero()) {
    const double released = released_by_friction(motion, spring_stiffness(point, old), old.spring);
    account(point, work_.friction_dissipated).add(released);
    lost += released;
  }
  // A contactor that was crushed while it was touched gives nothing back.
  if (crushed) return account(point, work_.dissipated).add(normal_held(point, old));
  if (overlap_value(overlap_shape(params_, local_, contact_, old.contactor), lambda) > 0) {
    // The point has not left through the surface: a crack has opened under it, and what it held is gone.
    const double cut_off = normal_held(point, old);
    account(point, work_.dissipated).add(cut_off);
    lost += cut_off;
  }
  TouchingCouple ended{.point = old.point, .contactor = old.contactor};
  ended.gained = old.gained + 0.5 * old.force.dot(motion) - held(point, old) + lost;
  end(point, old, motion, lambda, ended);
  if (ended.force != Vec3::Zero()) contact_.touching.push_back(ended);
}

/// The couple exerts no force by its law any more. @param h  read and written: force, gained
void Pass::end(const ContactPoint& point, const TouchingCouple& last, const Vec3& motion,
               const std::array<double, 4>& lambda, TouchingCouple& h) {
  h.force = closing_force(h.gained, last.force, motion, last.d > 0, stiffness(point, h));
  h.gained += 0.5 * h.force.dot(motion);
  distribute(point, h.contactor, lambda, h.force);
}

/// Overlap that makes no force, m, of a couple seen for the first time.
double Pass::first_offset(Index point, const Candidate& candidate) const {
  const ContactCouple couple{point, candidate.contactor};
  const auto& fresh = contact_.fresh;
  const bool is_fresh = !fresh.empty() && std::binary_search(fresh.begin(), fresh.end(), couple,
                                                             [&](const ContactCouple& a, const ContactCouple& b) {
                                                               return contact_.before(a, b);
                                                             });
  const Index slot = slot_of(candidate.contactor);
  if (is_fresh || share_vertex(local_, point_at(point).slot, slot)) return std::max(candidate.g_before, 0.0);
  // A point that comes through a gap between elements, an opened joint say, is deep inside at once: deeper than it
  // moved.
  const double moved = relative_motion(point_at(point), slot, candidate.lambda).norm();
  return moved > 0 ? std::max(candidate.g_before - kSteepest * moved, 0.0) : 0.0;
}

/// The law follows the motion (field at rest), then the field (points at rest), so that the energy each of them moves
/// is known apart. @return  J dissipated
double Pass::follow(const ContactLaw& law, double scale, double length, const Candidate& candidate, TouchingCouple& h) {
  const auto go_to = [&](double g) {
    h.offset = std::clamp(g, 0.0, h.offset);
    const double d = std::max(0.0, g - h.offset) / length;
    const double d_max = normal_law::largest(d, h.d_max);
    const double lost = std::max(0.0, normal_law::dissipated(law, d_max) - normal_law::dissipated(law, h.d_max));
    h.d = d;
    h.d_max = d_max;
    return scale * lost;
  };
  const double lost = go_to(candidate.g_before);
  if (candidate.g == candidate.g_before) return lost;
  // The offset takes up the field's change: what rises makes no force, what sinks takes force away once the offset is
  // gone.
  const double stored = normal_law::stored(law, h.d, h.d_max);
  h.offset = std::max(0.0, h.offset + (candidate.g - candidate.g_before));
  go_to(candidate.g);
  // d does not rise here: the difference is negative by round-off only.
  return lost + scale * std::max(0.0, stored - normal_law::stored(law, h.d, h.d_max));
}

/// A point that moves on into another element finds the field it leaves only while the two are bonded. What the overlap
/// changes by more than the point has moved is a change of field, not of place.
void Pass::keep_step(const ContactPoint& point, Index slot, double g_old, Candidate& candidate) const {
  const double reach = kSteepest * relative_motion(point, slot, candidate.lambda).norm();
  candidate.g_before = std::clamp(candidate.g_before, g_old - reach, g_old + reach);
}

void Pass::act(Index index, Candidate& candidate) {
  const ContactPoint& point = point_at(index);
  const Index slot = slot_of(candidate.contactor);
  const ContactLaw& law = law_of(index, candidate.contactor);
  const double length = length_of(slot);
  TouchingCouple& h = contact_.touching.emplace_back();
  if (candidate.old >= 0) {
    h = contact_.touching_before[static_cast<std::size_t>(candidate.old)];
    if (h.contactor != candidate.contactor) keep_step(point, slot, h.d * length + h.offset, candidate);
  } else {
    h.offset = first_offset(index, candidate);
  }
  const TouchingCouple last = h;
  h.point = index;
  h.contactor = candidate.contactor;
  h.force = h.friction = Vec3::Zero();
  h.balance = 0;
  const double lost = follow(law, point.weight * length, length, candidate, h);
  account(point, work_.dissipated).add(lost);
  if (!(candidate.g > 0)) {
    contact_.touching.pop_back();
    forget(last, lost);  // by the law and on the contactor that it had
  } else if (h.d > 0 || last.force != Vec3::Zero()) {
    // Freshly broken surfaces are full of couples that lie together without force: nothing more to do for those.
    const Vec3 motion = relative_motion(point, slot, candidate.lambda);
    const double before = candidate.old >= 0 ? held(point, last) : 0.0;
    const double kept = press(law, point, length, motion, candidate, h);
    // What a couple holds that was there before anything moved has been put in.
    if (candidate.old >= 0 || motion != Vec3::Zero()) {
      h.gained += 0.5 * (last.force + h.force).dot(motion) + kept - before + lost;
      balance(point, length, motion, h);
    }
    distribute(point, candidate.contactor, candidate.lambda, h.force);
    if (h.force == Vec3::Zero()) end(point, last, motion, candidate.lambda, h);
  }
}

/// @return  J that the couple holds, and that friction and damping have dissipated
double Pass::press(const ContactLaw& law, const ContactPoint& point, double length, const Vec3& motion,
                   const Candidate& candidate, TouchingCouple& h) {
  const Overlap here = overlap(overlap_shape(params_, local_, contact_, candidate.contactor),
                               prepared(candidate.contactor), candidate.lambda);
  Damping normal{point.weight * normal_law::stress(law, h.d, h.d_max), 0.0};
  if (law.damping > 0 && h.d > 0 && dt_ > 0 && here.gradient != Vec3::Zero())
    normal = damp(law, point, motion, candidate, here.gradient, normal.pressure);
  account(point, work_.dissipated).add(normal.dissipated);
  h.force = -normal.pressure * here.gradient;
  const double stored = point.weight * length * normal_law::stored(law, h.d, h.d_max);
  double kept = stored + normal.dissipated;
  const double slope = here.gradient.norm();
  if (law.friction > 0 && law.tangential_ratio > 0 && slope > 0) {
    const double k = law.tangential_ratio * point.weight * law.penalty / length;
    const FrictionStep friction =
        friction_step(-here.gradient / slope, motion, k, law.friction * normal.pressure * slope, h.spring);
    const double spring = 0.5 * k * h.spring.squaredNorm();
    account(point, work_.friction_dissipated).add(friction.dissipated);
    account(point, work_.friction_stored).add(spring);
    h.friction = friction.force;
    h.force += friction.force;
    kept += spring + friction.dissipated;
  }
  account(point, work_.stored).add(stored);
  if (h.d > 0 && local_.is_original(point.slot)) ++work_.touching;
  return kept;
}

/// @param h  force by its law and what it has gained with it; both are changed
void Pass::balance(const ContactPoint& point, double length, const Vec3& motion, TouchingCouple& h) const {
  const Vec3 normal = h.force - h.friction;
  const double work = normal.dot(motion);
  if (work == 0) return;
  const double out = work / normal.norm();
  const bool leaves = out > h.d * length;  // in the next step, with the motion of this one
  const double gained = h.gained + (leaves ? 0.5 * work - normal_held(point, h) : 0.0);
  h.balance = balancing_share(gained, work, stiffness(point, h), out);
  h.gained += 0.5 * h.balance * work;
  h.force += h.balance * normal;
}

/// Its work is that of the mean of this and the last force over the motion; where that turns round there is none.
Damping Pass::damp(const ContactLaw& law, const ContactPoint& point, const Vec3& motion, const Candidate& candidate,
                   const Vec3& gradient, double elastic) const {
  const double deeper = gradient.dot(motion);  // m, during the last step
  const double pressure = point.weight * normal_law::damped(law, elastic / point.weight, deeper / dt_);
  double before = 0;
  if (candidate.old >= 0 && contact_.touching_before[static_cast<std::size_t>(candidate.old)].d > 0) {
    const TouchingCouple& old = contact_.touching_before[static_cast<std::size_t>(candidate.old)];
    before = (old.force - old.friction).norm() / ((1 + old.balance) * gradient.norm()) -
             point.weight * normal_law::stress(law, old.d, old.d_max);
  }
  return {pressure, std::max(0.0, 0.5 * (before + pressure - elastic) * deeper)};
}

void Pass::distribute(const ContactPoint& point, Index contactor, const std::array<double, 4>& lambda,
                      const Vec3& force) {
  if (force == Vec3::Zero()) return;
  const std::array<double, 3>& shape = rule_.shape[static_cast<std::size_t>(point.k)];
  for (std::size_t i = 0; i < 3; ++i) forces_.add(point.nodes[i], shape[i] * force);
  const Index slot = slot_of(contactor);
  for (int a = 0; a < 4; ++a) {
    forces_.add(local_.corner_node(slot, a), -lambda[static_cast<std::size_t>(a)] * force);
  }
}

}  // namespace

void contact_forces(const ContactParams& params, const LocalMesh& local, const NodalState& state, double dt,
                    ContactState& contact, NodalForces& forces, ContactWork& work) {
  Pass(params, local, state, dt, contact, forces, work).run();
}

}  // namespace breccia
