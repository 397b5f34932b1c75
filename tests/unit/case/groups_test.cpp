#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/validate.hpp"
#include "case_files.hpp"

namespace breccia::case_::groups_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

const std::vector<std::string> volumes{"frame", "glass", "projectile"};
const std::vector<std::string> surfaces{"grip", "other", "slit", "support", "surface", "top"};

std::vector<std::string> without(std::vector<std::string> groups, const std::string& group) {
  std::erase(groups, group);
  return groups;
}

std::string text(const std::vector<Problem>& problems) { return InputError(problems).what(); }

TEST(Groups, ACaseWhoseGroupsTheMeshHasIsAccepted) {
  const auto problems = check_groups(read_text(complete), {volumes, surfaces});
  EXPECT_TRUE(problems.empty()) << text(problems);
}

TEST(Groups, AnAbsentVolumeIsNamedWithItsLineAndTheNearestGroupsFirst) {
  std::vector<std::string> present = without(volumes, "glass");
  present.push_back("glas");
  const auto problems = check_groups(read_text(complete), {present, surfaces});
  ASSERT_THAT(problems, SizeIs(2));
  EXPECT_THAT(problems[0].text(),
              AllOf(HasSubstr("case.toml:9: material[0].group: the mesh has no volume group \"glass\""),
                    HasSubstr("allowed: glas, frame, projectile")));
  EXPECT_THAT(problems[1].text(), HasSubstr("the volume group \"glas\" of the mesh has no material"));
}

TEST(Groups, AnAbsentOneIsToldWithThePlaceWhereItWasGiven) {
  const Case c = read_text(complete, {"stage[0].constraint[1].group=nowhere"});
  const auto problems = check_groups(c, {volumes, surfaces});
  ASSERT_THAT(problems, SizeIs(1));
  EXPECT_EQ(problems[0].text().find("--set: stage[0].constraint[1].group: the mesh has no"), 0U) << problems[0].text();
}

TEST(Groups, AnAbsentSurfaceIsReportedWhereverItIsNamed) {
  const std::string message = text(check_groups(read_text(complete), {volumes, without(surfaces, "slit")}));
  for (const char* key : {"contact_points.surfaces", "joints.broken", "stage[0].pressure[0].surface"})
    EXPECT_THAT(message, HasSubstr(std::string(key) + ": the mesh has no surface group \"slit\""));
}

TEST(Groups, ConstraintsAndGaugesTakeVolumesAndSurfaces) {
  const Case c = read_text(replaced(complete, "gauges = [\"support\"]", "gauges = [\"glass\", \"top\", \"nowhere\"]"));
  EXPECT_THAT(
      text(check_groups(c, {volumes, without(surfaces, "grip")})),
      AllOf(HasSubstr("stage[0].constraint[1].group: the mesh has no volume, surface, curve or point group \"grip\""),
            HasSubstr("output.gauges: the mesh has no volume, surface, curve or point group \"nowhere\"")));
}

TEST(Groups, AConstraintOnANameOfAVolumeAndASurfaceIsRefusedAsNotClear) {
  std::vector<std::string> both = surfaces;
  both.push_back("glass");
  const Case c = read_text(replaced(complete, "gauges = [\"support\"]", "gauges = [\"glass\"]"));
  EXPECT_TRUE(check_groups(c, {volumes, surfaces}).empty());
  EXPECT_THAT(
      text(check_groups(c, {volumes, both})),
      HasSubstr("output.gauges: this name is ambiguous: a volume group and a surface group of the mesh have it"));
}

TEST(Groups, AVolumeNamedAsEveryGroupIsRefused) {
  std::vector<std::string> starred = volumes;
  starred.push_back("*");
  const Case c = read_text(complete +
                           "[[material]]\ngroup = \"*\"\nyoung = 1e9\npoisson = 0.2\ndensity = 1\n"
                           "joints = \"none\"\n");
  EXPECT_THAT(text(check_groups(c, {starred, surfaces})),
              HasSubstr("mesh: a volume group of the mesh has the name that stands for every group in [[material]], "
                        "[[joint]] and [[contact]]"));
}

TEST(Groups, AGaugeOnANameOfAGroupAndABodyIsRefusedAsNotClear) {
  const Case c = read_text(replaced(complete, "gauges = [\"support\"]", "gauges = [\"body 1\"]"));
  std::vector<std::string> with_body = surfaces;
  with_body.push_back("body 1");
  EXPECT_TRUE(check_groups(c, {volumes, surfaces}, 2).empty());
  EXPECT_TRUE(check_groups(c, {volumes, with_body}, 1).empty()) << "there is no such body";
  EXPECT_THAT(text(check_groups(c, {volumes, with_body}, 2)),
              HasSubstr("output.gauges: this name is ambiguous: a group of the mesh and a body have it"));
}

TEST(Groups, ConstraintsAndGaugesTakeCurvesAndPoints) {
  const std::vector<std::string> nodes{"edge", "grip", "slit"};
  const Case c = read_text(replaced(complete, "gauges = [\"support\"]", "gauges = [\"edge\"]"));
  EXPECT_TRUE(check_groups(c, {volumes, without(surfaces, "grip"), nodes}).empty());
  EXPECT_TRUE(check_groups(c, {volumes, surfaces, nodes}).empty()) << "the surface of that name is meant";
}

TEST(Groups, ACurveWhereASurfaceIsAskedForIsRefused) {
  const std::vector<std::string> nodes{"slit"};
  EXPECT_THAT(
      text(check_groups(read_text(complete), {volumes, without(surfaces, "slit"), nodes})),
      HasSubstr(
          "stage[0].pressure[0].surface: this is a curve or point of the mesh, where a surface group is required; "
          "allowed: "));
}

TEST(Groups, AMeshWithoutSurfacesSaysSo) {
  EXPECT_THAT(text(check_groups(read_text(complete), {volumes, {}})), HasSubstr("the mesh has none"));
}

TEST(Groups, ASurfaceToBreakInAStageIsChecked) {
  EXPECT_THAT(text(check_groups(read_text(complete), {volumes, without(surfaces, "surface")})),
              HasSubstr("stage[0].broken: the mesh has no surface group \"surface\""));
}

}  // namespace
}  // namespace breccia::case_::groups_test
