#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "scene.hpp"

/// A small tetrahedron that moves through a large one with steps of constant length: the overlap is the distance to the
/// nearest of four faces, and its gradient turns where another face becomes the nearest.
namespace breccia::kink_test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kPenalty = 1e6;
constexpr double kLarge = 1, kSmall = 1e-3, kStep = 0.01;  // m: edges, and motion in a step

struct Way {
  test::Scene scene;
  double stiffness;            // N/m, of the point that is coupled
  double done = 0;             // J, by the force on the small one
  double gain = 0, least = 0;  // J, that came from nowhere, at most; lowest of what was held and done
  bool touched = false;
  Vec3 force = Vec3::Zero();

  explicit Way(const Vec3& from, double damping = 0)
      : scene(
            test::joined(test::lone(test::regular_tetra(kLarge)),
                         test::moved(test::lone(test::regular_tetra(kSmall)), [&](const Vec3& x) { return x + from; })),
            {kPenalty, kInfinite, 1, 0, 1, damping}) {
    scene.couple([&](Index s) { return scene.body(s) == 1; }, [&](Index s) { return scene.body(s) == 0; });
    stiffness = scene.contact.points.back().weight * kPenalty / scene.contact.body_length[0];
  }

  void move(const Vec3& by) {
    scene.shift(1, by);
    scene.set_velocity(1, by);  // dt = 1
    scene.evaluate(1.0);
    const Vec3 before = force;
    force = scene.force_on(1);
    done += 0.5 * (before + force).dot(by);
    touched = touched || scene.work.touching > 0;
    const double made = done + scene.work.stored.value() + scene.work.dissipated.value();
    least = std::min(least, made);
    gain = std::max(gain, made - least);
  }
};

TEST(KinksOfTheOverlap, GiveNoEnergyToAPointThatPassesThemOnAnyWay) {
  // Where the force begins, ends or turns, central differences leave over a share of this at most.
  constexpr double kOfStep = 2.0;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  const Vec3 middle(-0.25 * kLarge * std::sqrt(2.0 / 3.0), 0, 0);
  int touched = 0;
  for (int way = 0; way < 200; ++way) {
    const Vec3 direction = Vec3(number(random), number(random), number(random)).normalized();
    const Vec3 beside = 0.15 * kLarge * Vec3(number(random), number(random), number(random));
    Way point(middle + beside - 1.2 * kLarge * direction);
    for (int i = 0; i < 240; ++i) point.move(kStep * direction);
    touched += point.touched ? 1 : 0;
    EXPECT_LT(point.gain, kOfStep * point.stiffness * kStep * kStep) << "way " << way;
  }
  EXPECT_GT(touched, 150);
}

TEST(KinksOfTheOverlap, TakeOfADampedPointWhatIsDissipated) {
  constexpr double kDamping = 1e7;  // Pa s/m
  constexpr double kShare = 0.005;  // of what is dissipated: 0.002, and 0.012 with the present gradient for both forces
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  const Vec3 middle(-0.25 * kLarge * std::sqrt(2.0 / 3.0), 0, 0);
  double unaccounted = 0, dissipated = 0;
  for (int way = 0; way < 100; ++way) {
    const Vec3 direction = Vec3(number(random), number(random), number(random)).normalized();
    const Vec3 beside = 0.15 * kLarge * Vec3(number(random), number(random), number(random));
    Way point(middle + beside - 1.2 * kLarge * direction, kDamping);
    for (int i = 0; i < 300; ++i) point.move(kStep * direction);
    EXPECT_EQ(point.scene.work.stored.value(), 0.0);
    unaccounted += std::abs(point.done + point.scene.work.dissipated.value());
    dissipated += point.scene.work.dissipated.value();
  }
  EXPECT_GT(dissipated, 0.0);
  EXPECT_LT(unaccounted / dissipated, kShare);
}

}  // namespace
}  // namespace breccia::kink_test
