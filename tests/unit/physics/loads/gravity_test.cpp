#include <gtest/gtest.h>

#include "unit/physics/loads/models.hpp"

namespace breccia::gravity_test {
namespace {

using test::Model;

constexpr double kRounding = 1e-12;

Vec3 brute_moment(const Model& model) {
  Vec3 sum = Vec3::Zero();
  for (const Index n : model.real_nodes()) {
    sum += model.local.node_mass[at(n)] * load_node(model.state.position.data(), n);
  }
  return sum;
}

TEST(GravityWork, OfAFallingBodyIsWeightTimesHeight) {
  Model model(test::box({1, 1, 1}), Discretisation::own_nodes, 1000);  // 1000 kg
  GravityWork gravity;
  const Vec3 g(0, 0, -10);
  gravity.advance(model.local, model.state, g, 0.0);
  for (int step = 0; step < 5; ++step) {
    model.map_positions([&](const Vec3& x) { return Vec3(x + Vec3(3, 0, -0.5 * (step + 1))); });
    gravity.advance(model.local, model.state, g, 0.1);
    EXPECT_NEAR(gravity.work(model.local, model.state.position).value(), 1000 * 10 * 0.5 * (step + 1),
                25000 * kRounding);
  }
}

TEST(GravityWork, IgnoresThePaddingsMass) {
  Model model(test::tetrahedron(), Discretisation::own_nodes, 1.0);  // seven slots of padding, 1 kg a node
  GravityWork gravity;
  gravity.advance(model.local, model.state, Vec3(0, 0, -1), 0.0);
  for (Index n = 0; n < model.local.num_nodes; ++n) model.state.position[nodal(n, 2)] -= 1.0;
  EXPECT_NEAR(gravity.work(model.local, model.state.position).value(), 1.0 / (6.0 * std::sqrt(2.0)), kRounding);
}

TEST(GravityWork, FollowsEveryChangeOfGravityByTheTrapezoidRule) {
  // Constant, ramp, constant, one step of another value, back: every branch; the bodies move at random.
  const auto g_of = [](int step) {
    if (step < 5) return Vec3(0, 0, -9);
    if (step < 12) return Vec3(0.3 * (step - 4), 0, -9);
    if (step == 16) return Vec3(4, 1, 2);
    return Vec3(2, 0, -9);
  };
  Model model(test::box({2, 1, 1}), Discretisation::shared_nodes, 1000);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> speed(-1, 1);
  GravityWork gravity, handed_on;
  double expected = 0, scale = 0;
  double dt = 0.0;
  Vec3 last_moment = brute_moment(model);
  for (int step = 0; step < 25; ++step) {
    const Vec3 moment = brute_moment(model);
    if (step > 0) expected += 0.5 * (g_of(step) + g_of(step - 1)).dot(moment - last_moment);
    scale = std::max(scale, std::abs(expected));
    last_moment = moment;
    handed_on.close(model.local, model.state.position);
    handed_on.anchor = {};
    handed_on.set_anchor(model.local, model.state.position);
    for (GravityWork* work : {&gravity, &handed_on}) work->advance(model.local, model.state, g_of(step), dt);
    ASSERT_EQ(handed_on.work(model.local, model.state.position), gravity.work(model.local, model.state.position))
        << "step " << step;
    ASSERT_NEAR(gravity.work(model.local, model.state.position).value(), expected, 1e3 * kRounding * (scale + 1))
        << "step " << step;
    dt = 0.01 * (1 + step % 3);
    for (const Index n : model.real_nodes()) {
      const Vec3 v(speed(random) + 1, speed(random), speed(random) - 0.5);
      store_node(model.state.velocity.data(), n, v);
      store_node(model.state.position.data(), n, load_node(model.state.position.data(), n) + dt * v);
    }
  }
  EXPECT_GT(scale, 100.0);  // J: the tolerance above is small beside it
}

}  // namespace
}  // namespace breccia::gravity_test
