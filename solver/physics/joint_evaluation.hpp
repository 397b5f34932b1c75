#pragma once

// A joint as a whole, for T = double and for T = simd (joint_point.hpp): geometry of its mid-surface, its three points,
// the forces on its corners.

#include "physics/joint_point.hpp"

namespace breccia::joint_point {

template <class T>
using Triple = std::array<Vector<T>, 3>;

/// Corners of a joint's two faces, matching, m.
template <class T>
struct Sides {
  Triple<T> a, b;
};

template <class T>
struct Kinematics {
  Triple<T> opening;  // at the corners
  Frame<T> frame;     // of the mid-surface
  Vector<T> edge[2];  // of the mid-surface, from its corner 0 to 1 and 2
  T doubled_area;
};

template <class T>
using Joint = JointHistory<T>;

/// Forces of a joint on its corners, N: force + turning on those of a, turning - force on those of b.
template <class T>
struct Forces {
  Triple<T> force, turning;
};

/// Square of the largest opening, m2, in the very products the sweep uses.
template <class T>
[[nodiscard]] inline T largest_opening_squared(const Sides<T>& sides) {
  T largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector<T> d = minus(sides.b[i], sides.a[i]);
    const T square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    largest = select(largest < square, square, largest);
  }
  return largest;
}

template <class T>
[[nodiscard]] inline Kinematics<T> kinematics(const JointLawParams& law, const Sides<T>& sides) {
  const T zero = 0.0, one = 1.0;
  Kinematics<T> k;
  Triple<T> middle;
  for (std::size_t i = 0; i < 3; ++i) {
    k.opening[i] = minus(sides.b[i], sides.a[i]);
    middle[i] = times(T(0.5), plus(sides.a[i], sides.b[i]));
  }
  k.edge[0] = minus(middle[1], middle[0]);
  k.edge[1] = minus(middle[2], middle[0]);
  const Vector<T> across = cross(k.edge[0], k.edge[1]);
  k.doubled_area = root(dot(across, across));
  const Mask<T> flat = !(k.doubled_area > zero);
  k.frame.normal = times(select(flat, one, T(1.0 / k.doubled_area)), across);
  k.frame.tangent[0] = k.frame.tangent[1] = {zero, zero, zero};
  if (law.friction > 0) {
    const T length = root(dot(k.edge[0], k.edge[0]));
    k.frame.tangent[0] = times(select(length > zero, T(1.0 / length), zero), k.edge[0]);
    k.frame.tangent[1] = cross(k.frame.normal, k.frame.tangent[0]);
  }
  return k;
}

/// Opening at an integration point.
template <class T>
[[nodiscard]] inline Vector<T> point_opening(const JointLawParams& law, const Triple<T>& corners, std::size_t i) {
  switch (law.points) {
    case JointPoints::nodal:
      return corners[i];
    case JointPoints::mid_edge:
      return times(T(0.5), plus(corners[i], corners[(i + 1) % 3]));
  }
  __builtin_unreachable();
}

/// At the corners, and so at mid-edge points too.
template <class T>
[[nodiscard]] inline Mask<T> open_everywhere(const Kinematics<T>& k) {
  Mask<T> open = dot(k.opening[0], k.frame.normal) > 0.0;
  for (std::size_t i = 1; i < 3; ++i) open = open && dot(k.opening[i], k.frame.normal) > 0.0;
  return open;
}

/// Enough points have given way for the joint to fail.
template <class T>
[[nodiscard]] inline Mask<T> enough_points_broken(const JointLawParams& law, const Joint<T>& joint) {
  T full = 0.0;
  for (const Point<T>& p : joint.points) full += select(p.damage >= 1.0, T(1.0), T(0.0));
  return full >= static_cast<double>(law.points_to_fail);
}

template <class T>
[[nodiscard]] inline Point<T> select_point(const Mask<T>& mask, const Point<T>& a, const Point<T>& b) {
  Point<T> p = b;
  const auto take = [&](const JointNumber&, T& x, const T& y) { x = select(mask, y, x); };
  for_each_number(take, p, a);
  return p;
}

