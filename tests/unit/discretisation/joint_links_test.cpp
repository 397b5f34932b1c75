#include "discretisation/joint_links.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace breccia::joint_links_test {
namespace {

constexpr Index kSlots = 2 * kLanes;

/// Place in a nodal field of corner c of an own-node element.
std::int32_t place_of(Index slot, int corner) {
  return static_cast<std::int32_t>(nodal(own_corner_node(slot, corner), 0));
}

std::int32_t place_in(const JointLinks& links, Index slot, int face, int i) {
  const auto block = static_cast<std::size_t>(slot / kLanes), lane = static_cast<std::size_t>(slot % kLanes);
  return links.place[block * 96 + static_cast<std::size_t>(face * 24 + i * kLanes) + lane];
}

TEST(JointLinks, MatchTheSameCornersFromBothSidesForEveryPairOfFacesAndEveryRotation) {
  const Index a = 3, b = kLanes + 5;
  for (int face = 0; face < 4; ++face) {
    for (int code = 0; code < 12; ++code) {
      JointLinks links;
      links.reset(kSlots);
      links.attach(a, face, b, code);
      const std::int32_t to_b = links.link[JointLinks::at(a, face)], to_a = links.link[JointLinks::at(b, code / 3)];
      EXPECT_EQ(JointLinks::slot_of(to_b), b);
      EXPECT_EQ(JointLinks::slot_of(to_a), a);
      for (int i = 0; i < 3; ++i) {
        const int own = kFaceCorners[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)];
        const int other = matching_corner(code, i);
        EXPECT_EQ(place_in(links, a, face, i), place_of(b, other));
        for (int j = 0; j < 3; ++j) {
          const bool meets = kFaceCorners[static_cast<std::size_t>(code / 3)][static_cast<std::size_t>(j)] == other;
          EXPECT_EQ(place_in(links, b, code / 3, j) == place_of(a, own), meets) << face << " " << code << " " << i;
        }
      }
    }
  }
}

TEST(JointLinks, PointBackAtTheOwnFaceWithoutStiffnessWhereThereIsNoJoint) {
  JointLinks links;
  links.reset(kSlots);
  links.attach(1, 2, 9, 7);
  links.detach(1, 2);
  for (int face = 0; face < 4; ++face) {
    EXPECT_EQ(links.link[JointLinks::at(1, face)], JointLinks::self_link(1, face));
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(place_in(links, 1, face, i),
                place_of(1, kFaceCorners[static_cast<std::size_t>(face)][static_cast<std::size_t>(i)]));
    EXPECT_EQ(links.stiffness[JointLinks::at(1, face)], 0.0);
  }
  EXPECT_EQ(links.limit[1], std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace breccia::joint_links_test
