#include "model/constraint_conflicts.hpp"

#include <gtest/gtest.h>

#include "unit/model/two_boxes.hpp"

namespace breccia::constraint_conflicts_test {
namespace {

std::string constraint(const std::string& group, const std::string& motion) {
  return "[[stage.constraint]]\ngroup = \"" + group + "\"\n" + motion + "\n";
}

/// A cube of 24 elements that share their nodes; 5 of the 14 on each surface, 2 on each edge.
std::vector<ConstraintConflict> conflicts_in(const std::string& constraints, const std::string& joints = "none") {
  static case_::Case input;
  input = case_::read_text(case_::minimal + constraints, {"material[0].joints=" + joints});
  return constraint_conflicts(input, build_bare_model(input));
}

TEST(ConstraintConflicts, AreFoundWhereSurfacesThatMoveDifferentlyShareAnEdge) {
  const auto found =
      conflicts_in(constraint("raster.x0", "fixed = \"xy\"") + constraint("raster.z1", "velocity = { x = 1, z = 2 }"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].earlier->group, "raster.x0");
  EXPECT_EQ(found[0].later->group, "raster.z1");
  EXPECT_EQ(found[0].axis, 0);
  EXPECT_EQ(found[0].shared, 2);
  EXPECT_EQ(found[0].of_earlier, 5);
  EXPECT_FALSE(found[0].whole);
}

TEST(ConstraintConflicts, CountNodesOfTheMeshWhereElementsHaveTheirOwn) {
  const auto found = conflicts_in(
      constraint("raster.x0", "fixed = \"x\"") + constraint("raster.z1", "velocity = { x = 1 }"), "unbreakable");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].shared, 2);
  EXPECT_EQ(found[0].of_earlier, 5);
}

TEST(ConstraintConflicts, AreWholeWhereNothingIsLeftOfTheEarlierEntry) {
  const auto found =
      conflicts_in(constraint("raster.x0", "velocity = { x = 1 }") + constraint("raster", "fixed = \"x\""));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].whole);
  EXPECT_FALSE(
      conflicts_in(constraint("raster", "fixed = \"x\"") + constraint("raster.x0", "velocity = { x = 1 }"))[0].whole);
}

TEST(ConstraintConflicts, AreNoneWhereEntriesAgreeOrShareNoNodeOrNoAxis) {
  EXPECT_TRUE(
      conflicts_in(constraint("raster.x0", "fixed = \"x\"") + constraint("raster.z1", "fixed = \"xz\"")).empty());
  EXPECT_TRUE(
      conflicts_in(constraint("raster.x0", "fixed = \"x\"") + constraint("raster.z1", "velocity = { x = 0 }")).empty());
  EXPECT_TRUE(
      conflicts_in(constraint("raster.x0", "fixed = \"x\"") + constraint("raster.x1", "velocity = { x = 1 }")).empty());
  EXPECT_TRUE(
      conflicts_in(constraint("raster.x0", "fixed = \"x\"") + constraint("raster.z1", "velocity = { z = 1 }")).empty());
  EXPECT_TRUE(conflicts_in(constraint("raster.x0", "velocity = { x = { linear = 1 } }") +
                           constraint("raster.z1", "velocity = { x = { linear = 1 } }"))
                  .empty());
}

}  // namespace
}  // namespace breccia::constraint_conflicts_test
