#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/groups.hpp"
#include "case/joint_entries.hpp"
#include "case/parent_case.hpp"
#include "case/validate.hpp"
#include "case_files.hpp"

/// group = "*" in [[material]]: which groups it stands for is known with the mesh.
namespace breccia::case_::every_group_test {
namespace {

using testing::HasSubstr;

const std::string kLaw = "poisson = 0.2\ndensity = 2400\n";
const std::string kStrong = "tensile_strength = \"1 MPa\"\nenergy_mode_1 = \"10 J/m2\"\n";
const std::string kSteel = "[[material]]\ngroup = \"steel\"\nyoung = \"200 GPa\"\njoints = \"none\"\n" + kLaw;
const std::string kAnyRock = "[[material]]\ngroup = \"*\"\nyoung = \"10 GPa\"\n" + kLaw;
const std::string kAnyJoint = "[[joint]]\ngroup = \"*\"\n" + kStrong;

std::string whole(const std::string& entries) {
  return "[mesh]\nfile = \"geometry.geo\"\n" + entries + "[[stage]]\nend = \"1 ms\"\n";
}

/// What check_groups() finds for a mesh of these volumes; empty: nothing.
std::string found(const std::string& entries, const std::vector<std::string>& volumes) {
  const std::vector<Problem> problems = check_groups(read_text(whole(entries)), {volumes, {}});
  return problems.empty() ? "" : InputError(problems).what();
}

TEST(EveryGroup, HasTheMaterialOfItsOwnBeforeThatOfAny) {
  const Case c = read_text(whole(kAnyRock + kSteel + kAnyJoint));
  EXPECT_EQ(material_of(c, "clay")->young, 10e9);
  EXPECT_EQ(material_of(c, "steel")->young, 200e9);
  EXPECT_EQ(material_of(read_text(whole(kSteel)), "clay"), nullptr);
  EXPECT_EQ(found(kAnyRock + kSteel + kAnyJoint, {"clay", "steel", "sand"}), "");
}

TEST(EveryGroup, HasTheJointsOfItsOwnBeforeThoseOfAny) {
  const Case c = read_text(whole(kAnyRock + kSteel + kAnyJoint + "[[joint]]\ngroup = \"clay\"\nfriction = 0.3\n" +
                                 kStrong + "[[joint]]\nbetween = [\"*\", \"steel\"]\npenalty_factor = 30\n"),
                           {"mesh.glue=true"});
  EXPECT_EQ(joint_entry(c, "clay", "clay").ruling->friction, 0.3);
  const JointEntry sand = joint_entry(c, "sand", "sand");
  ASSERT_NE(sand.ruling, nullptr);
  EXPECT_EQ(sand.ruling->friction, 0);
  EXPECT_EQ(joint_between(c, *sand.ruling, "sand", "sand").penalty, 100 * 10e9);
  EXPECT_EQ(joint_between(c, *joint_entry(c, "steel", "sand").ruling, "steel", "sand").penalty, 30 * 10e9);
  EXPECT_EQ(joint_entry(c, "clay", "clay").ruling->penalty, 100 * 10e9);
}

TEST(EveryGroup, StandsInTheResolvedCaseThatReadsAlike) {
  for (const std::string& entries : {kAnyRock + kSteel + kAnyJoint, kSteel + kAnyRock + "joints = \"unbreakable\"\n",
                                     kAnyRock + "joints = \"none\"\n"}) {
    const Case c = read_text(whole(entries)), again = read_text(c.resolved);
    EXPECT_EQ(again.materials, c.materials);
    EXPECT_EQ(again.joints, c.joints);
    EXPECT_EQ(again.resolved, c.resolved);
  }
}

TEST(EveryGroup, ThatIsUnbreakableHasJointsWithoutAnEntry) {
  const Case c = read_text(whole(kAnyRock + "joints = \"unbreakable\"\n"));
  ASSERT_NE(joint_entry(c, "clay", "clay").ruling, nullptr);
  EXPECT_EQ(joint_between(c, *joint_entry(c, "clay", "clay").ruling, "clay", "clay").penalty, 100 * 10e9);
}

TEST(EveryGroup, OfNoneIsRefused) {
  EXPECT_THAT(found(kAnyRock + kSteel + kAnyJoint, {"steel"}),
              HasSubstr("case.toml:4: material[0].group: stands for no group of the mesh; allowed: \"*\" where"));
  EXPECT_THAT(found(kAnyRock + "joints = \"none\"\n" + kAnyJoint, {"clay"}),
              HasSubstr("case.toml:10: joint[0].group: stands for no group of the mesh"));
  EXPECT_THAT(found(kAnyRock + kAnyJoint + "[[joint]]\ngroup = \"clay\"\n" + kStrong, {"clay"}),
              HasSubstr("joint[0].group: stands for no group of the mesh"));
}

TEST(EveryGroup, TwiceIsRefusedWithBothLines) {
  EXPECT_THAT(message_of(whole(kAnyRock + kAnyRock + kAnyJoint)),
              HasSubstr("case.toml:9: material[1].group: the group has a material already, in line 4"));
  EXPECT_THAT(message_of(whole(kAnyRock + kAnyJoint + kAnyJoint)),
              HasSubstr("case.toml:13: joint[1].group: the joints have a law already, in line 9"));
}

TEST(EveryGroup, ThatBreaksNeedsAJointLaw) {
  EXPECT_THAT(found(kAnyRock + kSteel, {"clay", "steel"}),
              HasSubstr("material[0].joints: the group \"clay\", one of \"*\", is breakable but has no joint law"));
  EXPECT_EQ(found(kAnyRock + kSteel + "[[joint]]\ngroup = \"clay\"\n" + kStrong, {"clay", "steel"}), "");
  EXPECT_THAT(message_of(whole(kAnyRock + "[[joint]]\ngroup = \"*\"\n")),
              HasSubstr("joint[0].tensile_strength: is missing: joints of \"*\" can fail"));
}

TEST(EveryGroup, NamesOfGroupsWithoutAMaterialOfTheirOwnAreThoseOfTheMesh) {
  const std::string more = kAnyRock + kAnyJoint;
  const auto refusal = [&](const std::string& entry) { return found(more + entry, {"clay", "sand"}); };
  EXPECT_EQ(refusal("[[initial_velocity]]\ngroup = \"clay\"\nvelocity = [1, 0, 0]\n"), "");
  EXPECT_THAT(refusal("[[initial_velocity]]\ngroup = \"cley\"\nvelocity = [1, 0, 0]\n"),
              HasSubstr("initial_velocity[0].group: the mesh has no volume group \"cley\"; allowed: clay, sand"));
  EXPECT_THAT(refusal("[[contact]]\nbetween = [\"cley\", \"*\"]\npenalty = 1e9\n[[contact]]\nbetween = [\"*\", "
                      "\"*\"]\npenalty = 1e9\n"),
              HasSubstr("contact[0].between: the mesh has no volume group \"cley\""));
  EXPECT_THAT(refusal("[[joint]]\ngroup = \"sant\"\n" + kStrong), HasSubstr("joint[1].group: the mesh has no volume"));
}

TEST(EveryGroup, IsCoveredByContactOnceThereIsAny) {
  const std::string more = kAnyRock + kSteel + kAnyJoint + "[[contact]]\nbetween = [\"steel\", \"*\"]\npenalty = 1e9\n";
  EXPECT_THAT(found(more, {"clay", "steel", "sand"}), HasSubstr("no [[contact]] covers \"clay\" and \"sand\""));
  EXPECT_EQ(found(more + "[[contact]]\nbetween = [\"*\", \"*\"]\ninteraction = \"none\"\n", {"clay", "steel", "sand"}),
            "");
}

TEST(EveryGroup, OfARunThatStartsFromAnotherIsComparedGroupByGroup) {
  const CaseFolder folder;
  const std::string mesh = "[mesh]\nfile = \"" + folder.write("geometry.geo", "").string() + "\"\n";
  const std::string stage = "[[stage]]\nend = \"1 ms\"\n", joints = "joints = \"none\"\n";
  const ParentCase parent =
      parent_case(mesh + kAnyRock + joints + kSteel + stage, folder.path() / "parent.toml", {}, {"clay", "steel"});
  const auto message = [&](const std::string& materials) {
    try {
      (void)read_started_case(folder.write("case.toml", "[start]\nfrom = \"run\"\n" + materials + stage), {}, parent);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string clay = replaced(kAnyRock + joints, "\"*\"", "\"clay\"");
  EXPECT_EQ(message(kAnyRock + joints + kSteel), "");
  EXPECT_EQ(message(clay + kSteel), "");
  EXPECT_THAT(message(replaced(clay, "2400", "2500") + kSteel), HasSubstr("material[0].density: cannot change"));
  EXPECT_THAT(message(kSteel + replaced(kAnyRock + joints, "2400", "2500")),
              HasSubstr("material[1].density: cannot change"));
}

}  // namespace
}  // namespace breccia::case_::every_group_test
