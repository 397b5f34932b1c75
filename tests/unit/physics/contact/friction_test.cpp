#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "physics/contact/friction.hpp"

namespace breccia {
namespace {

constexpr double kRoundOff = 1e-14;

TEST(friction, sticks_with_a_linear_spring_below_the_limit) {
  Vec3 xi = Vec3::Zero();
  const Vec3 n(0, 0, 1);
  Vec3 force;
  for (int i = 1; i <= 5; ++i) {
    force = friction_step(n, {1e-3, 2e-3, 0.7}, 50, 100, xi).force;
    EXPECT_NEAR((force - Vec3(-0.05 * i, -0.1 * i, 0)).norm(), 0, kRoundOff);
  }
}

TEST(friction, slides_at_the_limit_against_the_motion) {
  Vec3 xi = Vec3::Zero();
  Vec3 force;
  for (int i = 0; i < 10; ++i) force = friction_step({0, 0, 1}, {0.3, 0.4, 0}, 1000, 7, xi).force;
  EXPECT_NEAR((force - Vec3(-4.2, -5.6, 0)).norm(), 0, 7 * kRoundOff);
  EXPECT_NEAR(xi.norm(), 7e-3, kRoundOff);
}

TEST(friction, vanishes_without_normal_force) {
  Vec3 xi(0.1, 0, 0);
  EXPECT_EQ(friction_step({0, 0, 1}, {1, 0, 0}, 1000, 0, xi).force, Vec3(0, 0, 0));
  EXPECT_EQ(xi, Vec3(0, 0, 0));
}

TEST(friction, the_spring_keeps_its_length_when_the_normal_turns) {
  Vec3 xi(0.1, 0, 0);
  const double angle = 0.3;
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  const Vec3 force = friction_step(normal, Vec3::Zero(), 1, 10, xi).force;
  EXPECT_NEAR(force.dot(normal), 0, kRoundOff);
  EXPECT_NEAR((xi - 0.1 * Vec3(std::cos(angle), 0, -std::sin(angle))).norm(), 0, kRoundOff);
}

TEST(friction, turns_its_spring_with_the_surfaces_and_keeps_its_length) {
  const Vec3 normal = Vec3(1, 2, -2) / 3, along = Vec3(2, 1, 2) / 3, across = normal.cross(along);
  Vec3 xi = 0.1 * along;
  constexpr int kSteps = 1000;
  const double angle = std::acos(-1.0) / 3;
  for (int i = 0; i < kSteps; ++i) turn_spring(normal, angle / kSteps, xi);
  const double short_by = std::pow(angle / kSteps, 2);  // of the angle, by Cayley's form
  EXPECT_NEAR((xi - 0.1 * (std::cos(angle) * along + std::sin(angle) * across)).norm(), 0, 0.1 * short_by);
  EXPECT_NEAR(xi.norm(), 0.1, kSteps * kRoundOff);
}

TEST(friction, dissipates_the_slip_and_nothing_while_it_sticks) {
  constexpr double kStiffness = 1000, kLimit = 7;
  Vec3 xi = Vec3::Zero();
  EXPECT_EQ(friction_step({0, 0, 1}, {0.006, 0, 0}, kStiffness, kLimit, xi).dissipated, 0);
  // To the limit at 7 mm, then on by 5 mm: the mean force of the step over the slip of 5 mm.
  const double expected = 0.5 * (6 + 7) * 0.005;
  EXPECT_NEAR(friction_step({0, 0, 1}, {0.006, 0, 0}, kStiffness, kLimit, xi).dissipated, expected, kRoundOff);
  // Sliding on at the limit: mu p times the way.
  EXPECT_NEAR(friction_step({0, 0, 1}, {0.02, 0, 0}, kStiffness, kLimit, xi).dissipated, kLimit * 0.02, kRoundOff);
}

TEST(friction, takes_nothing_back_when_normals_turn_motions_reverse_or_the_contact_ends) {
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

TEST(friction, that_turns_without_sliding_dissipates_nothing) {
  Vec3 xi(0.1, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 normal(std::sin(0.05 * i), 0, std::cos(0.05 * i));
    EXPECT_EQ(friction_step(normal, {0.001, 0.002, 0.003}, 1, 1e9, xi).dissipated, 0);
  }
}

TEST(friction, follows_a_normal_force_at_once_where_an_overlap_begins_and_later_with_a_delay) {
  constexpr double kStep = 0.1, kLongest = 0.4;  // s
  double followed = 0, delay = 0, age = 0;
  follow_normal_force(7, 0, kLongest, followed, delay);
  EXPECT_EQ(followed, 7) << "set down";
  follow_normal_force(5, kStep, kLongest, followed, delay);
  EXPECT_EQ(followed, 5);
  for (age = kStep; age < 2 * kLongest / kDelayOfAge; age += kStep)
    follow_normal_force(5, kStep, kLongest, followed, delay);
  EXPECT_EQ(delay, kLongest);
  EXPECT_NEAR(followed, 5, kRoundOff);
  follow_normal_force(9, kStep, kLongest, followed, delay);
  EXPECT_NEAR(followed, 5 + 4 * kStep / kLongest, kRoundOff);
  double mean = 0;
  constexpr int kPeriods = 400, kSteps = 8;
  for (int i = 0; i < kPeriods * kSteps; ++i) {
    follow_normal_force(9 + 6 * std::sin(2 * std::acos(-1.0) * i / kSteps), kStep, kLongest, followed, delay);
    mean += followed / (kPeriods * kSteps);
    if (i > kPeriods) EXPECT_LT(std::abs(followed - 9), 2.1) << "a third of the vibration";
  }
  EXPECT_NEAR(mean, 9, 0.01) << "all of the force";
}

TEST(friction, follows_at_once_where_no_delay_is_known) {
  double followed = 3, delay = 0;
  follow_normal_force(5, 0.1, 0, followed, delay);
  EXPECT_EQ(followed, 5);
}

/// Impulse of friction over that of the normal force of a half wave, by the number of steps that it lasts.
double rubbed_by_an_impact(int steps) {
  double followed = 0, delay = 0, rubbed = 0, pressed = 0;
  for (int i = 1; i < steps; ++i) {
    const double force = std::sin(std::acos(-1.0) * i / steps);
    follow_normal_force(force, 1.0, 1e9, followed, delay);
    rubbed += followed;
    pressed += force;
  }
  return rubbed / pressed;
}

TEST(friction, of_an_impact_is_that_of_coulombs_law_however_long_it_lasts) {
  for (const int steps : {2, 5, 20, 100, 1000}) EXPECT_NEAR(rubbed_by_an_impact(steps), 1, 0.02) << steps;
}

TEST(friction, lets_go_of_what_the_spring_holds) {
  const Vec3 xi(0.1, 0, 0);
  EXPECT_NEAR(released_by_friction(Vec3::Zero(), 50, xi), 0.25, kRoundOff);
}

}  // namespace
}  // namespace breccia
