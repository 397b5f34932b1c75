#include <gtest/gtest.h>

#include "discretisation/layout.hpp"
#include "discretisation/nodal_forces.hpp"

namespace breccia::nodal_forces_test {
namespace {

constexpr Index kOwnBlocks = 3, kNodes = kOwnBlocks * 4 * kLanes + 2 * kLanes;

TEST(NodalForces, AddUpOnOwnAndSharedNodes) {
  NodalForces forces(kOwnBlocks, kNodes);
  for (const Index node : {5, 37, kNodes - 1}) {
    forces.add(node, Vec3(1, 2, 3));
    forces.add(node, Vec3(10, 20, 30));
    EXPECT_EQ(forces.get(node), Vec3(11, 22, 33)) << node;
  }
  EXPECT_EQ(forces.get(6), Vec3(0, 0, 0));
}

TEST(NodalForces, ShowTheSweepTheBlockOfCornersAxesAndLanes) {
  NodalForces forces(kOwnBlocks, kNodes);
  forces.add(own_corner_node(13, 2), Vec3(1, 2, 3));  // block 1, lane 5
  EXPECT_EQ(forces.block(0), nullptr);
  ASSERT_NE(forces.block(1), nullptr);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(forces.block(1)[(2 * 3 + axis) * 8 + 5], axis + 1.0);
}

TEST(NodalForces, AreZeroAfterClearing) {
  NodalForces forces(kOwnBlocks, kNodes);
  for (Index node = 0; node < kNodes; ++node) forces.add(node, Vec3(1, 1, 1));
  forces.clear();
  for (Index node = 0; node < kNodes; ++node) EXPECT_EQ(forces.get(node), Vec3(0, 0, 0));
  forces.add(70, Vec3(1, 2, 3));
  EXPECT_EQ(forces.get(70), Vec3(1, 2, 3));
}

}  // namespace
}  // namespace breccia::nodal_forces_test