/// A joint is a crack, for any state of its other points, once it has damage and a corner is farther open than this
/// many times the critical opening of its mode, d_nt + D_n, or d_st + D_s while it has not failed ...
inline constexpr double kCrackOpening = 10;
/// ... or a corner's opening is longer than this share of the size of the mid-surface, the root of its area: then that
/// surface does not represent the two faces.
inline constexpr double kLostShape = 0.5;
/// Share of the reference area below which a mid-surface has no normal to turn.
inline constexpr double kFlat = 0.01;
/// Evaluations in which the remaining forces of a crack decay, mostly pressure of closed points: no force jumps. It is
/// faster where the opening grows beyond kLostShape meanwhile (most_held).
inline constexpr double kHandoverSteps = 64;

/// Joints that are cracks by their opening.
template <class T>
[[nodiscard]] inline Mask<T> is_crack(const JointLawParams& law, const Kinematics<T>& k, const Joint<T>& joint) {
  T damage = 0.0;
  for (const Point<T>& p : joint.points) damage = greater(damage, p.damage);
  const Mask<T> damaged = damage > 0.0;
  Mask<T> crack(false);
  if (!law.breakable() || !any(damaged)) return crack;
  const double normal = kCrackOpening * (law.onset_normal + law.width_normal);
  const double shear = kCrackOpening * (law.onset_shear + law.width_shear);
  const Mask<T> holding = joint.failed <= 0.0 && !enough_points_broken(law, joint);
  const T shape2 = (0.5 * kLostShape * kLostShape) * k.doubled_area;
  for (const Vector<T>& opening : k.opening) {
    const T along = dot(opening, k.frame.normal), length2 = dot(opening, opening);
    crack = crack || along > normal || (holding && length2 - along * along > shear * shear) || length2 > shape2;
  }
  return damaged && crack;
}

/// Largest remaining share of the forces of a crack: 1 up to an opening of kLostShape times the size of its
/// mid-surface, 0 from twice that on. Elements that fold about a hinge lie back to back within fewer steps than
/// kHandoverSteps; the mid-surface then has no area, and its normal changes sign.
template <class T>
[[nodiscard]] inline T most_held(const Kinematics<T>& k) {
  T largest2 = 0.0;
  for (const Vector<T>& opening : k.opening) largest2 = greater(largest2, dot(opening, opening));
  const T shape2 = (0.5 * kLostShape * kLostShape) * k.doubled_area;
  return select(shape2 > 0.0, greater(T(2.0 - root(T(largest2 / shape2))), T(0.0)), T(0.0));
}

/// Evaluates the points and accumulates their dissipation; returns the force on each corner of a.
template <class T>
[[nodiscard]] inline Triple<T> evaluate_points(const JointLawParams& law, const Kinematics<T>& k, Joint<T>& joint) {
  Response<T> response[3];
  const Mask<T> failed = joint.failed > 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    response[i] = evaluate(law, k.frame, point_opening(law, k.opening, i), failed, joint.points[i]);
  const T hold_before = joint.hold;
  const Mask<T> letting_go = is_crack(law, k, joint) || joint.hold < 1.0;
  if (any(letting_go)) {
    const T next = lesser(T(joint.hold - 1.0 / kHandoverSteps), most_held(k));
    joint.hold = select(letting_go, greater(next, T(0.0)), joint.hold);
  }
  const T share = joint.area / 3.0, held = share * joint.hold, lost = share * (hold_before - joint.hold);
  for (const Response<T>& r : response) {
    joint.mode_1 += held * r.mode_1;
    joint.mode_2 += held * r.mode_2;
    joint.friction += held * r.friction;
    joint.viscous += held * r.viscous;
  }
  if (any(letting_go)) {
    for (const Response<T>& r : response) {
      joint.mode_1 += lost * r.stored.open;
      joint.mode_2 += lost * r.stored.shear;
      joint.friction += lost * r.stored.spring;
      joint.viscous += lost * r.stored.pressed;
    }
  }
  const T elastic = law.stiffness * joint.area / 3.0 * joint.hold;
  Triple<T> force;
  for (std::size_t i = 0; i < 3; ++i) {
    switch (law.points) {
      case JointPoints::nodal:
        // Elastic ones in the very product the sweep uses: the same bits on either path.
        force[i] = select3<T>(response[i].elastic, times(elastic, k.opening[i]), times(held, response[i].traction));
        break;
      case JointPoints::mid_edge:
        force[i] = times(T(0.5 * held), plus(response[i].traction, response[(i + 2) % 3].traction));
        break;
    }
  }
  return force;
}

