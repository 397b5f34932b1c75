#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/reader.hpp"
#include "unit/advice/advice_of.hpp"
#include "unit/case/case_files.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::unjoined_rules_test {
namespace {

using test::as_list;
using testing::AllOf;
using testing::HasSubstr;

const std::string kMaterial = R"([[material]]
group = "rock"
young = "40 GPa"
poisson = 0.2
density = 2400
joints = "none"
)";
const std::string kStage = "[[stage]]\nend = \"1 ms\"\n";

/// Two boxes of one group side by side. @param join  a line of the geometry
std::string touching(const std::string& join, const std::string& glue,
                     const std::string& contact = "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"40 GPa\"\n") {
  const case_::CaseFolder folder;
  folder.write("boxes.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nBox(2) = {1, 0, 0, 1, 1, 1};\n" + join +
                   "\nPhysical Volume(\"rock\") = Volume{:};\nMeshSize{:} = 2;\n");
  const case_::Case input = case_::read_case(
      folder.write("case.toml", "[mesh]\nfile = \"boxes.geo\"\nglue = " + glue + "\n" + kMaterial + contact + kStage));
  const Model model = build_bare_model(input);
  const Sentences advice = unjoined_volumes(input, model.mesh, model.topology);
  for (const std::string& sentence : advice)  // `run` warns of what `check` reports
    EXPECT_THAT(start_warnings(input, model), testing::Contains(sentence));
  return as_list(advice);
}

TEST(UnjoinedVolumes, NamesVolumesOfOneGroupThatTouchAndAreNotJoined) {
  EXPECT_THAT(touching("Coherence;", "false"),
              AllOf(HasSubstr("Volumes of \"rock\" touch along"), HasSubstr("bodies 0 and 1"),
                    HasSubstr("mesh.glue = true"), HasSubstr("they interact by contact alone")));
  EXPECT_EQ(touching("Coherence;", "true"), "");
}

TEST(UnjoinedVolumes, TellsThatNothingKeepsVolumesApartThatTouchWithoutContact) {
  EXPECT_THAT(touching("Coherence;", "false", ""),
              HasSubstr("they pass through each other, unless there is a [[contact]]"));
}

TEST(UnjoinedVolumes, NamesAnInterfaceThatIsThereTwice) {
  EXPECT_THAT(touching("", "true"), AllOf(HasSubstr("Volumes of \"rock\" touch along"), HasSubstr("Coherence"),
                                          HasSubstr("mesh.merge_nodes")));
}

TEST(UnjoinedVolumes, OfDifferentGroupsAreNamedWhereTheyWereToBeGlued) {
  const case_::CaseFolder folder;
  folder.write("boxes.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nBox(2) = {1, 0, 0, 1, 1, 1};\n"
               "Physical Volume(\"left\") = 1;\nPhysical Volume(\"right\") = 2;\nMeshSize{:} = 2;\n");
  const auto advice_for = [&](const std::string& glue) {
    const case_::Case input = case_::read_case(folder.write(
        "case.toml", "[mesh]\nfile = \"boxes.geo\"\nglue = " + glue +
                         "\n[[material]]\ngroup = [\"left\", \"right\"]\nyoung = 1e9\npoisson = 0.2\ndensity = 2000\n"
                         "joints = \"none\"\n[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = 1e9\n" +
                         kStage));
    const Model model = build_bare_model(input);
    return as_list(unjoined_volumes(input, model.mesh, model.topology));
  };
  EXPECT_THAT(advice_for("true"), HasSubstr("Volumes of \"left\" and \"right\" touch along"));
  EXPECT_EQ(advice_for("false"), "") << "two bodies with contact";
}

TEST(UnjoinedVolumes, AreReportedWhereAMeshHasTheNodesInsideOfAVolumeTwice) {
  const case_::CaseFolder
      folder;  // two tetrahedra of one volume, the face between them with nodes of its own on each side
  folder.write("doubled.msh",
               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"rock\"\n$EndPhysicalNames\n$Nodes\n8\n"
               "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 0\n6 0 1 0\n7 0 0 1\n8 1 1 1\n$EndNodes\n"
               "$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 1 1 8 5 7 6\n$EndElements\n");
  const auto advice_for = [&](const std::string& more) {
    const case_::Case input =
        case_::read_case(folder.write("case.toml", "[mesh]\nfile = \"doubled.msh\"\n" + more + kMaterial + kStage));
    const Model model = build_bare_model(input);
    return as_list(unjoined_volumes(input, model.mesh, model.topology));
  };
  EXPECT_THAT(advice_for(""), AllOf(HasSubstr("touch along 1 triangle and"), HasSubstr("bodies 0 and 1"),
                                    HasSubstr("mesh.merge_nodes joins them")));
  EXPECT_EQ(advice_for("merge_nodes = \"1 um\"\n"), "");
}

/// Two glued boxes of two groups, and what is advised of their initial velocities.
std::string advice_on_motion(const std::string& velocities) {
  const case_::Case input = test::two_boxes_case({}, test::kTwoBoxesCase + velocities);
  return as_list(part_in_motion(input, build_bare_model(input)));
}

TEST(PartsInMotion, AreNamedWhereTheRestOfTheBodyDoesNotTurnWithThem) {
  const auto entry = [](const std::string& group, const std::string& value) {
    return "[[initial_velocity]]\ngroup = \"" + group + "\"\n" + value + "\n";
  };
  const std::string spin = "angular = [0, 0, 5]", other = "angular = [0, 0, 6]";
  EXPECT_THAT(advice_on_motion(entry("left", spin)),
              AllOf(HasSubstr("initial_velocity[0] (line"), HasSubstr("\"right\" is joined to \"left\"")));
  EXPECT_THAT(advice_on_motion(entry("left", spin) + entry("right", other)), HasSubstr("initial_velocity[1]"));
  EXPECT_EQ(advice_on_motion(entry("left", spin) + entry("right", spin)), "");
  EXPECT_EQ(advice_on_motion(entry("left", "velocity = [1, 0, 0]")), "") << "an impact within a body is meant";
  EXPECT_THAT(advice_on_motion(entry("left", "random = [1, 2]")), HasSubstr("is joined to"));
}

}  // namespace
}  // namespace breccia::unjoined_rules_test
