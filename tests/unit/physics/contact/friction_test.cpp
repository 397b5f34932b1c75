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
    force = friction_force(n, {1e-3, 2e-3, 0.7}, 50, 100, xi);
    EXPECT_NEAR((force - Vec3(-0.05 * i, -0.1 * i, 0)).norm(), 0, kRoundOff);
  }
}

TEST(friction, slides_at_the_limit_against_the_motion) {
  Vec3 xi = Vec3::Zero();
  Vec3 force;
  for (int i = 0; i < 10; ++i) force = friction_force({0, 0, 1}, {0.3, 0.4, 0}, 1000, 7, xi);
  EXPECT_NEAR((force - Vec3(-4.2, -5.6, 0)).norm(), 0, 7 * kRoundOff);
  EXPECT_NEAR(xi.norm(), 7e-3, kRoundOff);
}

TEST(friction, vanishes_without_normal_force) {
  Vec3 xi(0.1, 0, 0);
  EXPECT_EQ(friction_force({0, 0, 1}, {1, 0, 0}, 1000, 0, xi), Vec3(0, 0, 0));
  EXPECT_EQ(xi, Vec3(0, 0, 0));
}

TEST(friction, the_spring_keeps_its_length_when_the_normal_turns) {
  Vec3 xi(0.1, 0, 0);
  const double angle = 0.3;
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  const Vec3 force = friction_force(normal, Vec3::Zero(), 1, 10, xi);
  EXPECT_NEAR(force.dot(normal), 0, kRoundOff);
  EXPECT_NEAR((xi - 0.1 * Vec3(std::cos(angle), 0, -std::sin(angle))).norm(), 0, kRoundOff);
}

}  // namespace
}  // namespace breccia
