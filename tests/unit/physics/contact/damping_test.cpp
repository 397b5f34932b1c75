#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "press.hpp"

/// Contact damping: on a lone tetrahedron that is pressed into the flat face of a body.
namespace breccia::damping_test {
namespace {

using test::Press;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kPenalty = 1e6, kDamping = 2e5, kRoundOff = 1e-9;  // Pa, Pa s/m
const double kArea = Press::area();                                 // m2, of the tetrahedron's base

const ContactLaw kDamped{kPenalty, kInfinite, 1, 0, 1, kDamping};

TEST(ContactDamping, AddsAStressPerSpeedOfApproachAndAccountsItsWork) {
  constexpr double depth = 0.05, step = 0.01;
  Press press(depth, kDamped);
  const double length = press.scene.contact.body_length[0];
  const double force = press.move(-step);
  EXPECT_NEAR(force, kArea * (kPenalty * (depth + step) / length + kDamping * step), kRoundOff * kPenalty);
  const double first = press.dissipated();
  EXPECT_NEAR(first, 0.5 * kArea * kDamping * step * step, kRoundOff * kPenalty) << "the force began in this step";
  press.move(-step);
  EXPECT_NEAR(press.dissipated() - first, kArea * kDamping * step * step, kRoundOff * kPenalty);
}

TEST(ContactDamping, PullsNoMoreThanItHasJustPushedAndNeverGivesEnergyBack) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> motion(-0.02, 0.02);
  Press press(0.05, kDamped);
  double z = 0, before = 0, pushed = 0;
  for (int i = 0; i < 400; ++i) {
    const double up = std::clamp(motion(random), -0.08 - z, 0.08 - z);
    z += up;
    const double force = press.move(up);
    ASSERT_GE(force, -pushed) << "step " << i;
    pushed = force < 0 ? pushed : force;  // a contact that has ended holds back what it has gained
    ASSERT_GE(press.dissipated(), before) << "step " << i;
    before = press.dissipated();
  }
  EXPECT_GT(before, 0.0);
}

TEST(ContactDamping, OfAnOscillationAccountsWhatItTakes) {
  // A mass on the contact, leapfrog: what its energy loses is what is accounted.
  constexpr double depth = 0.05, omega = 0.2, ratio = 0.2, few_percent = 0.03;
  const double length = Press(depth, kDamped).scene.contact.body_length[0], k = kArea * kPenalty / length;
  const double mass = k / (omega * omega);
  Press press(depth, {kPenalty, kInfinite, 1, 0, 1, 2 * ratio * std::sqrt(k * mass) / kArea});
  const double weight = k * depth;  // holds it at rest
  double v = -0.005, lost = 0;      // m/s at t - 1/2
  const double first = 0.5 * mass * v * v;
  for (int i = 0; i < 40; ++i) {
    const double force = press.move(v), before = v;
    v += (force - weight) / mass;
    lost = first - 0.5 * mass * 0.25 * (v + before) * (v + before);
  }
  const double deeper = press.scene.contact.touching.at(0).history.d * length - depth;
  const double held = 0.5 * k * deeper * deeper;
  EXPECT_NEAR(press.dissipated() / (lost - held), 1.0, few_percent);
}

TEST(ContactDamping, IsNothingWhereItIsOff) {
  Press press(0.05, {kPenalty, kInfinite, 1, 0, 1});
  press.move(-0.01);
  press.move(0.02);
  EXPECT_EQ(press.dissipated(), 0.0);
}

TEST(ContactPoints, AtCornersFeelARidgeAsSoonAsItTouches) {
  // A tetrahedron that stands on an edge, a micrometre deep in the floor and beside all of the floor's points.
  constexpr double depth = 1e-6;
  const double edge = std::sqrt(0.5);
  const Mesh ridge = test::lone({Vec3(1.8, 1.55, 4 - depth), Vec3(1.2, 1.55, 4 - depth), Vec3(1.5, 1.55 - edge, 4.5),
                                 Vec3(1.5, 1.55 + edge, 4.5)});
  for (const int points : {3, 4}) {
    test::Scene scene(test::joined(test::box({3, 3, 4}, 1.0), ridge), {kPenalty, kInfinite, 1, 0, 1}, points);
    scene.evaluate(0.0);
    EXPECT_EQ(scene.force_on(1)[2] > 0, points == 4) << points << " points a face";
  }
}

}  // namespace
}  // namespace breccia::damping_test
