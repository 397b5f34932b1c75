#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "scene.hpp"

/// A block that cannot turn (its nodes move together) on a plane: Coulomb's closed forms.
namespace breccia::friction_block_test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kGravity = 9.81, kPenalty = 1e10, kSize = 0.4, kDensity = 2000;

class Block {
 public:
  /// @param slope  rad; gravity is turned, the plane stays z = 1
  Block(double mu, double slope)
      : scene_(test::joined(floor(), block()), {kPenalty, kInfinite, 1, mu, 1}, 3, OverlapField::body,
               Discretisation::own_nodes, kDensity),
        gravity_(kGravity * std::sin(slope), 0, -kGravity * std::cos(slope)) {
    for (const Index n : scene_.nodes_of(1)) mass_ += scene_.local.node_mass[at(n)];
    const double area = std::sqrt(3.0) / 4 * kSize * kSize, length = scene_.contact.body_length[0];
    stiffness_ = kPenalty * area / length;
    scene_.shift(1, {0, 0, mass_ * gravity_[2] / stiffness_});  // rests at once
    dt_ = 0.05 * std::sqrt(mass_ / stiffness_);
  }

  /// One large tetrahedron, its upper face in z = 1: the overlap is the depth.
  static Mesh floor() {
    return test::moved(test::lone(test::regular_tetra(20)), [](const Vec3& x) { return Vec3(-x[2], x[1], 1 + x[0]); });
  }
  static Mesh block() {
    return test::moved(test::lone(test::regular_tetra(kSize)),
                       [](const Vec3& x) { return Vec3(x[2], x[1], 1 - x[0]); });
  }

  /// Advances by a time; the velocity belongs to the middle of the step.
  void run(double time) {
    for (double t = 0; t < time; t += dt_) {
      scene_.evaluate(dt_);
      const Vec3 force = scene_.force_on(1);
      velocity_ += dt_ * (force / mass_ + gravity_);
      scene_.set_velocity(1, velocity_);
      scene_.shift(1, dt_ * velocity_);
      path_ += dt_ * velocity_;
    }
  }
  void push(double speed) {
    velocity_[0] = speed;
    scene_.set_velocity(1, velocity_);
  }

  [[nodiscard]] const Vec3& velocity() const { return velocity_; }
  [[nodiscard]] const Vec3& path() const { return path_; }
  [[nodiscard]] double mass() const { return mass_; }
  /// Elongation of the springs at the limit, m: the block comes to rest within it.
  [[nodiscard]] double spring(double mu) const { return mu * mass_ * kGravity / stiffness_; }
  [[nodiscard]] const ContactWork& work() const { return scene_.work; }

 private:
  test::Scene scene_;
  Vec3 gravity_, velocity_ = Vec3::Zero(), path_ = Vec3::Zero();
  double mass_ = 0, stiffness_ = 0, dt_ = 0;
};

TEST(FrictionBlock, StopsAfterVSquaredOverTwoMuG) {
  constexpr double mu = 0.3, speed = 2.5;
  Block block(mu, 0);
  block.push(speed);
  block.run(1.5 * speed / (mu * kGravity));
  const double distance = speed * speed / (2 * mu * kGravity);
  EXPECT_NEAR(block.path()[0] / distance, 1, 0.01);
  EXPECT_NEAR(block.path()[2], 0, 1e-6);
  // What is not dissipated swings on in the springs, which nothing damps.
  const double kinetic = 0.5 * block.mass() * speed * speed, left = 0.5 * block.mass() * block.velocity().squaredNorm();
  EXPECT_NEAR((block.work().friction_dissipated.value() + block.work().friction_stored.value() + left) / kinetic, 1,
              0.01);
}

TEST(FrictionBlock, SticksBelowTheAngleOfFriction) {
  constexpr double mu = 0.4;
  Block gentle(mu, std::atan(0.45 * mu));
  gentle.run(1);
  EXPECT_LT(std::abs(gentle.path()[0]), gentle.spring(mu))
      << "swings to twice the static elongation, 0.45 of the limit";
  EXPECT_LT(gentle.work().friction_dissipated.value(), 1e-9 * gentle.mass()) << "no slip";

  Block steep(mu, std::atan(0.95 * mu));
  steep.run(1);
  const double after_settling = steep.path()[0];
  steep.run(1);
  EXPECT_LT(std::abs(steep.path()[0] - after_settling), 2 * steep.spring(mu));
}

