#include "commands/joint_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace breccia::joint_curves_test {
namespace {

constexpr double kPolygon = 0.005;  // relative error of an area from so many straight pieces

JointLawParams law() {
  JointLawParams p;
  p.stiffness = 1e14;
  p.tensile_strength = 5e6;
  p.cohesion = 12e6;
  p.friction = 0.6;
  p.energy_mode_1 = 30;
  p.energy_mode_2 = 90;
  EXPECT_EQ(prepare(p), "");
  return p;
}

double area(const JointCurve& c) {
  double sum = 0;
  for (std::size_t i = 1; i < c.opening.size(); ++i)
    sum += 0.5 * (c.traction[i] + c.traction[i - 1]) * (c.opening[i] - c.opening[i - 1]);
  return sum;
}

TEST(JointCurves, TheAreaUnderACurveIsTheFractureEnergy) {
  const JointLawCurves curves = joint_law_curves(law());
  EXPECT_NEAR(area(curves.normal), 30, 30 * kPolygon);
  EXPECT_NEAR(area(curves.shear), 90, 90 * kPolygon);
}

TEST(JointCurves, CurvesRiseToTheStrengthAndEndAtZero) {
  const JointLawCurves curves = joint_law_curves(law());
  EXPECT_NEAR(*std::max_element(curves.normal.traction.begin(), curves.normal.traction.end()), 5e6, 1);
  EXPECT_NEAR(*std::max_element(curves.shear.traction.begin(), curves.shear.traction.end()), 12e6, 1);
  EXPECT_NEAR(curves.normal.traction.back(), 0, 1);
  EXPECT_NEAR(curves.shear.traction.back(), 0, 1);
}

TEST(JointCurves, UnloadingGoesToTheOriginAndBackOnTheSameLine) {
  const JointCurve loop = joint_law_curves(law()).unloading;
  const std::size_t half = loop.opening.size() / 2;
  const double slope = loop.traction.front() / loop.opening.front();
  for (std::size_t i = 0; i < 2 * half; ++i)
    EXPECT_NEAR(loop.traction[i], slope * loop.opening[i], 1e-9 * loop.traction.front()) << i;
  EXPECT_LT(slope, 0.1e14);
}

TEST(JointCurves, TheEnvelopeIsAnEllipseInTensionAndMohrCoulombUnderPressure) {
  constexpr double kScan = 0.01;  // the path to a strength has so many points
  const JointLawCurves curves = joint_law_curves(law());
  ASSERT_EQ(curves.envelope_normal.size(), curves.envelope_shear.size());
  for (std::size_t i = 0; i < curves.envelope_normal.size(); ++i) {
    const double normal = curves.envelope_normal[i], shear = curves.envelope_shear[i];
    if (normal < -1) {
      EXPECT_NEAR(shear, 12e6 - 0.6 * normal, kScan * 12e6) << normal;
    } else {
      EXPECT_NEAR(std::hypot(normal / 5e6, shear / 12e6), 1, kScan) << normal;
    }
  }
}

}  // namespace
}  // namespace breccia::joint_curves_test
