#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "physics/energy.hpp"
#include "physics/initial_velocity.hpp"
#include "support/sums.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::initial_velocity_test {
namespace {

using test::Model;

constexpr double kRounding = 1e-12;

TEST(RandomVelocity, HasUniformSpeedAndUniformDirection) {
  // Means over n bodies of quantities with variance s^2 lie within 4.5 s / sqrt(n): a false alarm once in 150,000.
  constexpr int kBodies = 200000;
  double speed = 0, speed_squared = 0;
  Vec3 direction = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::uint64_t b = 0; b < kBodies; ++b) {
    const Vec3 v = random_velocity(7, b, {2.0, 5.0});
    ASSERT_GE(v.norm(), 2.0 * (1 - kRounding));
    ASSERT_LE(v.norm(), 5.0 * (1 + kRounding));
    speed += v.norm() / kBodies;
    speed_squared += v.squaredNorm() / kBodies;
    direction += v.normalized() / kBodies;
    second += v.normalized() * v.normalized().transpose() / kBodies;
  }
  const double band = 4.5 / std::sqrt(kBodies);
  EXPECT_NEAR(speed, 3.5, band * 3.0 / std::sqrt(12.0));
  EXPECT_NEAR(speed_squared, 13.0, band * 6.3);  // (5^3 - 2^3) / 9; deviation of u^2 is 6.2
  EXPECT_LT(direction.cwiseAbs().maxCoeff(), band / std::sqrt(3.0));
  EXPECT_LT((second - Mat3::Identity() / 3.0).cwiseAbs().maxCoeff(), band * 0.3);  // deviation of n_x^2: sqrt(4/45)
}

TEST(RandomVelocity, DependsOnTheSeed) { EXPECT_NE(random_velocity(1, 0, {1, 2}), random_velocity(2, 0, {1, 2})); }

TEST(InitialVelocity, OfABodyDoesNotDependOnHowManyBodiesThereAre) {
  const auto first_velocity = [](std::array<int, 3> boxes) {
    Model model(test::box({1, 1, 1}, 1.0, boxes), Discretisation::own_nodes, 1000);
    add_initial_velocity(model.local, {.speed = {1, 3}, .seed = 11}, model.state.position, model.state.velocity);
    return load_node(model.state.velocity.data(), model.local.corner_node(model.local.slot_of_element[0], 0));
  };
  EXPECT_EQ(first_velocity({1, 1, 1}), first_velocity({3, 2, 1}));
}

TEST(InitialVelocity, IsTheSameForAllNodesOfABodyAndDiffersBetweenBodies) {
  Model model(test::box({1, 1, 1}, 1.0, {2, 1, 1}), Discretisation::shared_nodes, 1000);
  add_initial_velocity(model.local, {.uniform = Vec3(1, 2, 3), .speed = {1, 3}}, model.state.position,
                       model.state.velocity);
  std::array<Vec3, 2> of_body;
  for (Index body = 0; body < 2; ++body) of_body[at(body)] = Vec3(1, 2, 3) + random_velocity(1, at(body), {1, 3});
  for (Index s = 0; s < model.local.num_slots; ++s) {
    if (model.local.element_of_slot[at(s)] < 0) continue;
    for (int c = 0; c < 4; ++c) {
      EXPECT_LT((load_node(model.state.velocity.data(), model.local.corner_node(s, c)) -
                 of_body[at(model.local.slot_body[at(s)])])
                    .norm(),
                kRounding);
    }
  }
}

TEST(InitialVelocity, TurnsEveryBodyAboutItsCentreOfMass) {
  Model model(test::jittered(test::box({1, 2, 1}, 1.0, {2, 1, 1}), 0.08, 4), Discretisation::own_nodes, 1000);
  const Vec3 omega(1, -2, 3);
  std::vector<double> mass(2, 0.0);
  std::vector<Vec3> centre(2, Vec3::Zero());
  for (Index n = 0; n < model.local.num_own_nodes(); ++n) {
    const GlobalId id = model.local.node_id[at(n)];
    if (id < 0) continue;
    const std::size_t body = at(model.mesh.element_body[at(static_cast<Index>(id / 4))]);
    mass[body] += model.local.node_mass[at(n)];
    centre[body] += model.local.node_mass[at(n)] * load_node(model.state.position.data(), n);
  }
  for (std::size_t b = 0; b < 2; ++b) centre[b] /= mass[b];
  add_initial_velocity(model.local, {.angular = omega, .centre = centre}, model.state.position, model.state.velocity);
  const Momentum p = momentum(model.local, model.state.position.data(), model.state.velocity.data());
  EXPECT_LT(test::value_of(p.linear).norm(), 4000 * 4 * kRounding);
  // Two nodes of one body: relative velocity is omega x arm.
  const Index a = model.local.corner_node(0, 0), b = model.local.corner_node(0, 3);
  const auto difference = [&](const Field<double>& f) { return Vec3(load_node(f.data(), b) - load_node(f.data(), a)); };
  EXPECT_LT((difference(model.state.velocity) - omega.cross(difference(model.state.position))).norm(), 10 * kRounding);
}

