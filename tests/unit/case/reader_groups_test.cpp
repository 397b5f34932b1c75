#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "case/joint_entries.hpp"
#include "case/problem_at.hpp"
#include "case/writer.hpp"
#include "case_files.hpp"

namespace breccia::case_::reader_groups_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Three glued groups, the last of shared nodes. @param joints  entries of [[joint]]
std::string glued(const std::string& joints) {
  return R"([mesh]
file = "geometry.geo"
glue = true
[[material]]
group = ["soft", "hard"]
young = "10 GPa"
poisson = 0.2
density = 2400
[[material]]
group = "base"
young = "20 GPa"
poisson = 0.2
density = 2400
joints = "none"
)" + joints +
         "[[stage]]\nend = \"1 ms\"\n";
}

/// Strengths, without the groups.
const std::string kStrong = "tensile_strength = \"1 MPa\"\nenergy_mode_1 = \"10 J/m2\"\n";

std::vector<std::string> groups_of(const auto& entries) {
  std::vector<std::string> groups;
  for (const auto& entry : entries) groups.push_back(entry.group);
  return groups;
}

TEST(ReaderGroups, AListOfGroupsIsReadAsAnEntryOfEach) {
  const std::string joint = "[[joint]]\ngroup = [\"soft\", \"hard\"]\n" + kStrong;
  const std::string more = R"([[joint]]
between = ["soft", "hard"]
penalty_factor = 30
tensile_strength = "2 MPa"
energy_mode_1 = "10 J/m2"
[[initial_velocity]]
group = ["hard", "base"]
velocity = [1, 0, 0]
)";
  const std::string loads = R"([[stage.constraint]]
group = ["left", "right"]
fixed = "x"
[[stage.pressure]]
surface = ["top", "bottom"]
value = 5
[[stage.traction]]
surface = ["top", "side"]
value = [0, 1, 0]
[[stage.force]]
group = ["edge", "side"]
value = [0, 1, 0]
)";
  const Case c = read_text(glued(joint + more) + loads);
  EXPECT_THAT(groups_of(c.materials), ElementsAre("soft", "hard", "base"));
  EXPECT_EQ(c.materials[0].young, c.materials[1].young);
  ASSERT_EQ(c.joints.size(), 3u);
  EXPECT_EQ(c.joints[0].groups, (std::array<std::string, 2>{"soft", "soft"}));
  EXPECT_EQ(c.joints[1].groups, (std::array<std::string, 2>{"hard", "hard"}));
  EXPECT_EQ(c.joints[2].tensile_strength, 2e6);
  EXPECT_THAT(groups_of(c.initial_velocities), ElementsAre("hard", "base"));
  const Stage& stage = c.stages.front();
  EXPECT_THAT(groups_of(stage.constraints), ElementsAre("left", "right"));
  EXPECT_THAT(groups_of(stage.forces), ElementsAre("edge", "side"));
  ASSERT_EQ(stage.pressures.size(), 2u);
  EXPECT_EQ(stage.pressures[1].surface, "bottom");
  ASSERT_EQ(stage.tractions.size(), 2u);
  EXPECT_EQ(stage.tractions[1].surface, "side");
  EXPECT_EQ(stage.forces[1].value[1](0.0), 1.0);
}

TEST(ReaderGroups, EntriesAreToldOfByTheirPlaceInTheFile) {
  const Case c = read_text(
      glued("[[joint]]\ngroup = [\"soft\", \"hard\"]\n" + kStrong + "[[joint]]\nbetween = [\"hard\", \"base\"]\n"));
  EXPECT_EQ(c.materials[1].origin.key, "material[0]");
  EXPECT_EQ(c.materials[2].origin.key, "material[1]");
  EXPECT_EQ(c.joints[2].origin.key, "joint[1]");
  EXPECT_EQ(place_of(c.file, c.materials[1].origin, "group").line, 5);
  EXPECT_EQ(place_of(c.file, c.materials[2].origin, "young").line, 11);
}

