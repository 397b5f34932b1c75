#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "end_to_end/program.hpp"

namespace breccia::test::bodies_test {
namespace {

/// A bar of 40 x 10 x 10 mm of two volumes with one interface, in one group or in two.
const std::string kGeometry = R"(SetFactory("OpenCASCADE");
Box(1) = {-20, -5, -5, 20, 10, 10};
Box(2) = {0, -5, -5, 20, 10, 10};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
MeshSize{:} = 5;
)";
const std::string kOneGroup = "Physical Volume(\"bar\") = {1, 2};\n";
const std::string kTwoGroups = "Physical Volume(\"left\") = {1};\nPhysical Volume(\"right\") = {2};\n";

constexpr double kMass = 2000 * 0.04 * 0.01 * 0.01;                    // kg
constexpr double kInertia = kMass / 12 * (0.04 * 0.04 + 0.01 * 0.01);  // kg m2, about z
constexpr double kSpin = 500, kRate = 400;                             // rad/s, 1/s
constexpr double kLumping = 0.08;                                      // masses stand at nodes: 5 % more

/// @param groups  `"bar"`, or a list;  @param motion  line of the initial velocity
std::string bar(const std::string& groups, const std::string& motion, const std::string& end) {
  return "title = \"bar\"\n[mesh]\nfile = \"bar.geo\"\nscale = 0.001\nglue = true\n[[material]]\ngroup = " + groups +
         "\nyoung = \"10 GPa\"\npoisson = 0.2\ndensity = 2000\njoints = \"none\"\n[[initial_velocity]]\ngroup = " +
         groups + "\n" + motion + "\n[[stage]]\nend = \"" + end + "\"\n";
}

struct BarRun {
  Outcome outcome;
  std::filesystem::path folder;
  [[nodiscard]] double first(const std::string& column) const {
    return history_column(folder / "history.csv", column).front();
  }
  [[nodiscard]] double last(const std::string& column) const {
    return history_column(folder / "history.csv", column).back();
  }
  [[nodiscard]] std::string hash() const {
    return nlohmann::json::parse(read_text(folder / "summary.json"))["state_hash"];
  }
};

BarRun run(const Scratch& scratch, const std::string& case_text, int ranks = 1) {
  const std::string file = scratch.write("case.toml", case_text);
  const std::filesystem::path folder = scratch.path("run_" + std::to_string(ranks));
  const std::string arguments = "run " + file + " --progress none -f -o '" + folder.string() + "'";
  return {ranks == 1 ? call(arguments) : call_ranks(ranks, arguments), folder};
}

TEST(Bodies, ASolidOfTwoVolumesTurnsAboutItsOwnCentreWhateverGroupsTheyAreOf) {
  for (const auto& [geometry, groups] :
       {std::pair{kOneGroup, "\"bar\""}, std::pair{kTwoGroups, "[\"left\", \"right\"]"}}) {
    const Scratch scratch;
    scratch.write("bar.geo", kGeometry + geometry);
    const BarRun turned = run(scratch, bar(groups, "angular = [0, 0, 500]", "100 us"));
    ASSERT_EQ(turned.outcome.exit_code, 0) << turned.outcome.err;
    EXPECT_EQ(turned.outcome.err.find("warning"), std::string::npos) << turned.outcome.err;
    const double energy = 0.5 * kInertia * kSpin * kSpin;
    EXPECT_NEAR(turned.first("kinetic [J]"), energy, kLumping * energy) << groups;
    EXPECT_NEAR(turned.first("angular momentum z [kg m2/s]"), kInertia * kSpin, kLumping * kInertia * kSpin) << groups;
    EXPECT_LT(turned.last("elastic [J]"), 1e-4 * energy) << "it turns as one";
    const BarRun stretched = run(scratch, bar(groups, "strain_rate = [400, 0, 0]", "1 us"));
    const double stretch = 0.5 * kRate * kRate * kMass * 0.04 * 0.04 / 12;
    EXPECT_NEAR(stretched.first("kinetic [J]"), stretch, kLumping * stretch) << groups;
    const std::string bodies = read_text(turned.folder / "bodies.csv");
    EXPECT_EQ(bodies, groups[0] == '[' ? "body,name\n0,left + right\n" : "body,name\n0,bar\n");
  }
}

TEST(Bodies, ASolidOfTwoVolumesStartsWithTheSameBitsOnAnyNumberOfRanks) {
  const Scratch scratch;
  scratch.write("bar.geo", kGeometry + kTwoGroups);
  const std::string text = bar("[\"left\", \"right\"]", "angular = [1, 2, 500]\nrandom = [1, 2]\nseed = 5", "5 us");
  const BarRun one = run(scratch, text);
  ASSERT_EQ(one.outcome.exit_code, 0) << one.outcome.err;
  for (const int ranks : {2, 3}) {
    const BarRun several = run(scratch, text, ranks);
    ASSERT_EQ(several.outcome.exit_code, 0) << several.outcome.err;
    EXPECT_EQ(several.hash(), one.hash());
    EXPECT_EQ(read_text(several.folder / "bodies.csv"), read_text(one.folder / "bodies.csv"));
  }
}

TEST(Bodies, VolumesOfOneGroupThatAreNotJoinedAreWarnedOfByEveryCommandThatMeshes) {
  const Scratch scratch;
  scratch.write("bar.geo", kGeometry + kOneGroup);
  std::string text = bar("\"bar\"", "velocity = [1, 0, 0]", "1 us");
  text.replace(text.find("glue = true"), 11, "glue = false");
  const std::string words = "Volumes of \"bar\" touch along";
  const BarRun apart = run(scratch, text);
  EXPECT_EQ(apart.outcome.exit_code, 0) << apart.outcome.err;
  const std::size_t at = apart.outcome.err.find("breccia: warning: " + words);
  EXPECT_NE(at, std::string::npos) << apart.outcome.err;
  EXPECT_EQ(apart.outcome.err.find(words, at + 30), std::string::npos) << "once: " << apart.outcome.err;
  const std::string file = scratch.write("case.toml", text);
  EXPECT_NE(call("check " + file).out.find(words), std::string::npos);
  EXPECT_NE(call("mesh " + file).err.find(words), std::string::npos);
  EXPECT_NE(run(scratch, text, 2).outcome.err.find(words), std::string::npos);
}

}  // namespace
}  // namespace breccia::test::bodies_test