TEST(InitialVelocity, StretchesEveryBodyFromItsCentre) {
  Model model(test::jittered(test::box({1, 2, 1}, 1.0, {2, 1, 1}), 0.08, 4), Discretisation::own_nodes, 1000);
  const Vec3 rate(3, -2, 0.5);
  const std::vector<Vec3> centre{Vec3(0.4, 1, 0.5), Vec3(2.6, 0.9, 0.5)};
  add_initial_velocity(model.local, {.strain_rate = rate, .centre = centre}, model.state.position,
                       model.state.velocity);
  for (Index s = 0; s < model.local.num_slots; ++s) {
    if (model.local.element_of_slot[at(s)] < 0) continue;
    for (int c = 0; c < 4; ++c) {
      const Index n = model.local.corner_node(s, c);
      const Vec3 arm = load_node(model.state.position.data(), n) - centre[at(model.local.slot_body[at(s)])];
      const Vec3 expected(3 * arm.x(), -2 * arm.y(), 0.5 * arm.z());
      EXPECT_LT((load_node(model.state.velocity.data(), n) - expected).norm(), kRounding);
    }
  }
}

TEST(InitialVelocity, OfNodesThatGroupsShareIsTheMeanByMass) {
  Mesh mesh = test::jittered(test::box({4, 1, 1}), 0.05, 4);
  mesh.volume_groups = {"left", "right"};
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    Vec3 centre = Vec3::Zero();
    for (const Index node : mesh.elements[at(e)]) centre += 0.25 * mesh.nodes[at(node)];
    mesh.element_group[at(e)] = centre.x() < 2 ? 0 : 1;
  }
  const std::vector<double> density{1000, 3000};
  Model model(std::move(mesh), Discretisation::shared_nodes, 1000);
  model.local = build_local_mesh(model.mesh, {Discretisation::shared_nodes, Discretisation::shared_nodes}, density);
  const auto start = [&](const Vec3& left, const Vec3& right) {
    std::fill(model.state.velocity.begin(), model.state.velocity.end(), 0.0);
    for (const Index group : {0, 1})
      add_initial_velocity(model.local, {.group = group, .uniform = group == 0 ? left : right}, model.state.position,
                           model.state.velocity, mass_share(model.local, density, {.group = group}));
    return test::value_of(momentum(model.local, model.state.position.data(), model.state.velocity.data()).linear);
  };
  model.state.position = model.local.reference;
  model.state.velocity.assign(model.local.reference.size(), 0.0);
  double mass[2] = {0, 0};
  for (Index s = 0; s < model.local.num_slots; ++s) {
    const Index group = model.local.block_group[at(s / kLanes)];
    mass[group] += density[at(group)] * model.local.volume[at(s)];
  }
  EXPECT_LT((start(Vec3(1, 0, 0), Vec3(0, -2, 0)) - Vec3(mass[0], -2 * mass[1], 0)).norm(), 1e4 * kRounding);
  start(Vec3(3, 0, 0), Vec3(3, 0, 0));
  for (const Index node : model.real_nodes())
    EXPECT_LT((load_node(model.state.velocity.data(), node) - Vec3(3, 0, 0)).norm(), 10 * kRounding);
}

TEST(InitialVelocity, AddsAndLeavesPaddingAndOtherGroupsAlone) {
  Model model(test::tetrahedron(), Discretisation::own_nodes, 1000);
  for (int twice = 0; twice < 2; ++twice) {
    add_initial_velocity(model.local, {.uniform = Vec3(1, 0, 0)}, model.state.position, model.state.velocity);
  }
  add_initial_velocity(model.local, {.group = 5, .uniform = Vec3(9, 9, 9)}, model.state.position, model.state.velocity);
  for (Index n = 0; n < model.local.num_nodes; ++n) {
    const Vec3 expected = model.local.node_id[at(n)] < 0 ? Vec3(0, 0, 0) : Vec3(2, 0, 0);
    EXPECT_EQ(load_node(model.state.velocity.data(), n), expected);
  }
}

}  // namespace
}  // namespace breccia::initial_velocity_test
