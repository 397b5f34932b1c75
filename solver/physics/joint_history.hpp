#pragma once

#include <array>
#include <string_view>

namespace breccia {

/// Which laws need a number of a joint point.
enum class JointNumberUse {
  all,       ///< every law
  friction,  ///< laws with friction
  peaks      ///< independent_peaks
};

/// A number that a joint or one of its points remembers, as tables, files and messages name it.
struct JointNumber {
  std::string_view name, unit;
  JointNumberUse use = JointNumberUse::all;
  bool of_elastic = false;  ///< an elastic point is left with this one up to date, not with the others
};

/// What a point of a joint remembers, over the number type: double, a SIMD vector, or a row of numbers side by side.
template <class T>
struct JointPointHistory {
  T damage = 0.0;                   ///< mixed_mode: d; independent_peaks: D
  T level = 0.0;                    ///< D at which the damage grew last
  T strength_share = 1.0;           ///< z there
  T normal_opening = 0.0;           ///< m, at the last evaluation, as the next five
  T shear_opening = 0.0;            ///< m, length
  T viscous_traction = 0.0;         ///< Pa
  T balance = 0.0;                  ///< Pa, traction that puts right what central differences gain or lose
  T gained = 0.0;                   ///< J/m2, what it has not put right yet
  T stored = 0.0;                   ///< J/m2
  std::array<T, 2> slip{0.0, 0.0};  ///< m, s along the two tangents
  T friction_weight = 0.0;
  T secant_normal = 1.0, secant_shear = 1.0;  ///< s_n, s_s
};

/// The one list of a point's numbers: calls f(JointNumber, the number in each of the points) for all of them.
/// @param points  any number of JointPointHistory, of different number types
template <class F, class... Points>
[[gnu::always_inline]] constexpr void for_each_number(F&& f, Points&... points) {
  using enum JointNumberUse;
  f(JointNumber{"damage", ""}, points.damage...);
  f(JointNumber{"level", ""}, points.level...);
  f(JointNumber{"strength_share", ""}, points.strength_share...);
  f(JointNumber{"normal_opening", "m"}, points.normal_opening...);
  f(JointNumber{"shear_opening", "m"}, points.shear_opening...);
  f(JointNumber{"viscous_traction", "Pa"}, points.viscous_traction...);
  f(JointNumber{"balance", "Pa"}, points.balance...);
  f(JointNumber{"gained", "J/m2"}, points.gained...);
  f(JointNumber{"stored", "J/m2", all, true}, points.stored...);
  f(JointNumber{"slip_1", "m", friction}, points.slip[0]...);
  f(JointNumber{"slip_2", "m", friction}, points.slip[1]...);
  f(JointNumber{"friction_weight", "", friction}, points.friction_weight...);
  f(JointNumber{"secant_normal", "", peaks}, points.secant_normal...);
  f(JointNumber{"secant_shear", "", peaks}, points.secant_shear...);
}

/// What a joint remembers: its points and what they have in common.
template <class T>
struct JointHistory {
  std::array<JointPointHistory<T>, 3> points;
  T area = 0.0;                                                 ///< m2, reference
  T mode_1 = 0.0, mode_2 = 0.0, friction = 0.0, viscous = 0.0;  ///< J dissipated so far
  T failed = 0.0;                                               ///< kHolding, kFailed or kFailsNext
  T hold = 1.0;  ///< share of its forces and energy that still acts: falls from 1 to 0 once the joint is a crack
};

inline constexpr double kHolding = 0, kFailed = 1;
inline constexpr double kFailsNext = -1;  ///< at the next evaluation, by hand

/// As for_each_number, for what the points of a joint have in common.
template <class F, class... Joints>
[[gnu::always_inline]] constexpr void for_each_common_number(F&& f, Joints&... joints) {
  f(JointNumber{"area", "m2"}, joints.area...);
  f(JointNumber{"mode_1", "J"}, joints.mode_1...);
  f(JointNumber{"mode_2", "J"}, joints.mode_2...);
  f(JointNumber{"friction", "J"}, joints.friction...);
  f(JointNumber{"viscous", "J"}, joints.viscous...);
  f(JointNumber{"failed", ""}, joints.failed...);
  f(JointNumber{"hold", ""}, joints.hold...);
}

}  // namespace breccia
