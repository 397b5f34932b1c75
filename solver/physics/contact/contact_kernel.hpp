#pragma once

// The kernel of contact_block.hpp, included once by each translation unit contact_kernel_<instruction set>.cpp and
// compiled for its set, as the sweep is (sweep_kernel.hpp).

#include <experimental/simd>

#include "physics/contact/contact_balance.hpp"
#include "physics/contact/contact_block.hpp"
#include "physics/contact/friction.hpp"
#include "physics/contact/tetra_place.hpp"
#include "physics/lane_vector.hpp"

namespace breccia {
namespace {

namespace stdx = std::experimental;

using elasticity::select;
using Real = stdx::native_simd<double>;
using Lanes = Real::mask_type;
using Vector = LaneVector<Real>;
constexpr std::size_t kWidth = Real::size();
static_assert(kLanes % kWidth == 0);

/// W couples of a block.
struct Some {
  ContactBlock& block;
  std::size_t first;

  [[nodiscard]] Real load(const ContactRow& row) const { return Real(&row.lane[first], stdx::element_aligned); }
  [[nodiscard]] Vector load(const ContactRow (&rows)[3]) const {
    return {{load(rows[0]), load(rows[1]), load(rows[2])}};
  }
  void store(const Real& value, ContactRow& row) const { value.copy_to(&row.lane[first], stdx::element_aligned); }
  void store(const Vector& value, ContactRow (&rows)[3]) const {
    for (std::size_t axis = 0; axis < 3; ++axis) store(value[axis], rows[axis]);
  }
  /// A node's vector out of a nodal field.
  [[nodiscard]] Vector gather(const double* field, std::size_t node) const {
    const double* place[kWidth];
    for (std::size_t l = 0; l < kWidth; ++l) place[l] = field + nodal(block.node[node][first + l], 0);
    Vector x;
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = Real([&](auto l) { return place[l][axis * kLanes]; });
    return x;
  }
};

/// Of the points relative to the contactors' material during the last step, m.
inline Vector relative_motion(const Some& at, double dt, const double* velocity) {
  const ContactBlock& b = at.block;
  Vector relative = at.load(b.shape[0]) * at.gather(velocity, 0) + at.load(b.shape[1]) * at.gather(velocity, 1) +
                    at.load(b.shape[2]) * at.gather(velocity, 2);
  for (std::size_t a = 0; a < 4; ++a) relative -= at.load(b.lambda[a]) * at.gather(velocity, 3 + a);
  return Real(dt) * relative;
}

/// Of the overlap with respect to the point.
inline Vector overlap_gradient(const Some& at) {
  const ContactBlock& b = at.block;
  Vector gradient{{Real(0.0), Real(0.0), Real(0.0)}};
  const Real first = at.load(b.depth[0]);
  for (std::size_t c = 1; c < 4; ++c) gradient += (at.load(b.depth[c]) - first) * at.load(b.lambda_gradient[c - 1]);
  return gradient;
}

/// Forces of W couples by their laws and the energies that go with them.
struct Pressed {
  Vector force, tangential, spring;
  DelayedForceOf<Real> delayed;
  Real kept;  ///< J, as Pass::press returns it
};

/// @param slope  |gradient|;  @param turn  m, gradient times motion beyond what the overlap has changed by
inline Pressed press(const Some& at, double dt, const Vector& gradient, const Real& slope, const Vector& motion,
                     const Real& turn) {
  ContactBlock& b = at.block;
  const Real pressure = at.load(b.pressure), k = at.load(b.tangential);
  Pressed now{-pressure * gradient,
              {},
              at.load(b.spring),
              {at.load(b.delayed_force), at.load(b.delayed_age), at.load(b.delayed_halfway)},
              {}};
  const Vector outward = -gradient / slope, spring = now.spring;
  Vector turned = spring;
  turn_spring(outward, outward.dot(at.load(b.turn)), turned);
  const Lanes rests = spring[0] == 0.0 && spring[1] == 0.0 && spring[2] == 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) now.spring[axis] = select(rests, spring[axis], turned[axis]);
  follow_normal_force(pressure * slope, dt, at.load(b.longest_delay), now.delayed);
  const Real limit = at.load(b.friction) * now.delayed.force;
  const FrictionStep<Vector> friction = friction_step(outward, motion, k, limit, now.spring);
  const Real held = 0.5 * k * now.spring.squaredNorm();
  now.tangential = friction.force;
  now.force += friction.force;
  now.kept = at.load(b.stored) + (held + friction.dissipated) + 0.5 * pressure * turn;
  at.store(held, b.spring_energy);
  at.store(friction.dissipated, b.slip_energy);
  return now;
}

/// As Pass::balance. @return  lanes whose force does some work
inline Lanes balance(const Some& at, const Vector& motion, Pressed& now) {
  ContactBlock& b = at.block;
  const Vector normal = now.force - now.tangential;
  const Real work = normal.dot(motion), size = normal.norm();
  const Real out = work / size, k = at.load(b.stiffness), exponent = at.load(b.exponent);
  Real gained = at.load(b.gained), before = at.load(b.gained_before);
  const Real beyond = select(out > at.load(b.deep), Real(0.5 * work - at.load(b.stored)), Real(0.0));
  const BalancingLimitsOf<Real> linear = balancing_limits(work, k, out), steep = steep_limits(work, k, exponent, out);
  const Lanes is_steep = exponent > 1.0 && work > 0.0;
  const BalancingLimitsOf<Real> limits{select(is_steep, steep.own, linear.own),
                                       select(is_steep, steep.give, linear.give),
                                       select(is_steep, steep.take, linear.take)};
  const BalancingSharesOf<Real> shares = balancing_shares(gained + beyond, before, work, limits);
  const Real share = shares.own + shares.before;
  before += shares.before * work;
  gained += 0.5 * (shares.own - shares.before) * work;
  now.force += share * normal;
  at.store(gained, b.gained);
  at.store(before, b.gained_before);
  at.store(share, b.balance);
  return work != 0.0 && size > kNoForce;
}

inline Lanes any_component(const Vector& v) { return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0; }

inline void act(const Some& at, double dt, const double* velocity) {
  using std::abs;
  ContactBlock& b = at.block;
  const Vector motion = relative_motion(at, dt, velocity), gradient = overlap_gradient(at);
  const Real change = at.load(b.change), along = gradient.dot(motion), slope = gradient.norm();
  const Vector spring = at.load(b.spring), last = at.load(b.last_force);
  const Real before = at.load(b.stored_before) + 0.5 * at.load(b.tangential) * spring.squaredNorm();
  Pressed now = press(at, dt, gradient, slope, motion, along - change);
  at.store(at.load(b.gained) + (0.5 * (last + now.force).dot(motion) + now.kept - before + at.load(b.lost)), b.gained);
  const Lanes works = balance(at, motion, now);
  const Lanes same_slope = abs(change - along) <= kSameSlope * motion.norm();
  const Lanes whole = any_component(motion) && same_slope && slope > 0.0 && works && any_component(now.force);
  at.store(now.force, b.force);
  at.store(now.tangential, b.tangential_force);
  at.store(now.spring, b.spring);
  at.store(now.delayed.force, b.delayed_force);
  at.store(now.delayed.age, b.delayed_age);
  at.store(now.delayed.halfway, b.delayed_halfway);
  for (std::size_t l = 0; l < kWidth; ++l) b.other[at.first + l] = whole[l] ? 0 : 1;
}

/// Where the points of W couples are.
inline void locate(LocateBlock& b, std::size_t first) {
  const PreparedTetra* const* some = b.tetra + first;
  PreparedTetraOf<Real> tetra;
  std::array<Real, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    tetra.origin[i] = Real([&](auto l) { return some[l]->origin[i]; });
    for (std::size_t c = 0; c < 3; ++c) tetra.gradient[c][i] = Real([&](auto l) { return some[l]->gradient[c][i]; });
    x[i] = Real(&b.x[i].lane[first], stdx::element_aligned);
  }
  const std::array<Real, 4> lambda = barycentric(tetra, x);
  const Real least =
      elasticity::lesser(elasticity::lesser(lambda[0], lambda[1]), elasticity::lesser(lambda[2], lambda[3]));
  const Lanes inert = !(tetra.gradient[0][0] == tetra.gradient[0][0]), inside = least >= -kInside,
              near = least >= -kGap;
  for (std::size_t a = 0; a < 4; ++a) lambda[a].copy_to(&b.lambda[a].lane[first], stdx::element_aligned);
  const Real safe = safe_travel(tetra, lambda, select(near, Real(kInside), Real(kGap)));
  safe.copy_to(&b.safe.lane[first], stdx::element_aligned);
  for (std::size_t l = 0; l < kWidth; ++l) {
    b.where[first + l] = inside[l]  ? Whereabouts::inside
                         : near[l]  ? Whereabouts::beside
                         : inert[l] ? Whereabouts::nowhere
                                    : Whereabouts::outside;
  }
}

inline void locate_block(LocateBlock& block) {
  for (std::size_t first = 0; first < kLanes; first += kWidth) locate(block, first);
}

inline void press_block(double dt, const double* velocity, ContactBlock& block) {
  for (std::size_t first = 0; first < kLanes; first += kWidth) act({block, first}, dt, velocity);
}

}  // namespace
}  // namespace breccia
