#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "physics/joint_law.hpp"

namespace breccia::test {

/// The joint of thesis table 3.1: p = E = 26.6 GPa, h = edge = 20 mm.
inline constexpr double kPenalty = 26.6e9, kEdge = 0.02, kStrength = 5e6, kEnergy = 30.0291;

/// Without viscosity, so that its tractions are the law's own.
inline JointLawParams example_law() {
  JointLawParams law;
  law.viscosity = 0;
  law.stiffness = kPenalty / kEdge;
  law.tensile_strength = law.cohesion = kStrength;
  law.energy_mode_1 = law.energy_mode_2 = kEnergy;
  return law;
}

/// @return law with its derived numbers
inline JointLawParams prepared(JointLawParams law) {
  const std::string problem = prepare(law);
  EXPECT_EQ(problem, "");
  return law;
}

/// The published law with energies of the softening branch.
inline JointLawParams reference_law(JointRise rise) {
  JointLawParams law = example_law();
  law.law = JointLaw::independent_peaks;
  law.rise = rise;
  law.energy_of_whole_curve = false;
  return prepared(law);
}

inline JointFrame axes() { return {Vec3(0, 0, 1), {Vec3(1, 0, 0), Vec3(0, 1, 0)}}; }

/// Opening from its normal part and one along the first tangent.
inline Vec3 opening_of(const JointFrame& frame, double normal, double shear) {
  return normal * frame.normal + shear * frame.tangent[0];
}

/// Leads one point along a path and adds up the work done on it, J/m2, by the trapezoid rule, apart from what the law
/// accounts for.
struct PointDriver {
  const JointLawParams& law;
  JointFrame frame = axes();
  JointPointHistory<double> history{};
  Vec3 opening{0, 0, 0}, traction{0, 0, 0};
  double work = 0, mode_1 = 0, mode_2 = 0, friction = 0, viscous = 0;
  double peak_normal = 0, peak_shear = 0;

  void step(const Vec3& next) {
    const JointPointResponse r = evaluate_point(law, frame, next, history);
    work += 0.5 * (traction + r.traction).dot(next - opening);
    mode_1 += r.mode_1;
    mode_2 += r.mode_2;
    friction += r.friction;
    viscous += r.viscous;
    opening = next;
    traction = r.traction;
    const double normal = traction.dot(frame.normal);
    peak_normal = std::max(peak_normal, normal);
    peak_shear = std::max(peak_shear, (traction - normal * frame.normal).norm());
  }
  /// Along a straight line in equal steps.
  void move_to(const Vec3& target, int steps) {
    const Vec3 from = opening;
    for (int i = 1; i <= steps; ++i) step(from + (target - from) * (static_cast<double>(i) / steps));
  }
  /// As move_to, with a step ending exactly where the point closes or opens: the traction has a kink there.
  void move_by_kink(const Vec3& target, int steps) {
    const double now = opening.dot(frame.normal), then = target.dot(frame.normal);
    if (now * then < 0) {
      Vec3 touching = opening + (target - opening) * (now / (now - then));
      touching -= touching.dot(frame.normal) * frame.normal;
      move_to(touching, steps);
    }
    move_to(target, steps);
  }
  [[nodiscard]] double dissipated() const { return mode_1 + mode_2 + friction + viscous; }
};

}  // namespace breccia::test
