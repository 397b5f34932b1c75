#include <gtest/gtest.h>
#include <cmath>

#include "physics/constraints.hpp"
#include "support/sums.hpp"
#include "unit/physics/loads/models.hpp"

namespace breccia::constraints_test {
namespace {

using test::in_time;
using test::Model;

constexpr double kRounding = 1e-12;

Model lone_tetrahedron() { return {test::tetrahedron(), Discretisation::own_nodes, 1000}; }

/// What the sweep would leave without forces: velocity kept, positions moved on.
void drift(Model& model, double dt) {
  for (std::size_t i = 0; i < model.state.position.size(); ++i) {
    model.state.next_position[i] = model.state.position[i] + dt * model.state.velocity[i];
  }
}

TEST(Constraints, PrescribeTheVelocityOfTheStepsMiddle) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[2];
  Constraints constraints(
      {{{node}, {false, true, false}, PrescribedMotion::velocity, {in_time(0), in_time(0, 4.0), in_time(0)}}},
      model.local, model.state);
  const double y = model.state.position[nodal(node, 1)];
  drift(model, 0.5);
  constraints.apply(model.state, 1.0, 0.5, 0.5);
  EXPECT_EQ(model.state.velocity[nodal(node, 1)], 4.0 * 1.25);
  EXPECT_EQ(model.state.next_position[nodal(node, 1)], y + 0.5 * 5.0);
  EXPECT_EQ(model.state.velocity[nodal(node, 0)], 0.0);
}

TEST(Constraints, HoldPrescribedDisplacementsFromTheStagesStart) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[1];
  store_node(model.state.position.data(), node, Vec3(10, 20, 30));  // the stage begins in a deformed state
  const TimeFunction sine = in_time(0, 0, 0.3, 0.7);
  Constraints constraints(
      {{{node}, {true, false, true}, PrescribedMotion::displacement, {sine, in_time(0), in_time(0, -2.0)}}},
      model.local, model.state);
  constexpr double kStep = 0.01;
  for (int step = 0; step < 100; ++step) {
    drift(model, kStep);
    constraints.apply(model.state, step * kStep, kStep, kStep);
    std::swap(model.state.position, model.state.next_position);
    const double time = (step + 1) * kStep;
    EXPECT_NEAR(model.state.position[nodal(node, 0)], 10 + sine(time), 10 * kRounding);
    EXPECT_NEAR(model.state.position[nodal(node, 2)], 30 - 2 * time, 30 * kRounding);
    EXPECT_EQ(model.state.position[nodal(node, 1)], 20);
  }
}

TEST(Constraints, ReactionIsTheForceThatChangedTheVelocity) {
  Model model = lone_tetrahedron();
  const double node_mass = 1000.0 / (6.0 * std::sqrt(2.0)) / 4.0;
  const std::vector<Index> nodes = model.real_nodes();
  Constraints constraints({{{nodes[0], nodes[3]}, {true, true, true}, PrescribedMotion::velocity, {}}}, model.local,
                          model.state);
  for (const Index n : nodes) store_node(model.state.velocity.data(), n, Vec3(1, 0, -2));
  constraints.apply(model.state, 0.0, 0.0, 0.1);
  EXPECT_LT((test::value_of(constraints.reaction(0)) - 2 * node_mass / 0.1 * Vec3(-1, 0, 2)).norm(),
            kRounding * 2 * node_mass / 0.1);
}

TEST(Constraints, ReactAgainstMassDampingToo) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[0];
  const double mass = model.local.node_mass[at(node)];
  constexpr double kDamping = 6, kStep = 0.1, kHalf = 0.5 * kDamping * kStep;
  Constraints constraints({{{node}, {true, false, false}, PrescribedMotion::velocity, {in_time(2), {}, {}}}},
                          model.local, model.state, kDamping);
  const double before = 5, free = before * (1 - kHalf) / (1 + kHalf);  // of a damped node without forces
  store_node(model.state.velocity.data(), node, Vec3(free, 0, 0));
  constraints.apply(model.state, 0.0, 0.0, kStep);
  const double reaction = mass * (2 - before) / kStep + kDamping * mass * (before + 2) / 2;
  EXPECT_NEAR(constraints.reaction(0)[0].value(), reaction, kRounding * std::abs(reaction));
}

TEST(Constraints, ReactToTheUnbalancedForceWhateverTheLocalDampingOfFreeNodes) {
  constexpr double kLocal = 0.7, kMass = 6, kStep = 0.1, kSpeed = 2, kHalf = 0.5 * kMass * kStep;
  for (const double unbalanced : {-30.0, 0.4}) {
    Model model = lone_tetrahedron();
    const Index node = model.real_nodes()[0];
    const double mass = model.local.node_mass[at(node)];
    store_node(model.state.velocity.data(), node, Vec3(kSpeed, 0, 0));
    Constraints constraints({{{node}, {true, false, false}, PrescribedMotion::velocity, {in_time(kSpeed), {}, {}}}},
                            model.local, model.state, kMass, kLocal);
    // As the sweep moves it, with the local force against its velocity.
    const double force = unbalanced - kLocal * std::abs(unbalanced);
    const double swept = ((1 - kHalf) * kSpeed + kStep / mass * force) / (1 + kHalf);
    store_node(model.state.velocity.data(), node, Vec3(swept, 0, 0));
    constraints.apply(model.state, 0.0, kStep, kStep);
    const double reaction = kMass * mass * kSpeed - unbalanced;
    EXPECT_NEAR(constraints.reaction(0)[0].value(), reaction, kRounding * 30 / kLocal) << unbalanced;
  }
}