TEST(ReaderGroups, TheResolvedCaseNamesEachGroupAndReadsAlike) {
  const Case c = read_text(
      glued("[[joint]]\ngroup = \"*\"\n" + kStrong + "[[joint]]\nbetween = [\"*\", \"base\"]\npenalty_factor = 30\n"));
  const Case again = read_text(c.resolved);
  EXPECT_EQ(again.materials, c.materials);
  EXPECT_EQ(again.joints, c.joints);
  EXPECT_EQ(again.resolved, c.resolved);
}

TEST(ReaderGroups, EveryGroupOfAJointIsEachOneWithJointsAndWithoutAnEntryOfItsOwn) {
  const std::string any = "[[joint]]\ngroup = \"*\"\n" + kStrong;
  const Case both = read_text(glued(any));
  ASSERT_EQ(both.joints.size(), 2u);
  EXPECT_EQ(both.joints[1].groups[0], "hard");
  const Case one =
      read_text(glued(any + "[[joint]]\ngroup = [\"hard\"]\ntensile_strength = \"3 MPa\"\nenergy_mode_1 = 1\n"));
  ASSERT_EQ(one.joints.size(), 2u);
  EXPECT_EQ(one.joints[0].groups[0], "soft");
  EXPECT_EQ(one.joints[1].tensile_strength, 3e6);
}

TEST(ReaderGroups, AnInterfaceByNameGoesBeforeOneOfAnyGroup) {
  const Case c = read_text(glued("[[joint]]\ngroup = \"*\"\n" + kStrong +
                                 "[[joint]]\nbetween = [\"*\", \"*\"]\npenalty_factor = 30\n" + kStrong +
                                 "[[joint]]\nbetween = [\"hard\", \"*\"]\npenalty_factor = 40\n" + kStrong +
                                 "[[joint]]\nbetween = [\"base\", \"hard\"]\npenalty = \"7 GPa\"\n"));
  const auto key = [&](const char* a, const char* b) { return joint_entry(c, a, b).ruling->origin.key; };
  EXPECT_EQ(key("soft", "base"), "joint[1]");
  EXPECT_EQ(key("soft", "hard"), "joint[2]");
  EXPECT_EQ(key("hard", "soft"), "joint[2]");
  EXPECT_EQ(key("hard", "base"), "joint[3]");
  EXPECT_EQ(key("hard", "hard"), "joint[0]");
  EXPECT_EQ(joint_entry(c, "base", "base").ruling, nullptr);
  EXPECT_EQ(joint_entry(c, "soft", "hard").tied, nullptr);
}

TEST(ReaderGroups, ThePenaltyOfAnInterfaceOfAnyGroupIsThatOfTheSofterOfTheTwo) {
  const std::string text = replaced(glued("[[joint]]\nbetween = [\"*\", \"*\"]\npenalty_factor = 30\n" + kStrong +
                                          "[[joint]]\ngroup = \"*\"\n" + kStrong),
                                    "group = [\"soft\", \"hard\"]\nyoung = \"10 GPa\"",
                                    "group = \"hard\"\nyoung = \"90 GPa\"\npoisson = 0.2\ndensity = "
                                    "2400\n[[material]]\ngroup = \"soft\"\nyoung = \"10 GPa\"");
  const Case c = read_text(text);
  const auto penalty = [&](const char* a, const char* b) {
    const Joint joint = joint_between(c, *joint_entry(c, a, b).ruling, a, b);
    EXPECT_EQ(joint.groups, (std::array<std::string, 2>{a, b}));
    return joint.penalty;
  };
  EXPECT_DOUBLE_EQ(penalty("hard", "base"), 30 * 20e9);
  EXPECT_DOUBLE_EQ(penalty("hard", "soft"), 30 * 10e9);
  EXPECT_DOUBLE_EQ(penalty("hard", "hard"), 100 * 90e9);
}