TEST(FrictionBlock, SlidesAboveTheAngleOfFrictionWithTheAccelerationLeftOver) {
  constexpr double mu = 0.4, time = 0.8;
  const double slope = 1.5 * std::atan(mu);
  Block block(mu, slope);
  block.run(time);
  const double acceleration = kGravity * (std::sin(slope) - mu * std::cos(slope));
  EXPECT_NEAR(block.path()[0] / (0.5 * acceleration * time * time), 1, 0.01);
}

TEST(FrictionBlock, ThatSticksToATurningFloorIsHeldAsOnOneAtRest) {
  constexpr double kDepth = 1e-3, kPushed = 1e-4, kMu = 0.4, kStep = 1e-3;
  test::Scene scene(test::joined(Block::floor(), Block::block()), {kPenalty, kInfinite, 1, kMu, 1});
  scene.shift(1, {kPushed, 0, -kDepth});
  scene.set_velocity(1, {kPushed / kStep, 0, -kDepth / kStep});
  scene.evaluate(kStep);
  const Vec3 held = scene.force_on(1);
  ASSERT_LT(held[0], 0);
  ASSERT_LT(-held[0], kMu * held[2]) << "sticks";

  // Both turn about the z axis as one rigid body, faster and faster, by a right angle in all.
  constexpr int kSteps = 200;
  const double first = 0.5 * std::acos(-1.0) / (kSteps * kSteps), last = (2 * kSteps - 1) * first;
  for (int i = 0; i < kSteps; ++i) {
    const Mat3 turn = Eigen::AngleAxisd((2 * i + 1) * first, Vec3::UnitZ()).toRotationMatrix();
    for (Index n = 0; n < scene.local.num_nodes; ++n) {
      const Vec3 before = load_node(scene.state.position.data(), n), after = turn * before;
      store_node(scene.state.position.data(), n, after);
      store_node(scene.state.velocity.data(), n, (after - before) / kStep);
    }
    scene.evaluate(kStep);
  }
  const Vec3 expected(-held[1], held[0], held[2]);
  const double tolerance = last;  // a step's motion leads along its chord
  EXPECT_NEAR((scene.force_on(1) - expected).norm(), 0, tolerance * std::abs(held[0]));
  EXPECT_EQ(scene.work.friction_dissipated.value(), 0);
}

/// Two elements of one body and different groups, glued by their nodes, and a small body inside the first of them.
Mesh two_groups_and_a_grain() {
  Mesh pair = test::lone({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  pair.nodes.push_back(Vec3(1, 1, 1));
  pair.elements.push_back({1, 2, 3, 4});
  pair.element_group.push_back(1);
  pair.element_body.push_back(0);
  pair.element_source_id.push_back(2);
  pair.volume_groups = {"first", "second"};
  constexpr double kGrain = 0.05;
  return test::joined(pair, test::lone({Vec3(0.2, 0.2, 0.2), Vec3(0.2 + kGrain, 0.2, 0.2), Vec3(0.2, 0.2 + kGrain, 0.2),
                                        Vec3(0.2, 0.2, 0.2 + kGrain)}));
}

TEST(Friction, ASpringThatLetsGoInAnotherGroupGivesBackWhatItHeldUnderItsOwnLaw) {
  constexpr double kSoft = 1e6, kStep = 1e-3;
  test::Scene scene(two_groups_and_a_grain(), {kSoft, std::numeric_limits<double>::infinity(), 1, 1.0, 1});
  const Index grain = 1;
  scene.params.laws[2 * 3 + 1].penalty = 10 * kSoft;  // of the grain's points against the second group
  scene.couple([&](Index slot) { return scene.body(slot) == grain; },
               [&](Index slot) { return scene.body(slot) != grain; });
  scene.evaluate(kStep);
  scene.set_velocity(grain, Vec3(1e-3, -2e-3, 1e-3));
  scene.evaluate(kStep);
  const double held = scene.work.friction_stored.value(), lost = scene.work.friction_dissipated.value();
  ASSERT_GT(held, 0.0);

  // The grain stands in the second element, whose field goes down to nothing meanwhile.
  scene.set_velocity(grain, Vec3::Zero());
  scene.shift(grain, Vec3::Constant(0.3));
  const std::size_t second = at(scene.contact.contactor_of_slot[at(scene.local.slot_of_element[1])]);
  scene.contact.field[second] = {{1, 1, 1, 0}, 0};
  free_corners(scene.params, static_cast<Index>(second), 7, scene.contact);
  scene.evaluate(kStep);
  EXPECT_TRUE(scene.contact.touching.empty());
  constexpr double kRoundOff = 1e-12;
  EXPECT_NEAR(scene.work.friction_dissipated.value() - lost, held, kRoundOff * held);
}

}  // namespace
}  // namespace breccia::friction_block_test