/// sigma - K_s delta_n of a point, Pa, tau = K_s delta_s but for friction, whose spring turns with the surface: 0 where
/// the traction is parallel to the opening.
template <class T>
[[nodiscard]] inline T unequal_traction(const JointLawParams& law, const Kinematics<T>& k, const Vector<T>& opening,
                                        const Point<T>& p) {
  switch (law.law) {
    case JointLaw::mixed_mode:
      return select(p.normal_opening < 0.0, T(law.stiffness * p.damage * p.normal_opening), T(0.0));
    case JointLaw::independent_peaks: {
      const Components<T> c = split(law, k.frame, opening);
      const PointState<T> now = state_of(law, c, remaining_of(law, p));
      return now.normal - now.shear_stiffness * c.normal;
    }
  }
  __builtin_unreachable();
}

template <class T>
[[nodiscard]] inline Mask<T> may_tilt(const JointLawParams& law, const Joint<T>& joint) {
  Mask<T> tilts(!rises_linearly(law.rise));
  for (const Point<T>& p : joint.points) {
    const Mask<T> damaged = p.damage > 0.0;
    tilts = tilts || (has_secants(law.law) ? damaged : damaged && p.normal_opening < 0.0);
  }
  return tilts;
}

/// What turning the mid-surface does to a joint whose traction is not parallel to its opening: its energy then depends
/// on the normal. T = sum A0/3 (sigma - K_s delta_n) delta_s, N: dU = T . dn.
template <class T>
[[nodiscard]] inline Vector<T> tilting(const JointLawParams& law, const Kinematics<T>& k, const Joint<T>& joint) {
  const T zero = 0.0;
  Vector<T> tilt{zero, zero, zero};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point<T>& p = joint.points[i];
    const Vector<T> opening = point_opening(law, k.opening, i);
    const T unequal = unequal_traction(law, k, opening, p);
    const Vector<T> shear = minus(opening, times(p.normal_opening, k.frame.normal));
    tilt = plus(tilt, times(T(joint.hold * joint.area / 3.0 * unequal), shear));
  }
  return tilt;
}

/// Forces on the three pairs of corners that go with tilting, so that forces are the gradient of the energy also after
/// a long slip. Each of a pair gets half of -dU/dm, m the corner of the mid-surface. 0 where not `on`, and where the
/// mid-surface is lost.
template <class T>
[[nodiscard]] inline Triple<T> tilting_forces(const JointLawParams& law, const Kinematics<T>& k, const Mask<T>& on,
                                              const Joint<T>& joint) {
  const T zero = 0.0;
  const Vector<T> tilt = tilting(law, k, joint);
  const Mask<T> turns = on && k.doubled_area > kFlat * joint.area;
  const T half = select(turns, T(-0.5 / k.doubled_area), zero);
  const Vector<T> second = times(half, cross(k.edge[1], tilt)), third = times(half, cross(tilt, k.edge[0]));
  Vector<T> first;
  for (std::size_t i = 0; i < 3; ++i) first[i] = -(second[i] + third[i]);
  return {first, second, third};
}

}  // namespace breccia::joint_point
