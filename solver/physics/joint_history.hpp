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

/// What a point remembers of its last evaluation, as a number, in ascending order of its life.
inline constexpr double kFresh = 0;        ///< nothing
inline constexpr double kUndivided = 1;    ///< an elastic opening without its parts along the normal
inline constexpr double kDivided = 2;      ///< all
inline constexpr double kWithoutHold = 3;  ///< all, and that no cohesion remained

/// What a point of a joint remembers, over the number type: double, a SIMD vector, or a row of numbers side by side.
template <class T>
struct JointPointHistory {
  T damage = 0.0;          ///< mixed_mode: d; independent_peaks: D. Set to 1 from outside it breaks the point by hand
  T level = 0.0;           ///< D at which the damage grew last
  T strength_share = 1.0;  ///< z there
  T memory = 0.0;          ///< kFresh .. kWithoutHold
  std::array<T, 3> opening{0.0, 0.0, 0.0};    ///< m, of the last evaluation, as all that follows
  std::array<T, 3> traction{0.0, 0.0, 0.0};   ///< Pa
  T normal_opening = 0.0;                     ///< m
  T normal_traction = 0.0;                    ///< Pa
  T stored_normal = 0.0, stored_shear = 0.0;  ///< J/m2; an elastic point holds all in stored_normal
  std::array<T, 2> slip{0.0, 0.0};            ///< m, s along the two tangents
  T friction_weight = 0.0;
  std::array<T, 2> friction_traction{0.0, 0.0};  ///< Pa, weighted, along the tangents
  T stored_friction = 0.0;                       ///< J/m2
  T secant_normal = 1.0, secant_shear = 1.0;     ///< s_n, s_s

  [[nodiscard]] T stored() const { return stored_normal + stored_shear + stored_friction; }
};

/// The one list of a point's numbers: calls f(JointNumber, the number in each of the points) for all of them.
/// @param points  any number of JointPointHistory, of different number types
template <class F, class... Points>
[[gnu::always_inline]] constexpr void for_each_number(F&& f, Points&... points) {
  using enum JointNumberUse;
  f(JointNumber{"damage", ""}, points.damage...);
  f(JointNumber{"level", ""}, points.level...);
  f(JointNumber{"strength_share", ""}, points.strength_share...);
  f(JointNumber{"memory", "", all, true}, points.memory...);
  f(JointNumber{"opening_x", "m", all, true}, points.opening[0]...);
  f(JointNumber{"opening_y", "m", all, true}, points.opening[1]...);
  f(JointNumber{"opening_z", "m", all, true}, points.opening[2]...);
  f(JointNumber{"traction_x", "Pa", all, true}, points.traction[0]...);
  f(JointNumber{"traction_y", "Pa", all, true}, points.traction[1]...);
  f(JointNumber{"traction_z", "Pa", all, true}, points.traction[2]...);
  f(JointNumber{"normal_opening", "m"}, points.normal_opening...);
  f(JointNumber{"normal_traction", "Pa"}, points.normal_traction...);
  f(JointNumber{"stored_normal", "J/m2", all, true}, points.stored_normal...);
  f(JointNumber{"stored_shear", "J/m2", all, true}, points.stored_shear...);
  f(JointNumber{"slip_1", "m", friction}, points.slip[0]...);
  f(JointNumber{"slip_2", "m", friction}, points.slip[1]...);
  f(JointNumber{"friction_weight", "", friction}, points.friction_weight...);
  f(JointNumber{"friction_traction_1", "Pa", friction}, points.friction_traction[0]...);
  f(JointNumber{"friction_traction_2", "Pa", friction}, points.friction_traction[1]...);
  f(JointNumber{"stored_friction", "J/m2", friction}, points.stored_friction...);
  f(JointNumber{"secant_normal", "", peaks}, points.secant_normal...);
  f(JointNumber{"secant_shear", "", peaks}, points.secant_shear...);
}

/// What a joint remembers: its points and what they have in common.
template <class T>
struct JointHistory {
  std::array<JointPointHistory<T>, 3> points;
  T area = 0.0;                                  ///< m2, reference
  T mode_1 = 0.0, mode_2 = 0.0, friction = 0.0;  ///< J dissipated so far
  T failed = 0.0;                                ///< 0 or 1
  // The last evaluation's moment of a closed joint that has slid, N, and normal; for its work.
  T turned = 0.0;  ///< 0 or 1
  std::array<T, 3> tilt{0.0, 0.0, 0.0}, normal{0.0, 0.0, 0.0};
};

/// As for_each_number, for what the points of a joint have in common.
template <class F, class... Joints>
[[gnu::always_inline]] constexpr void for_each_common_number(F&& f, Joints&... joints) {
  f(JointNumber{"area", "m2"}, joints.area...);
  f(JointNumber{"mode_1", "J"}, joints.mode_1...);
  f(JointNumber{"mode_2", "J"}, joints.mode_2...);
  f(JointNumber{"friction", "J"}, joints.friction...);
  f(JointNumber{"failed", ""}, joints.failed...);
  f(JointNumber{"turned", ""}, joints.turned...);
  f(JointNumber{"tilt_x", "N"}, joints.tilt[0]...);
  f(JointNumber{"tilt_y", "N"}, joints.tilt[1]...);
  f(JointNumber{"tilt_z", "N"}, joints.tilt[2]...);
  f(JointNumber{"normal_x", ""}, joints.normal[0]...);
  f(JointNumber{"normal_y", ""}, joints.normal[1]...);
  f(JointNumber{"normal_z", ""}, joints.normal[2]...);
}

}  // namespace breccia
