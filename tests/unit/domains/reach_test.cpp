#include <gtest/gtest.h>

#include "domains/decomposition.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::reach_test {
namespace {

constexpr double kEdge = 0.25, kSize = 0.375, kBuffer = 0.0625;  // m; sums of these are exact

/// The shortest case, whose elements share nodes, or one whose elements have their own and joints that hold them.
case_::Case with_joints(bool joined) {
  if (!joined) return case_::read_text(case_::minimal);
  std::string text = case_::minimal;
  const std::string none = "joints = \"none\"\n";
  const std::string held = "joints = \"unbreakable\"\n[[joint]]\ngroup = \"raster\"\npenalty_factor = 10\n";
  text.replace(text.find(none), none.size(), held);
  return case_::read_text(text);
}

TEST(Reach, IsOneRingOfElementsForJointsAndTwoForSharedNodes) {
  EXPECT_EQ(reach_of(with_joints(true), kEdge, kBuffer).distance(kSize), kEdge + kSize + 2 * kBuffer);
  EXPECT_EQ(reach_of(with_joints(false), kEdge, kBuffer).distance(kSize), kEdge + 2 * kSize + 2 * kBuffer);
}

/// Around shared nodes the stable step depends on three rings, which among large elements lie beyond the margin.
TEST(Reach, IsThreeRingsOfLargeElementsForSharedNodes) {
  const double large = 8;
  EXPECT_EQ(reach_of(with_joints(true), kEdge, kBuffer).distance(large), kEdge + large + 2 * kBuffer);
  EXPECT_EQ(reach_of(with_joints(false), kEdge, kBuffer).distance(large), 3 * large);
}

TEST(Reach, LetsBothSidesMoveByHalfItsMargin) {
  EXPECT_EQ(reach_of(with_joints(true), kEdge, kBuffer).allowed_motion(), kEdge / 2);
}

}  // namespace
}  // namespace breccia::reach_test
