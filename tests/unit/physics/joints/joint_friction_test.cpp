#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "physics/joint_law.hpp"
#include "unit/physics/joints/point_driver.hpp"

namespace breccia::joint_friction_test {
namespace {

using test::axes;
using test::example_law;
using test::opening_of;
using test::PointDriver;
using test::prepared;

constexpr double kFriction = 0.6;
constexpr double kRoundOff = 1e-12;

JointLawParams mohr_coulomb(JointLaw kind, double factor = 10) {
  JointLawParams law = example_law();
  law.law = kind;
  law.stiffness *= factor;
  law.friction = kFriction;
  return prepared(law);
}

const JointLaw kLaws[]{JointLaw::mixed_mode, JointLaw::independent_peaks};

TEST(JointFriction, ShearUnderPressurePeaksAtMohrCoulombAndEndsAtCoulomb) {
  for (const JointLaw kind : kLaws) {
    for (const double factor : {1.0, 10.0, 100.0}) {
      const JointLawParams law = mohr_coulomb(kind, factor);
      for (const double pressure : {1e6, 5e6, 40e6}) {
        PointDriver point{law};
        const double closed = -pressure / law.stiffness;
        point.move_to(opening_of(axes(), closed, 0), 10);
        point.move_to(opening_of(axes(), closed, 40e-6), 40000);
        EXPECT_EQ(point.history.damage, 1.0);
        // 40,000 steps meet the peak to within one step of the rise.
        EXPECT_NEAR(point.peak_shear / (law.cohesion + kFriction * pressure), 1.0, 2e-2 * factor / 100 + 1e-3)
            << factor << ", " << pressure;
        EXPECT_LE(point.peak_shear, (law.cohesion + kFriction * pressure) * (1 + kRoundOff));
        EXPECT_NEAR(point.traction[0] / (kFriction * pressure), 1.0, kRoundOff);
      }
    }
  }
}

TEST(JointFriction, WorkUnderPressureIsFractureEnergyPlusFrictionTimesSlipPlusTheSpring) {
  for (const JointLaw kind : kLaws) {
    for (const double factor : {1.0, 10.0, 100.0}) {
      const JointLawParams law = mohr_coulomb(kind, factor);
      for (const double pressure : {0.0, 1e6, 5e6, 40e6}) {
        PointDriver point{law};
        const double closed = -pressure / law.stiffness, friction = kFriction * pressure;
        point.move_to(opening_of(axes(), closed, 0), 10);
        const double pressed = point.work;
        point.move_to(opening_of(axes(), closed, 40e-6), 40000);
        const double slip = 40e-6 - friction / law.stiffness;
        const double expected = law.energy_mode_2 + friction * slip + friction * friction / (2 * law.stiffness);
        EXPECT_NEAR((point.work - pressed) / expected, 1.0, 1e-3) << factor << ", " << pressure;
        // Each apart [Palmer and Rice 1973].
        EXPECT_NEAR(point.mode_2 / law.energy_mode_2, 1.0, 2e-3) << factor << ", " << pressure;
        EXPECT_NEAR(point.friction, friction * slip, 1e-3 * expected) << factor << ", " << pressure;
      }
    }
  }
}

TEST(JointFriction, UndamagedJointHasNone) {
  const JointLawParams law = mohr_coulomb(JointLaw::mixed_mode);
  PointDriver point{law};
  point.move_to(opening_of(axes(), -1e-7, 0), 5);
  point.move_to(opening_of(axes(), -1e-7, 0.9 * (law.cohesion / law.stiffness)), 50);
  point.move_to(opening_of(axes(), -1e-7, 0), 50);
  EXPECT_EQ(point.dissipated(), 0.0);
  EXPECT_NEAR(point.traction[0], 0.0, kRoundOff * law.cohesion);
}

TEST(JointFriction, OfTheStepThatStartsTheDamageIsThatOfTheShareThatIsLost) {
  // The slip that the first damage finds was not slid: it only parts what is lost.
  const JointLawParams law = mohr_coulomb(JointLaw::mixed_mode);
  PointDriver point{law};
  const double pressure = 5e6, closed = -pressure / law.stiffness;
  point.move_to(opening_of(axes(), closed, 0), 5);
  const double limit = (law.cohesion + kFriction * pressure) / law.stiffness;
  point.step(opening_of(axes(), closed, limit * (1 - 1e-6)));
  EXPECT_EQ(point.history.damage, 0.0);
  point.step(opening_of(axes(), closed, limit * 1.1));
  EXPECT_GT(point.history.damage, 0.0);
  const double spring = kFriction * pressure / law.stiffness;
  EXPECT_NEAR(point.friction / (point.friction + point.mode_2), 2 * spring / (1.1 * limit + spring), 1e-9);
  const double first = point.friction;
  point.step(opening_of(axes(), closed, limit * 1.2));
  EXPECT_GT(point.friction, first);
}

/// A point broken in shear under pressure.
PointDriver broken(const JointLawParams& law, double pressure) {
  PointDriver point{law};
  point.move_to(opening_of(axes(), -pressure / law.stiffness, 0), 10);
  point.move_to(opening_of(axes(), -pressure / law.stiffness, 40e-6), 4000);
  EXPECT_EQ(point.history.damage, 1.0);
  return point;
}

TEST(JointFriction, SticksWhenSlidingTurnsRoundAndSlidesBackAtCoulomb) {
  const JointLawParams law = mohr_coulomb(JointLaw::mixed_mode);
  const double pressure = 5e6, limit = kFriction * pressure, elastic = limit / law.stiffness;
  PointDriver point = broken(law, pressure);
  const double closed = point.opening[2];
  point.step(opening_of(axes(), closed, 40e-6 - elastic));
  EXPECT_NEAR(point.traction[0], 0.0, kRoundOff * limit);
  point.step(opening_of(axes(), closed, 40e-6 - 5 * elastic));
  EXPECT_NEAR(point.traction[0], -limit, kRoundOff * limit);
  // Slid back by 3 elastic lengths in that step: half of it with the spring on its way from 0 to -limit.
  const double before = point.friction;
  point.step(opening_of(axes(), closed, 40e-6 - 6 * elastic));
  EXPECT_NEAR(point.friction - before, limit * elastic, 1e-9 * limit * elastic);
}

TEST(JointFriction, TractionHasNoJumpThroughFailureSlidingAndParting) {
  for (const JointLaw kind : kLaws) {
    const JointLawParams law = mohr_coulomb(kind);
    PointDriver point{law};
    const double pressed = -5e6 / law.stiffness;
    const auto go = [&](double normal, double shear, int steps) {
      const Vec3 from = point.opening, target = opening_of(axes(), normal, shear);
      const double length = (target - from).norm() / steps;
      // Steepest of all branches: k (1 + mu) for pressure and friction, k for the rest.
      const double bound = 2 * law.stiffness * (1 + kFriction) * length;
      for (int i = 1; i <= steps; ++i) {
        const Vec3 before = point.traction;
        point.step(from + (target - from) * (static_cast<double>(i) / steps));
        ASSERT_LE((point.traction - before).norm(), bound) << "step " << i;
      }
    };
    go(pressed, 0, 100);
    go(pressed, 30e-6, 6000);
    ASSERT_EQ(point.history.damage, 1.0);
    EXPECT_GT(point.traction[0], 0.5 * kFriction * 5e6);
    go(1e-7, 31e-6, 2000);
    EXPECT_EQ(point.traction, Vec3(0, 0, 0));
    EXPECT_EQ(point.history.stored, 0.0);
    go(pressed, 32e-6, 2000);
    EXPECT_NEAR(point.traction[0], kFriction * 5e6, kRoundOff * 5e6);
  }
}

TEST(JointFriction, SpringThatIsLetGoOnOpeningIsDissipatedByFriction) {
  const JointLawParams law = mohr_coulomb(JointLaw::mixed_mode);
  PointDriver point = broken(law, 5e6);
  const double pressed = 0.5 * law.stiffness * point.opening[2] * point.opening[2];
  const double spring = point.history.stored - pressed, friction = point.friction;
  ASSERT_NEAR(spring, std::pow(kFriction * 5e6, 2) / (2 * law.stiffness), kRoundOff * spring);
  point.move_by_kink(opening_of(axes(), 1e-8, 40e-6), 20000);
  EXPECT_NEAR(point.friction - friction, spring, 1e-3 * spring);
}

TEST(JointFriction, TakesAllThatABrokenPointDissipates) {
  const JointLawParams law = mohr_coulomb(JointLaw::mixed_mode);
  PointDriver point = broken(law, 5e6);
  const double mode_1 = point.mode_1, mode_2 = point.mode_2, before = point.friction;
  // In coarse steps through closing and opening, where the trapezoid knows no mode.
  double last = before;
  for (int i = 0; i < 50; ++i) {
    point.step(opening_of(axes(), (i % 3 - 1) * 1.3e-8, 40e-6 + i * 1e-7));
    EXPECT_GE(point.friction, last);
    last = point.friction;
  }
  EXPECT_EQ(point.mode_1, mode_1);
  EXPECT_EQ(point.mode_2, mode_2);
  EXPECT_GT(point.friction, before);
}

TEST(JointFriction, RigidRotationOfTheJointChangesNothingButDirections) {
  const JointLawParams law = mohr_coulomb(JointLaw::mixed_mode);
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.6, 0, 0.8)}) {
    PointDriver point = broken(law, 5e6);
    const Vec3 opening = point.opening, traction = point.traction;
    const double dissipated = point.dissipated(), stored = point.history.stored;
    for (int i = 1; i <= 200; ++i) {
      const Mat3 turn = Eigen::AngleAxisd(0.03 * i, axis).toRotationMatrix();
      point.frame = {turn * Vec3(0, 0, 1), {turn * Vec3(1, 0, 0), turn * Vec3(0, 1, 0)}};
      point.step(turn * opening);
      ASSERT_LT((point.traction - turn * traction).norm(), 1e-9 * traction.norm()) << i;
    }
    EXPECT_NEAR(point.history.stored, stored, 1e-9 * stored);
    // About n tau turns with delta_s, to which it is parallel. About other axes the couple delta x t of pressure and
    // slip works.
    if (axis == Vec3(0, 0, 1)) {
      EXPECT_NEAR(point.dissipated(), dissipated, 1e-9 * dissipated);
    }
  }
}

}  // namespace
}  // namespace breccia::joint_friction_test
