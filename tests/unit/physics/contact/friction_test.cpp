#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "base/types.hpp"
#include "physics/contact/law/coulomb.hpp"

namespace breccia::friction_test {
namespace {

constexpr double kRoundOff = 1e-14;

TEST(Friction, SticksWithALinearSpringBelowTheLimit) {
  Vec3 xi = Vec3::Zero();
  const Vec3 n(0, 0, 1);
  Vec3 force;
  for (int i = 1; i <= 5; ++i) {
    force = friction_step(n, {1e-3, 2e-3, 0.7}, 50, 100, xi).force;
    EXPECT_NEAR((force - Vec3(-0.05 * i, -0.1 * i, 0)).norm(), 0, kRoundOff);
  }
}

TEST(Friction, SlidesAtTheLimitAgainstTheMotion) {
  Vec3 xi = Vec3::Zero();
  Vec3 force;
  for (int i = 0; i < 10; ++i) force = friction_step({0, 0, 1}, {0.3, 0.4, 0}, 1000, 7, xi).force;
  EXPECT_NEAR((force - Vec3(-4.2, -5.6, 0)).norm(), 0, 7 * kRoundOff);
  EXPECT_NEAR(xi.norm(), 7e-3, kRoundOff);
}

TEST(Friction, VanishesWithoutNormalForce) {
  Vec3 xi(0.1, 0, 0);
  EXPECT_EQ(friction_step({0, 0, 1}, {1, 0, 0}, 1000, 0, xi).force, Vec3(0, 0, 0));
  EXPECT_EQ(xi, Vec3(0, 0, 0));
}

TEST(Friction, TheSpringKeepsItsLengthWhenTheNormalTurns) {
  Vec3 xi(0.1, 0, 0);
  const double angle = 0.3;
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  const Vec3 force = friction_step(normal, Vec3::Zero(), 1, 10, xi).force;
  EXPECT_NEAR(force.dot(normal), 0, kRoundOff);
  EXPECT_NEAR((xi - 0.1 * Vec3(std::cos(angle), 0, -std::sin(angle))).norm(), 0, kRoundOff);
}

TEST(Friction, TurnsItsSpringWithTheSurfacesAndKeepsItsLength) {
  const Vec3 normal = Vec3(1, 2, -2) / 3, along = Vec3(2, 1, 2) / 3, across = normal.cross(along);
  Vec3 xi = 0.1 * along;
  constexpr int kSteps = 1000;
  const double angle = std::acos(-1.0) / 3;
  for (int i = 0; i < kSteps; ++i) turn_spring(normal, angle / kSteps, xi);
  const double short_by = std::pow(angle / kSteps, 2);  // of the angle, by Cayley's form
  EXPECT_NEAR((xi - 0.1 * (std::cos(angle) * along + std::sin(angle) * across)).norm(), 0, 0.1 * short_by);
  EXPECT_NEAR(xi.norm(), 0.1, kSteps * kRoundOff);
}

TEST(Friction, DissipatesTheSlipAndNothingWhileItSticks) {
  constexpr double kStiffness = 1000, kLimit = 7;
  Vec3 xi = Vec3::Zero();
  EXPECT_EQ(friction_step({0, 0, 1}, {0.006, 0, 0}, kStiffness, kLimit, xi).dissipated, 0);
  // To the limit at 7 mm, then on by 5 mm: the mean force of the step over the slip of 5 mm.
  const double expected = 0.5 * (6 + 7) * 0.005;
  EXPECT_NEAR(friction_step({0, 0, 1}, {0.006, 0, 0}, kStiffness, kLimit, xi).dissipated, expected, kRoundOff);
  // Sliding on at the limit: mu p times the way.
  EXPECT_NEAR(friction_step({0, 0, 1}, {0.02, 0, 0}, kStiffness, kLimit, xi).dissipated, kLimit * 0.02, kRoundOff);
}

TEST(Friction, TakesNothingBackWhenNormalsTurnMotionsReverseOrTheContactEnds) {
  constexpr double kStiffness = 50;
  Vec3 xi = Vec3::Zero();
  for (int i = 0; i < 1000; ++i) {
    const double a = 0.7 * i, b = 1.3 * i;
    const Vec3 normal(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    const Vec3 motion = 0.1 * Vec3(std::cos(3.1 * i), std::sin(2.3 * i), std::cos(1.7 * i));
    const double limit = 2.0 + 2.0 * std::sin(0.9 * i), held = 0.5 * kStiffness * xi.squaredNorm();
    const double dissipated = friction_step(normal, motion, kStiffness, limit, xi).dissipated;
    EXPECT_GE(dissipated, 0);
    // No more than the motion can have put in beside what was held.
    EXPECT_LE(dissipated, held + 0.5 * kStiffness * (std::sqrt(2 * held / kStiffness) + 0.2) * 0.2);
    EXPECT_GE(released_by_friction(motion, kStiffness, xi), 0);
  }
}

TEST(Friction, ThatTurnsWithoutSlidingDissipatesNothing) {
  Vec3 xi(0.1, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 normal(std::sin(0.05 * i), 0, std::cos(0.05 * i));
    EXPECT_EQ(friction_step(normal, {0.001, 0.002, 0.003}, 1, 1e9, xi).dissipated, 0);
  }
}

TEST(Friction, FollowsANormalForceAtOnceWhereAnOverlapBeginsAndLaterWithADelay) {
  constexpr double kStep = 0.1, kLongest = 0.4;  // s
  DelayedForce delayed;
  follow_normal_force(7, 0, kLongest, delayed);
  EXPECT_EQ(delayed.force, 7) << "set down";
  for (const double force : {5, 6, 3}) {
    follow_normal_force(force, kStep, kLongest, delayed);
    EXPECT_EQ(delayed.force, force);
  }
  for (double age = 0; age < 2 * kSteadyAge * kLongest; age += kStep) follow_normal_force(5, kStep, kLongest, delayed);
  EXPECT_EQ(delayed.age, kSteadyAge * kLongest) << "no older than what counts";
  EXPECT_NEAR(delayed.force, 5, 1e-3);
  const double before = delayed.force;
  follow_normal_force(9, kStep, kLongest, delayed);
  EXPECT_NEAR(delayed.force, before + (9 - before) * kStep / kLongest, kRoundOff);
}

TEST(Friction, OfAnOldOverlapFollowsTheMeanOfANormalForceThatVibrates) {
  constexpr double kStep = 0.1, kLongest = 0.4;  // s
  constexpr int kPeriods = 400, kSteps = 8;
  DelayedForce delayed{9, kSteadyAge * kLongest, 9};
  double mean = 0;
  for (int i = 0; i < kPeriods * kSteps; ++i) {
    follow_normal_force(9 + 6 * std::sin(2 * std::acos(-1.0) * i / kSteps), kStep, kLongest, delayed);
    mean += delayed.force / (kPeriods * kSteps);
    EXPECT_TRUE(i < kPeriods || std::abs(delayed.force - 9) < 0.47 * 6)
        << "(a / |exp(i 2 pi / 8) - (1 - a)|)^2, a = 1/2";
  }
  EXPECT_NEAR(mean, 9, 0.01);
}

TEST(Friction, HardlyFeedsVibrations) {
  constexpr double kLongest = 1, kOmega = 12;  // s, 1/s
  constexpr int kPeriods = 50, kSteps = 1000;
  const double step = 2 * std::acos(-1.0) / (kOmega * kSteps);
  DelayedForce delayed{9, kSteadyAge * kLongest, 9};
  double behind = 0;  // part of its vibration that is a quarter of a period behind that of the normal force
  for (int i = 1; i <= kPeriods * kSteps; ++i) {
    const double phase = kOmega * step * i;
    follow_normal_force(9 + 6 * std::sin(phase), step, kLongest, delayed);
    if (i > kPeriods / 2 * kSteps) behind -= delayed.force * std::cos(phase) / (6 * kPeriods / 4.0 * kSteps);
  }
  const double half = 0.5 * kOmega * kLongest;
  EXPECT_NEAR(behind, 2 * half / std::pow(1 + half * half, 2), 2e-4) << "one stage alone: 1 / 12";
}

TEST(Friction, OfContactsThatLiftOffAgainAndAgainHasTheImpulseOfCoulombsLaw) {
  constexpr double kStep = 0.1, kLongest = 2;  // s
  DelayedForce delayed;
  double rubbed = 0, pressed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double force = 0.5 + std::sin(0.31 * i);
    if (force > 0) {
      follow_normal_force(force, kStep, kLongest, delayed);
      rubbed += delayed.force;
      pressed += force;
    } else {
      delayed = without_overlap(kStep, delayed);
    }
  }
  EXPECT_NEAR(rubbed / pressed, 1, 0.005);
  EXPECT_GT(delayed.age, 13 * kLongest) << "old, though no overlap lasts for one delay";
}

TEST(Friction, ForgetsAContactThatDoesNotComeAgain) {
  DelayedForce delayed{7, 3};
  for (int i = 0; i < 10; ++i) delayed = without_overlap(0.31, delayed);
  EXPECT_EQ(delayed.force, 0);
  EXPECT_EQ(delayed.age, 0);
}

TEST(Friction, FollowsAtOnceWhereNoDelayIsKnown) {
  DelayedForce delayed{3, 0};
  follow_normal_force(5, 0.1, 0, delayed);
  EXPECT_EQ(delayed.force, 5);
  EXPECT_EQ(delayed.age, 0);
}

TEST(Friction, OfAnImpactIsThatOfCoulombsLaw) {
  constexpr int kSteps = 1000;
  for (const auto& [delays, more] : {std::pair{0.3, 0.0015}, {1.0, 0.005}, {4.0, 0.02}}) {
    DelayedForce delayed;
    double rubbed = 0, pressed = 0;
    for (int i = 1; i < kSteps; ++i) {
      const double force = std::sin(std::acos(-1.0) * i / kSteps);
      follow_normal_force(force, delays / kSteps, 1, delayed);
      rubbed += delayed.force;
      pressed += force;
    }
    EXPECT_NEAR(rubbed / pressed, 1, more) << delays;
  }
}

TEST(Friction, LetsGoOfWhatTheSpringHolds) {
  const Vec3 xi(0.1, 0, 0);
  EXPECT_NEAR(released_by_friction(Vec3::Zero(), 50, xi), 0.25, kRoundOff);
}

}  // namespace
}  // namespace breccia::friction_test
