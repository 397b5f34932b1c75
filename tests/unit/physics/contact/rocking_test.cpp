#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "press.hpp"

/// A point that stays on one face of a body while that rocks under it: the body's surface goes up and down and to and
/// fro and turns, by some thousandths in a step, each out of phase. The law has a potential, so nothing is to be put
/// right, however often.
namespace breccia {
namespace {

using test::Press;

constexpr double kInfinite = std::numeric_limits<double>::infinity(), kPenalty = 1e6;  // Pa
constexpr int kPeriod = 40, kPeriods = 100;                                            // steps a period
constexpr double kDepth = 0.02, kTurn = 0.03;                                          // m, rad

struct Rocking {
  Press press;
  Vec3 pivot;
  double done = 0;            // J, by contact
  double largest_change = 0;  // of the normal force, as a share of it

  explicit Rocking(const ContactLaw& law) : press(kDepth, law), pivot(1.537, 1.341, 4 - kDepth) {}

  /// The box is turned about the x axis through the pivot and shifted, from where it was first.
  void place(double turn, const Vec3& shift) {
    test::Scene& scene = press.scene;
    const Eigen::AngleAxisd rotation(turn, Vec3::UnitX());
    double work = 0;
    for (const Index n : scene.nodes_of(0)) {
      const Vec3 x = load_node(scene.state.position.data(), n);
      const Vec3 first = load_node(scene.local.reference.data(), n);
      const Vec3 to = pivot + rotation * (first - pivot) + shift;
      work += 0.5 * scene.forces.get(n).dot(to - x);
      store_node(scene.state.velocity.data(), n, to - x);  // dt = 1
      store_node(scene.state.position.data(), n, to);
    }
    scene.evaluate(1.0);
    for (const Index n : scene.nodes_of(0))
      work += 0.5 * scene.forces.get(n).dot(load_node(scene.state.velocity.data(), n));
    done += work;
    for (const TouchingCouple& couple : scene.contact.touching)
      largest_change = std::max(largest_change, std::abs(couple.balance));
  }
};

TEST(rocking, under_a_point_neither_takes_nor_gives_energy) {
  Rocking rocking({kPenalty, kInfinite, 1, 0, 1});
  const double held = rocking.press.scene.work.stored.value();
  ASSERT_GT(held, 0);
  for (int n = 1; n <= kPeriod * kPeriods; ++n) {
    const double phase = 2 * std::numbers::pi * n / kPeriod;
    rocking.place(kTurn * std::sin(phase), 0.4 * kDepth * Vec3(0, std::sin(phase - 0.9), std::sin(phase + 0.7)));
    ASSERT_EQ(rocking.press.scene.work.touching, 1) << n;
  }
  EXPECT_EQ(rocking.press.dissipated(), 0);
  EXPECT_LT(rocking.largest_change, 1e-9) << "the force is that of the law";
  EXPECT_EQ(rocking.press.scene.contact.touching.front().offset, 0);
  // After the first step the way is closed, a hundred times.
  EXPECT_NEAR(rocking.done + rocking.press.scene.work.stored.value(), held, 0.05 * held);
}

}  // namespace
}  // namespace breccia