TEST(Constraints, AtRestDoNoWorkButReact) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[0], other = model.real_nodes()[1];
  const double mass = model.local.node_mass[at(node)];
  Constraints constraints({{{node, other}, {false, true, false}, PrescribedMotion::velocity, {}}}, model.local,
                          model.state);
  for (int step = 0; step < 3; ++step) {
    store_node(model.state.velocity.data(), node, Vec3(1, 2 + step, 3));
    drift(model, 0.5);
    constraints.apply(model.state, 0.5 * step, 0.5, 0.5);
    EXPECT_EQ(load_node(model.state.velocity.data(), node), Vec3(1, 0, 3));
    EXPECT_EQ(model.state.next_position[nodal(node, 1)], model.state.position[nodal(node, 1)]);
    const double reaction = -mass * (2 + step) / 0.5;
    EXPECT_NEAR(constraints.reaction(0)[1].value(), reaction, kRounding * std::abs(reaction));
    EXPECT_EQ(constraints.reaction_on(std::vector{other})[1].value(), 0.0);
    EXPECT_EQ(constraints.reaction_on(std::vector{node})[1].value(), constraints.reaction(0)[1].value());
    constraints.account_after(0.5);
  }
  EXPECT_EQ(constraints.work().value(), 0.0);
}

TEST(Constraints, ThatStopANodeBookTheWorkOfItsLastWay) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[0];
  const double mass = model.local.node_mass[at(node)];
  store_node(model.state.velocity.data(), node, Vec3(4, 0, 0));
  Constraints constraints({{{node}, {true, false, false}, PrescribedMotion::velocity, {}}}, model.local, model.state);
  constraints.apply(model.state, 0.0, 0.5, 0.5);
  EXPECT_NEAR(constraints.work().value(), 0.5 * (-mass * 4 / 0.5) * 4 * 0.5, kRounding * mass);
}

TEST(Constraints, GiveAnAxisToTheLaterOfTwoEntriesAndCountANodeOnce) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[0], other = model.real_nodes()[1];
  const double mass = model.local.node_mass[at(node)];
  Constraints constraints(
      {{{node, other, node}, {true, true, false}, PrescribedMotion::velocity, {in_time(1), in_time(1), in_time(0)}},
       {{node}, {false, true, true}, PrescribedMotion::velocity, {in_time(0), in_time(5), in_time(6)}}},
      model.local, model.state);
  constraints.apply(model.state, 0.0, 0.0, 1.0);
  EXPECT_EQ(load_node(model.state.velocity.data(), node), Vec3(1, 5, 6));
  EXPECT_EQ(load_node(model.state.velocity.data(), other), Vec3(1, 1, 0));
  EXPECT_LT((test::value_of(constraints.reaction(0)) - mass * Vec3(2, 1, 0)).norm(), kRounding * mass);
  EXPECT_LT((test::value_of(constraints.reaction(1)) - mass * Vec3(0, 5, 6)).norm(), kRounding * mass);
}

TEST(Constraints, LeaveReactionAndWorkOfANodeToTheRankThatCountsIt) {
  Model model = lone_tetrahedron();
  const Index own = model.real_nodes()[0], proxy = model.real_nodes()[1];
  const double mass = model.local.node_mass[at(own)];
  model.local.counted[at(proxy)] = 0;
  Constraints constraints({{{own, proxy}, {true, false, false}, PrescribedMotion::velocity, {in_time(3), {}, {}}}},
                          model.local, model.state);
  constraints.apply(model.state, 0.0, 0.0, 0.5);
  EXPECT_EQ(load_node(model.state.velocity.data(), proxy), Vec3(3, 0, 0)) << "held all the same";
  EXPECT_NEAR(constraints.reaction(0)[0].value(), mass * 3 / 0.5, kRounding * mass);
  constraints.account_after(0.5);
  EXPECT_NEAR(constraints.work().value(), 0.5 * (mass * 3 / 0.5) * 3 * 0.5, kRounding * mass);
}

TEST(Constraints, GoOnFromWhatTheyRememberedBeforeADivision) {
  Model model = lone_tetrahedron();
  const Index node = model.real_nodes()[3], other = model.real_nodes()[1];
  const std::vector<NodalConstraint> entries{
      {{node}, {true, false, true}, PrescribedMotion::displacement, {in_time(0, 2.0), {}, in_time(0.5)}}};
  Constraints before(entries, model.local, model.state);
  before.apply(model.state, 0.0, 0.0, 0.25);
  std::swap(model.state.position, model.state.next_position);
  NodalState elsewhere = model.state;
  Constraints after(entries, model.local, elsewhere);
  std::vector<Constraints::Anchor> anchors = before.anchors();
  anchors.push_back({0, other, 0, 77.0, 0.0});       // of a node that is not held here
  anchors.push_back({1000000, node, 0, 77.0, 0.0});  // of no entry
  after.restore(anchors);
  before.apply(model.state, 0.25, 0.25, 0.25);
  after.apply(elsewhere, 0.25, 0.25, 0.25);
  EXPECT_EQ(load_node(elsewhere.velocity.data(), node), load_node(model.state.velocity.data(), node));
  EXPECT_EQ(load_node(elsewhere.next_position.data(), node), load_node(model.state.next_position.data(), node));
  EXPECT_EQ(elsewhere.velocity[nodal(node, 0)], 2.0);
}

TEST(Constraints, OnNothingDoNothing) {
  Model model = lone_tetrahedron();
  const Field<double> before = model.state.velocity;
  Constraints constraints({}, model.local, model.state);
  constraints.apply(model.state, 0.0, 0.1, 0.1);
  constraints.account_after(0.1);
  EXPECT_TRUE(constraints.empty());
  EXPECT_EQ(model.state.velocity, before);
  EXPECT_EQ(constraints.work().value(), 0.0);
}

}  // namespace
}  // namespace breccia::constraints_test
