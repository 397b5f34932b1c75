#include "mesh/material_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace breccia::material_groups_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Volume 1 is in grain_a, volume 2 in grain_b, both in phase.
const PhysicalVolumes kGrains{{"grain_a", "grain_b", "phase"}, {{1, {0, 2}}, {2, {1, 2}}}};

std::string problem_of(const PhysicalVolumes& physical, const std::vector<std::string>& materials) {
  std::vector<Problem> problems;
  (void)material_groups(physical, materials, "grains.msh", problems);
  return problems.empty() ? "" : InputError(problems).what();
}

TEST(MaterialGroups, AreThoseThatHaveAMaterialAndTheOthersAreSets) {
  std::vector<Problem> problems;
  MaterialGroups groups = material_groups(kGrains, {"grain_b", "grain_a"}, "grains.msh", problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(groups.volume_groups, ElementsAre("grain_a", "grain_b"));
  EXPECT_THAT(groups.element_sets, ElementsAre("phase"));
  EXPECT_EQ(groups.group_of[2], 1);
  EXPECT_THAT(groups.sets_of[2], ElementsAre(0));
  groups = material_groups(kGrains, {"phase"}, "grains.msh", problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(groups.volume_groups, ElementsAre("phase"));
  EXPECT_THAT(groups.element_sets, ElementsAre("grain_a", "grain_b"));
  EXPECT_EQ(groups.group_of[2], 0);
  EXPECT_THAT(groups.sets_of[2], ElementsAre(1));
}

TEST(MaterialGroups, AreTheFirstOnesWhereNoMaterialIsKnown) {
  std::vector<Problem> problems;
  const MaterialGroups groups = material_groups(kGrains, {}, "grains.msh", problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(groups.volume_groups, ElementsAre("grain_a", "grain_b"));
  EXPECT_THAT(groups.element_sets, ElementsAre("phase"));
}

TEST(MaterialGroups, ThatOverlapNowhereStayAsTheyAre) {
  std::vector<Problem> problems;
  const PhysicalVolumes apart{{"plate", "empty", "ball"}, {{5, {0}}, {7, {2}}}};
  const MaterialGroups groups = material_groups(apart, {"ball"}, "apart.msh", problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(groups.volume_groups, ElementsAre("plate", "empty", "ball")) << "what has no material is refused later";
  EXPECT_THAT(groups.element_sets, IsEmpty());
}

TEST(MaterialGroups, RefuseTwoMaterialsForAnElementAndAGroupThatCarriesItForSomeOnly) {
  EXPECT_THAT(problem_of(kGrains, {"grain_a", "phase"}),
              AllOf(HasSubstr("grains.msh: volume 1: lies in two physical volumes with a material"),
                    HasSubstr("one [[material]] for every element"), HasSubstr("\"grain_a\" and \"phase\"")));
  EXPECT_THAT(problem_of({{"grain_a", "phase"}, {{1, {0, 1}}, {2, {1}}}}, {"grain_a"}),
              HasSubstr("physical volume \"phase\": would carry the material of some of its elements only"));
}

}  // namespace
}  // namespace breccia::material_groups_test
