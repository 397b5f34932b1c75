#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "press.hpp"

/// A point that stays on one face of a body while that rocks under it: the body's surface goes up and down and to and
/// fro and turns, by some thousandths in a step, each out of phase. The law has a potential, so nothing is to be put
/// right, however often.
namespace breccia::rocking_test {
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
      largest_change = std::max(largest_change, std::abs(couple.history.balance));
  }
};

TEST(Rocking, UnderAPointNeitherTakesNorGivesEnergy) {
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
  EXPECT_EQ(rocking.press.scene.contact.touching.front().history.offset, 0);
  // After the first step the way is closed, a hundred times.
  EXPECT_NEAR(rocking.done + rocking.press.scene.work.stored.value(), held, 0.05 * held);
}

/// Moves a body of a scene by a map within a step of 1 s.
void move(test::Scene& scene, Index body, const std::function<Vec3(const Vec3&)>& map) {
  scene.set_velocity(0, Vec3::Zero());
  scene.set_velocity(1, Vec3::Zero());
  for (const Index n : scene.nodes_of(body)) {
    const Vec3 x = load_node(scene.state.position.data(), n), to = map(x);
    store_node(scene.state.velocity.data(), n, to - x);
    store_node(scene.state.position.data(), n, to);
  }
  scene.evaluate(1.0);
}

TEST(Rocking, KeepsTheSideThatAPointPressesOnThoughItNoLongerFacesThePoint) {
  constexpr double size = 1e-3, side = 0.02;  // m, of the face with the point; rad by which the side looks up at first
  const auto turn = [](double angle) {
    return [angle](const Vec3& x) -> Vec3 {
      const Vec3 pivot(1, 0.5, 0);
      return pivot + Eigen::AngleAxisd(angle, -Vec3::UnitY()) * (x - pivot);
    };
  };
  const Mesh box = test::moved(test::wall(1, 1.0), turn(side));
  const Vec3 place(1.005, 0.5, 0.005);  // beside the side at x = 1, above that at z = 0
  const Mesh tetra = test::lone({place, place + Vec3(size, 0, 0), place + Vec3(0, size, 0), place + Vec3(0, 0, size)});
  test::Scene scene(test::joined(box, tetra), {kPenalty, kInfinite, 1, 0, 1});
  constexpr int down = 3;  // face of the tetrahedron
  std::erase_if(scene.contact.couples, [&](const ContactCouple& couple) {
    const ContactPoint& point = scene.contact.points[at(couple.point)];
    return scene.body(point.slot) == 0 || point.face != down;
  });
  couples_replaced(scene.contact);
  const auto shift = [&](const Vec3& by) { move(scene, 1, [&](const Vec3& x) -> Vec3 { return x + by; }); };
  for (int n = 0; n < 25; ++n) shift({-0.001, 0, 0});
  for (int n = 0; n < 6; ++n) shift({0, 0, -0.001});
  const double held = scene.work.stored.value(), lost = scene.work.dissipated.value();
  ASSERT_GT(held, 0);
  move(scene, 0, turn(-0.75 * side));
  EXPECT_GT(scene.work.stored.value(), 0.5 * held) << "all sides face away";
  EXPECT_EQ(scene.work.dissipated.value(), lost);
}

/// Points at the lower edges of the upper body look at a side of the lower one that is far away.
TEST(Standing, BodiesTouchWithoutForceAtFirstAlsoWhereTheyOverlapByRoundOff) {
  constexpr double overlap = 0.5 * kOverlapTolerance;
  const Mesh lower = test::wall(1, 1.0), upper = test::box({1, 1, 1}, 0.5);
  const double length = mean_inradii(lower)[0];
  for (const double angle : {-0.2, 0.0, 0.2}) {
    for (const double deep : {-1e-15, 0.0, 1e-15, overlap * length}) {
      const Mesh stack = test::joined(lower, test::moved(upper, [&](const Vec3& x) -> Vec3 {
                                        return Eigen::AngleAxisd(angle, Vec3::UnitZ()) * x + Vec3(-0.3, 0.3, 1 - deep);
                                      }));
      test::Scene scene(stack, {kPenalty, kInfinite, 1, 0, 1}, 4);
      scene.evaluate(1e-3);
      const double most = kPenalty * 0.25 * 4 * overlap;  // both sides, N
      EXPECT_LE(scene.force_on(1).norm(), most) << angle << " " << deep;
      EXPECT_LE(scene.work.stored.value(), most * overlap * length) << angle << " " << deep;
    }
  }
}

}  // namespace
}  // namespace breccia::rocking_test
