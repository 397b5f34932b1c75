#include "core/group_names.hpp"

#include <gtest/gtest.h>

namespace breccia::gui::group_names_test {
namespace {

const TomlPlaces kCase(R"(
[[material]]
group = "glass"
[[stage]]
[[stage.traction]]
surface = "top"
)");
const MeshGroups kMesh{{"glass", "steel"}, {"top", "foot"}, {"edge"}, 2};

TEST(GroupNames, ANewEntryIsOfAGroupWithoutOneAndInventsNoQuantity) {
  EXPECT_EQ(lines_of_new_entry("material", kCase, kMesh), "group = \"steel\"\n");
  EXPECT_EQ(lines_of_new_entry("stage[0].traction", kCase, kMesh), "surface = \"foot\"\n");
  EXPECT_EQ(lines_of_new_entry("stage[0].constraint", kCase, kMesh), "group = \"top\"\n");
  EXPECT_EQ(lines_of_new_entry("stage[0].force", kCase, kMesh), "group = \"top\"\n");
  EXPECT_EQ(lines_of_new_entry("initial_velocity", kCase, {}), "group = \"glass\"\n") << "the mesh is not known yet";
  EXPECT_EQ(lines_of_new_entry("material", kCase, MeshGroups{{"glass"}, {}, {}, 1}), "") << "all have one";
  EXPECT_EQ(lines_of_new_entry("stage", kCase, kMesh), "");
}

TEST(GroupNames, ANewEntryIsOfAGroupThatNoListNames) {
  const TomlPlaces listed("[[material]]\ngroup = [\"glass\", \"steel\"]\n");
  EXPECT_EQ(lines_of_new_entry("material", listed, MeshGroups{{"glass", "steel", "wood"}, {}, {}, 3}),
            "group = \"wood\"\n");
  EXPECT_EQ(groups_of_kind(GroupKind::volume, listed, {}), (QStringList{"glass", "steel"}));
}

TEST(GroupNames, AListGetsEachGroupOnce) {
  EXPECT_EQ(with_group("", "top"), "top");
  EXPECT_EQ(with_group("top", "foot"), "top, foot");
  EXPECT_EQ(with_group("top, foot", "foot"), "top, foot");
}

TEST(GroupNames, AConstraintMayHoldASurfaceACurveOrAVolume) {
  EXPECT_EQ(groups_of_kind(GroupKind::any, kCase, kMesh), (QStringList{"top", "foot", "edge", "glass", "steel"}));
  EXPECT_EQ(groups_of_kind(GroupKind::surface, kCase, kMesh), (QStringList{"top", "foot"}));
}

TEST(GroupNames, EveryKeyOfASurfaceOrAVolumeKnowsItsKind) {
  const auto kind = [](const char* path) { return group_kind(case_::key_of(path)); };
  EXPECT_EQ(kind("material[].group"), GroupKind::volume);
  EXPECT_EQ(kind("stage[].constraint[].group"), GroupKind::any);
  EXPECT_EQ(kind("stage[].force[].group"), GroupKind::any);
  EXPECT_EQ(kind("stage[].pressure[].surface"), GroupKind::surface);
  EXPECT_EQ(kind("mesh.raster.group"), GroupKind::none) << "a name is given there";
  for (const char* path : {"joints.broken", "stage[].broken", "stage[].absorbing", "contact_points.surfaces"}) {
    EXPECT_EQ(kind(path), GroupKind::surface) << path;
    EXPECT_TRUE(names_many_groups(case_::key_of(path))) << path;
  }
}

}  // namespace
}  // namespace breccia::gui::group_names_test