TEST(ReaderGroups, WhatIsWrongInAnEntryOfSeveralGroupsIsSaidOnce) {
  const std::string ok = "[[joint]]\ngroup = \"*\"\n" + kStrong;
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of(replaced(glued(ok), from, to));
  };
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"[\"soft\", \"hard\"]", "[]",
            "case.toml:5: material[0].group: is an empty list; allowed: text, or a list of texts"},
           {"[\"soft\", \"hard\"]", "[\"soft\", 7]", "material[0].group: is a list with entries that are no names"},
           {"[\"soft\", \"hard\"]", "[\"soft\", \"\"]", "material[0].group: is a list with entries that are no names"},
           {"[\"soft\", \"hard\"]", "[\"soft\", \"soft\"]", "material[0].group: the group has a material already"},
           {"\"10 GPa\"", "\"10 GN\"", "case.toml:6: material[0].young: "},
           {"poisson = 0.2", "poisson = 0.7", "case.toml:7: material[0].poisson: is out of range"},
           {"\"1 MPa\"", "\"1 m\"", "joint[0].tensile_strength: "},
           {"group = \"*\"", "group = [\"soft\", \"hard\", \"clay\"]",
            "joint[0].group: no [[material]] has the group \"clay\""},
           {"[[stage]]\n", "[[joint]]\ngroup = \"*\"\n[[stage]]\n", "joint[1].group: "},
           {"[[stage]]\n", "[[joint]]\nbetween = [\"*\", \"clay\"]\n[[stage]]\n",
            "joint[1].between: no [[material]] has the group \"clay\""}}) {
    const std::string told = message(from, to);
    EXPECT_THAT(told, HasSubstr(says)) << to;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0) << told;
  }
}

TEST(ReaderGroups, AGroupThatCannotBeReadIsMissedNowhereElse) {
  const std::string own = "[[joint]]\ngroup = \"soft\"\n" + kStrong + "[[initial_velocity]]\ngroup = \"hard\"\n";
  for (const auto& [from, to] :
       std::vector<std::array<std::string, 2>>{{"[\"soft\", \"hard\"]", "3"},
                                               {"[\"soft\", \"hard\"]", "[]"},
                                               {"[[joint]]\ngroup = \"soft\"", "[[joint]]\ngroup = [3]"}}) {
    const std::string told = message_of(replaced(glued(own), from, to));
    EXPECT_THAT(told, HasSubstr("[0].group: is ")) << to;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0) << told;
  }
}

TEST(ReaderGroups, EveryGroupOfAJointThatIsNoneIsRefused) {
  const std::string own = "[[joint]]\ngroup = [\"soft\", \"hard\"]\n" + kStrong;
  EXPECT_THAT(message_of(glued(own + "[[joint]]\ngroup = \"*\"\n")), HasSubstr("joint[1].group: stands for no group"));
}

TEST(ReaderGroups, AnInterfaceOfAnyGroupsNeedsStrengthsWhereTwoThatBreakFitIt) {
  const std::string own = "[[joint]]\ngroup = [\"soft\", \"hard\"]\n" + kStrong;
  const std::string told = message_of(glued(own + "[[joint]]\nbetween = [\"*\", \"*\"]\n"));
  EXPECT_THAT(told, HasSubstr("joint[1].tensile_strength: is missing: joints of \"soft\" and \"hard\" can fail"));
  EXPECT_EQ(message_of(glued(own + "[[joint]]\nbetween = [\"*\", \"base\"]\n")), "");
}

TEST(ReaderGroups, AnOverrideChangesAllGroupsOfAnEntry) {
  const Case c = read_text(glued("[[joint]]\ngroup = \"*\"\n" + kStrong),
                           {"material[0].young=30e9", "material.base.young=40e9", "joint[0].friction=0.7"});
  EXPECT_EQ(c.materials[1].young, 30e9);
  EXPECT_EQ(c.materials[2].young, 40e9);
  EXPECT_EQ(c.joints[1].friction, 0.7);
  EXPECT_EQ(read_text(glued("[[joint]]\ngroup = \"*\"\n" + kStrong), {"material[1].group=[\"base\", \"rock\"]"})
                .materials.size(),
            4u);
}

}  // namespace
}  // namespace breccia::case_::reader_groups_test
