#include "physics/nodal_load.hpp"

#include <gtest/gtest.h>

#include "unit/physics/loads/models.hpp"

namespace breccia::nodal_load_test {
namespace {

using test::Model;

constexpr double kRounding = 1e-12;

/// A force of (4, 0, -2) N on two nodes, at 0.5 s.
struct TwoNodes {
  Model model{test::box({1, 1, 1}), Discretisation::own_nodes, 1000};
  std::vector<Index> nodes = model.real_nodes();
  NodalLoad load{{{nodes[1], 0.25}, {nodes[7], 0.75}},
                 std::array{test::in_time(3.0, 2.0), test::in_time(0.0), test::in_time(-2.0)}};
  NodalForces forces{model.local.num_own_blocks(), model.local.num_nodes};

  void apply(double dt_before) { load.apply(model.local, model.state, 0.5, dt_before, forces); }
};

TEST(NodalLoad, GivesEachNodeItsShareOfTheForceAtThatTime) {
  TwoNodes two;
  two.apply(0);
  EXPECT_EQ(two.forces.get(two.nodes[1]), Vec3(1, 0, -0.5));
  EXPECT_EQ(two.forces.get(two.nodes[7]), Vec3(3, 0, -1.5));
  EXPECT_EQ(two.forces.get(two.nodes[2]), Vec3(0, 0, 0));
}

TEST(NodalLoad, WorksByHalfInTheStepBeforeAndByHalfInTheStepAfter) {
  TwoNodes two;
  store_node(two.model.state.velocity.data(), two.nodes[1], Vec3(2, 5, 0));
  store_node(two.model.state.velocity.data(), two.nodes[7], Vec3(0, 0, 4));
  const double power = 1 * 2 - 1.5 * 4;
  two.apply(0.1);
  EXPECT_NEAR(two.load.work().value(), 0.5 * 0.1 * power, kRounding);
  two.load.account_after(two.model.local, two.model.state, 0.2);
  EXPECT_NEAR(two.load.work().value(), 0.5 * 0.3 * power, kRounding);
}

TEST(NodalLoad, LeavesTheWorkOnNodesOfAnotherRankToThatRank) {
  TwoNodes two;
  for (const Index node : two.nodes) store_node(two.model.state.velocity.data(), node, Vec3(1, 0, 0));
  two.model.local.counted[static_cast<std::size_t>(two.nodes[7])] = 0;
  two.apply(2.0);
  EXPECT_NEAR(two.load.work().value(), 1.0, kRounding);
  EXPECT_EQ(two.forces.get(two.nodes[7]), Vec3(3, 0, -1.5)) << "it moves here all the same";
}

}  // namespace
}  // namespace breccia::nodal_load_test
