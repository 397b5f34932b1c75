#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "end_to_end/program.hpp"
#include "support/notched_beam.hpp"
#include "support/replaced.hpp"

/// Runs that start from the state of another one under a case of their own.
namespace breccia::test::start_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The stages of the whole, each as a text.
const std::string kFly =
    "[[stage]]\nname = \"fly\"\nend = \"2 ms\"\n"
    "[[stage.constraint]]\ngroup = \"box.x0\"\nvelocity = { z = 0 }\n";
const std::string kPush =
    "[[stage]]\nname = \"push\"\nend = \"3 ms\"\nmass_damping = 20\ngravity = [0, 0, \"-9.81 m/s2\"]\n"
    "[[stage.pressure]]\nsurface = \"box.x1\"\nvalue = \"1 kPa\"\n";
const std::string kOutput = "[output]\nframe_interval = \"1 ms\"\nhistory_interval = \"100 us\"\n";

/// Boxes that break at strengths that scatter, flow plastically, touch and rub; without stages and output.
std::string model_text() {
  const std::string text = replaced(
      changed("poisson = 0.3",
              "poisson = 0.3\nlaw = \"drucker_prager\"\nfriction_angle = \"30 deg\"\ndilation_angle = \"10 deg\"\n"
              "cohesion = \"20 kPa\"\nhardening = \"100 kPa\"\nviscosity = 5"),
      "penalty_factor = 10", "penalty_factor = 10\nweibull_modulus = 8");
  return text.substr(0, text.find("[[stage]]"));
}

json json_of(const fs::path& file) { return json::parse(read_text(file), nullptr, false); }

class Start : public testing::Test {
 protected:
  /// A run of the first stage, with checkpoints every 100 steps and at its end.
  Start() { run("parent", model_text() + kFly + kOutput, 1, "--set checkpoint.steps=100 --set checkpoint.keep=50"); }

  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path(name); }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + folder(name).string() + "'"; }
  [[nodiscard]] json summary(const std::string& name) const { return json_of(folder(name) / "summary.json"); }

  Outcome attempt(const std::string& name, const std::string& text, int ranks = 1, const std::string& settings = "",
                  const std::string& command = "run") {
    const std::string file = scratch_.write(name + ".toml", text);
    const std::string rest = command == "run" ? " --progress none -o " + quoted(name) + " " + settings : " " + settings;
    return ranks == 1 ? call(command + " " + file + rest) : call_ranks(ranks, command + " " + file + rest);
  }
  void run(const std::string& name, const std::string& text, int ranks = 1, const std::string& settings = "") {
    const Outcome outcome = attempt(name, text, ranks, settings);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  void expect_same_state(const std::string& name, const std::string& other) {
    EXPECT_EQ(summary(name).at("state_hash"), summary(other).at("state_hash")) << name;
    EXPECT_EQ(summary(name).at("energy"), summary(other).at("energy")) << name;
    EXPECT_EQ(summary(name).at("broken_joints"), summary(other).at("broken_joints")) << name;
  }
  /// Of the geometry that a run was made from, as it says.
  [[nodiscard]] std::string mesh_hash(const std::string& name) const {
    const json provenance = json_of(folder(name) / "provenance.json");
    for (const json& input : provenance.at("inputs")) {
      if (input.at("file").get<std::string>().ends_with(".geo")) return input.at("sha256");
    }
    return "none";
  }
  /// The parent's model without what the state fixes.
  [[nodiscard]] static std::string laws() {
    const std::string text = model_text();
    const std::size_t from = text.find("[[material]]"), to = text.find("[[initial_velocity]]");
    return text.substr(from, to - from);
  }
  /// What the state fixes as it is there.
  [[nodiscard]] static std::string with_all_sections() {
    return replaced(model_text(), "[mesh.raster]", started() + "[mesh.raster]") + kPush + kOutput;
  }
  [[nodiscard]] static std::string started(const std::string& from = "parent", const std::string& more = "") {
    return "[start]\nfrom = \"" + from + "\"\n" + more;
  }

  Scratch scratch_;
};

TEST_F(Start, UnderTheSameLawsGivesTheBitsOfTheRunThatHadBothStages) {
  run("whole", model_text() + kFly + kPush + kOutput);
  ASSERT_GT(summary("whole").at("broken_joints"), 0);
  for (const int ranks : {1, 2, 3}) {
    const std::string name = "on_" + std::to_string(ranks);
    run(name, started() + laws() + kPush + kOutput, ranks);
    expect_same_state(name, "whole");
  }
  run("with_all_sections", with_all_sections());
  expect_same_state("with_all_sections", "whole");
}

TEST_F(Start, UnderOtherLawsGivesTheSameBitsOnAnyNumberOfRanksAndSaysWhatBecomesOfTheEnergies) {
  std::string other = replaced(laws(), "young = \"4 MPa\"", "young = \"6 MPa\"");
  other = replaced(other, "tensile_strength = \"20 kPa\"", "tensile_strength = \"12 kPa\"");
  other = replaced(other, "friction = 0.3", "friction = 0.1");
  for (const int ranks : {1, 2, 4}) run("on_" + std::to_string(ranks), started() + other + kPush + kOutput, ranks);
  expect_same_state("on_2", "on_1");
  expect_same_state("on_4", "on_1");
  EXPECT_EQ(energy_fault(folder("on_1") / "history.csv"), "");
  const json energy = summary("on_1").at("energy");
  EXPECT_LT(std::abs(energy.at("residual").get<double>()), 0.01 * energy.at("kinetic").get<double>());
  EXPECT_NE(read_text(folder("on_1") / "status.jsonl").find("counts as put in, and the residual from here"),
            std::string::npos);
  run("as_it_was", started() + laws() + kPush + kOutput);
  EXPECT_NE(summary("on_1").at("state_hash"), summary("as_it_was").at("state_hash"));
}

TEST_F(Start, TakesTheCheckpointOfATimeOrAStep) {
  const std::string rest = laws() + kFly + kPush + kOutput;
  run("whole", model_text() + kFly + kPush + kOutput);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder("parent") / "checkpoints")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GT(files.size(), 2U);
  run("by_step", started("parent", "step = 100\n") + laws() + kPush + kOutput);
  EXPECT_EQ(json_of(folder("by_step") / "provenance.json").at("parents").at(0).at("step"), 100);
  run("by_file", started("parent/checkpoints/" + files.front().filename().string()) + laws() + kPush + kOutput);
  expect_same_state("by_file", "by_step");
  run("by_time", started("parent", "at = \"2 ms\"\n") + laws() + kPush + kOutput);
  expect_same_state("by_time", "whole");
}

TEST_F(Start, CanBeKilledAndResumedWithoutItsParent) {
  run("straight", started() + laws() + kPush + kOutput);
  run("broken_off", started() + laws() + kPush + kOutput, 2, "--set time.max_steps=60 --set checkpoint.steps=20");
  EXPECT_EQ(summary("broken_off").at("steps").get<int>(), 60 + summary("parent").at("steps").get<int>());
  fs::remove_all(folder("parent"));
  const Outcome resumed = call("resume " + quoted("broken_off") + " --progress none --set time.max_steps=0");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  expect_same_state("broken_off", "straight");
}

TEST_F(Start, NamesItsParentsInTheProvenanceAndInDiff) {
  run("child", started() + laws() + kPush + kOutput);
  run("grandchild", started("child") + laws() + replaced(kPush, "3 ms", "3.2 ms") + kOutput);
  const json parents = json_of(folder("grandchild") / "provenance.json").at("parents");
  ASSERT_EQ(parents.size(), 2U);
  EXPECT_EQ(parents.at(0).at("step"), summary("child").at("steps"));
  EXPECT_EQ(parents.at(1).at("step"), summary("parent").at("steps"));
  EXPECT_EQ(parents.at(0).at("sha256").get<std::string>().size(), 64U);
  const Outcome diff = call("diff " + quoted("child") + " " + quoted("grandchild"));
  EXPECT_NE(diff.out.find("parents[1].sha256: (none) | "), std::string::npos) << diff.out;
  EXPECT_NE(diff.out.find("start.from: "), std::string::npos) << diff.out;
}

TEST_F(Start, RefusesEveryChangeThatTheStateDoesNotAllow) {
  const std::string whole = with_all_sections();
  struct Change {
    const char* from;
    const char* to;
    const char* key;
    const char* why;
  };
  for (const Change& change : std::vector<Change>{
           {"cells = [2, 2, 1]", "cells = [2, 2, 2]", "mesh.raster.cells", "elements and nodes"},
           {"2340 kg/m3", "2400 kg/m3", "material[0].density", "momentum"},
           {"joints = \"breakable\"", "joints = \"unbreakable\"", "material[0].joints", "contact couples"},
           {"penalty_factor = 10", "penalty_factor = 10\nlaw = \"independent_peaks\"", "joint[0].law", "damage"},
           {"penalty_factor = 10", "penalty_factor = 10\npoints = \"mid_edge\"", "joint[0].points", "damage"},
           {"weibull_modulus = 8", "weibull_modulus = 9", "joint[0].weibull_modulus", "relative to the mean"},
           {"weibull_modulus = 8", "weibull_modulus = 8\nweibull_seed = 2", "joint[0].weibull_seed",
            "relative to the mean"},
           {"[\"1 m/s\", \"2 m/s\"]", "[\"1 m/s\", \"3 m/s\"]", "initial_velocity[0].random", "first run"},
           {"radius = \"26 mm\"", "radius = \"27 mm\"", "sphere.radius", "press on it"},
           {"[[stage]]", "[contact_points]\nper_face = 6\n[[stage]]", "contact_points.per_face", "points"},
           {"[[stage]]", "[joints]\nbroken = [\"box.x0\"]\n[[stage]]", "joints.broken", "stage.broken"}}) {
    for (const char* command : {"run", "check"}) {
      const Outcome refused = attempt("refused", replaced(whole, change.from, change.to), 1, "", command);
      EXPECT_EQ(refused.exit_code, 2) << change.key;
      for (const std::string word : {"refused.toml:", change.key, "cannot change where a run starts from", change.why})
        EXPECT_NE(refused.err.find(word), std::string::npos) << word << "\n" << refused.err;
    }
  }
  EXPECT_FALSE(fs::exists(folder("refused")));
}

TEST_F(Start, IsFollowedByCheckAndMeshAndRefusedByRace) {
  const std::string text = started() + laws() + kPush + kOutput;
  const Outcome check = attempt("case", text, 1, "", "check"), mesh = attempt("case", text, 1, "", "mesh");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("starts from step "), std::string::npos) << check.out;
  EXPECT_EQ(check.out.find("overlap"), std::string::npos) << check.out;
  const Outcome whole = attempt("whole", model_text() + kFly + kPush + kOutput, 1, "", "check");
  const auto steps = [](const Outcome& outcome) {
    const std::size_t at = outcome.out.find(" steps of ");
    return std::stod(outcome.out.substr(outcome.out.rfind('\n', at) + 1));
  };
  EXPECT_NEAR(steps(check) / steps(whole), 1.0 / 3.0, 0.01);
  EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
  EXPECT_NE(mesh.out.find("elements"), std::string::npos) << mesh.out;
  const Outcome race = attempt("case", text, 1, "", "race");
  EXPECT_EQ(race.exit_code, 2);
  EXPECT_NE(race.err.find("case.toml:1: start: a race begins at the first step of its case"), std::string::npos)
      << race.err;
}

TEST_F(Start, RefusesADisplacementThatJumpsAtTheTimeOfTheState) {
  const auto pulled = [](const std::string& value) {
    return started() + laws() + "[[stage]]\nend = \"3 ms\"\n[[stage.constraint]]\ngroup = \"box.x0\"\n" +
           "displacement = { x = { " + value + " } }\n";
  };
  for (const char* command : {"run", "check"}) {
    const Outcome jump = attempt("jump", pulled("linear = \"0.1 m/s\""), 1, "", command);
    EXPECT_EQ(jump.exit_code, 2) << command;
    EXPECT_NE(jump.err.find("displacement.x: jumps in the first step of its stage"), std::string::npos) << jump.err;
  }
  run("smooth", pulled("ramp = { start = \"2 ms\", end = \"3 ms\", to = \"0.1 mm\" }"));
}

TEST_F(Start, RefusesConstraintsThatContradictEachOtherOnAnyNumberOfRanks) {
  const auto held = [](const std::string& group, const std::string& axis) {
    return "[[stage.constraint]]\ngroup = \"" + group + "\"\nvelocity = { " + axis + " = \"0.1 m/s\" }\n";
  };
  const std::string stage = started() + laws() + "[[stage]]\nend = \"3 ms\"\n" + held("box.x0", "x");
  std::set<std::string> messages;
  for (const int ranks : {1, 2, 3}) {
    const Outcome refused = attempt("refused", stage + "[[stage.constraint]]\ngroup = \"box\"\nfixed = \"x\"\n", ranks);
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    const std::size_t at = refused.err.find("contradicts stage[0].constraint[0] (velocity, \"box.x0\", line ");
    ASSERT_NE(at, std::string::npos) << refused.err;
    messages.insert(refused.err.substr(at, refused.err.find('\n', at) - at));
    const Outcome overruled = attempt("over" + std::to_string(ranks),
                                      stage + "[[stage.constraint]]\ngroup = \"box.y0\"\nfixed = \"x\"\n", ranks);
    EXPECT_EQ(overruled.exit_code, 0) << overruled.err;
    EXPECT_NE(overruled.err.find("overrules stage[0].constraint[0]"), std::string::npos) << overruled.err;
  }
  EXPECT_EQ(messages.size(), 1U) << *messages.begin() << "\n" << *messages.rbegin();
}

TEST_F(Start, RefusesAJointEntryThatStandsForNoGroup) {
  const std::string any = "[[joint]]\ngroup = \"*\"\npenalty_factor = 10\n";
  const Outcome with_any = attempt("any", started() + replaced(laws(), "[[contact]]", any + "[[contact]]") + kPush);
  EXPECT_EQ(with_any.exit_code, 2) << with_any.err;
  EXPECT_NE(with_any.err.find("joint[1].group: stands for no group"), std::string::npos) << with_any.err;
  const Outcome used =
      attempt("used", started() + replaced(laws(), "[[joint]]\ngroup = \"box\"", "[[joint]]\ngroup = \"*\"") + kPush);
  EXPECT_EQ(used.exit_code, 0) << used.err;
  EXPECT_EQ(used.err.find("stands for no group"), std::string::npos) << used.err;
}

TEST_F(Start, RefusesWhatDoesNotFitTheState) {
  const std::string no_contact = laws().substr(0, laws().find("[[contact]]"));
  for (const auto& [text, message] :
       {std::pair{started() + no_contact + kPush, "contact: cannot change"},
        {started() + laws() + kFly, "stage[0].end: the state that the run starts from is later"},
        {started() + laws() + replaced(kPush, "box.x1", "box.w1"), "box.w1"},
        {started("parent", "at = \"7 ms\"\n") + laws() + kPush, "start.at: the run has no such checkpoint; allowed"},
        {started("parent", "step = 7\n") + laws() + kPush, "start.step: the run has no such checkpoint"},
        {started("parent", "step = 100\nat = \"1 ms\"\n") + laws() + kPush, "only one of at, step"},
        {started("parent", "step = -3\n") + laws() + kPush, "start.step"},
        {started("nowhere") + laws() + kPush, "start.from: there is no such run"},
        {started("refused.toml") + laws() + kPush, "start.from: this is no checkpoint of breccia"},
        {started("parent/frames") + laws() + kPush, "start.from: there are no checkpoints of a run here"},
        {started("parent/checkpoints") + laws() + kPush, "start.from: this is the folder of a run's checkpoints"},
        {"[start]\nat = \"1 ms\"\n" + laws() + kPush, "start.from: is missing"},
        {"start = 3\n" + laws() + kPush, "start"}}) {
    for (const int ranks : {1, 2}) {
      const Outcome refused = attempt("refused", text, ranks);
      EXPECT_EQ(refused.exit_code, 2) << message;
      EXPECT_NE(refused.err.find(message), std::string::npos) << message << "\n" << refused.err;
    }
  }
  const Outcome own = attempt("parent", started() + laws() + kPush, 1, "-f");
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_NE(own.err.find("this folder holds the state"), std::string::npos) << own.err;
  EXPECT_EQ(summary("parent").at("status"), "complete");
}

TEST_F(Start, MayBreakASurfaceThatTheFirstRunLeftWhole) {
  scratch_.write("beam.geo", kNotchedBeam);
  const std::string beam =
      "[[material]]\ngroup = \"beam\"\nyoung = \"4 GPa\"\npoisson = 0.2\ndensity = 2400\n"
      "[[joint]]\ngroup = \"beam\"\npenalty_factor = 20\ntensile_strength = \"50 MPa\"\n"
      "energy_mode_1 = \"5 kJ/m2\"\n[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"4 GPa\"\n";
  const std::string mesh = "[mesh]\nfile = \"beam.geo\"\nglue = true\n";
  const std::string fall = "[[stage]]\nend = \"1 ms\"\ngravity = [0, -500, 0]\n";
  const std::string hold =
      "[[stage]]\nend = \"3 ms\"\nbroken = [\"notch\"]\ngravity = [0, -500, 0]\n"
      "[[stage.constraint]]\ngroup = \"foot\"\nvelocity = { x = \"2 m/s\" }\n";
  run("whole", mesh + beam + fall + hold);
  run("beam", mesh + beam + fall);
  for (const int ranks : {1, 2}) {
    const std::string name = "broken_" + std::to_string(ranks);
    run(name, started("beam") + beam + hold, ranks);
    expect_same_state(name, "whole");
  }
  EXPECT_GT(summary("whole").at("broken_joints"), 0);
  std::ofstream(folder("beam.geo"), std::ios::app) << "MeshSize{:} = 0.25;\n";
  const Outcome refused = attempt("refused", started("beam") + mesh + beam + hold);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("mesh.file: cannot change"), std::string::npos) << refused.err;
  run("inherited", started("beam") + beam + hold);
  EXPECT_EQ(mesh_hash("inherited"), mesh_hash("beam")) << "what stands there now was never read";
  const Outcome again = attempt("refused", started("inherited") + mesh + beam + replaced(hold, "3 ms", "4 ms"));
  EXPECT_NE(again.err.find("mesh.file: cannot change"), std::string::npos) << again.err;
  fs::remove(folder("beam.geo"));
  run("without_its_mesh", started("beam") + mesh + beam + hold);
  expect_same_state("without_its_mesh", "whole");
}

TEST_F(Start, CollapsesACoolingTowerThatHasSettled) {
  const std::string meshes = BRECCIA_MESHES "/cooling_tower/";
  const Outcome settled = call("run '" + meshes + "case_smoke.toml' --progress none -o " + quoted("settled"));
  ASSERT_EQ(settled.exit_code, 0) << settled.err;
  const json energy = summary("settled").at("energy");
  EXPECT_LT(std::abs(energy.at("residual").get<double>()), 1e-6 * energy.at("external_work").get<double>())
      << "joints of one law lie beside those of a weaker one";
  for (const std::string test : {"a", "b"}) {
    const Outcome fallen =
        call_ranks(2, "run '" + meshes + "case_" + test + ".toml' --progress none -o " + quoted(test) +
                          " --set start.from=" + quoted("settled") + " --set time.max_steps=300");
    ASSERT_EQ(fallen.exit_code, 0) << fallen.err;
    EXPECT_GT(summary(test).at("broken_joints"), 0) << "the front of the foot";
    EXPECT_EQ(energy_fault(folder(test) / "history.csv"), "");
  }
}

TEST_F(Start, ChoosesAmongTheCheckpointsThatCanBeRead) {
  const fs::path damaged = folder("parent") / "checkpoints" / "step_000000000100.h5";
  const std::string sound = read_text(damaged);
  std::ofstream(damaged, std::ios::binary) << sound.substr(0, sound.size() / 2);
  const std::string rest = laws() + kPush;
  run("by_time", started("parent", "at = \"2 ms\"\n") + rest, 1, "--set time.max_steps=2");
  run("by_step", started("parent", "step = 200\n") + rest, 1, "--set time.max_steps=2");
  const Outcome other = attempt("refused", started("parent", "at = \"7 ms\"\n") + rest);
  EXPECT_NE(other.err.find("cannot be read: step_000000000100.h5; allowed: step "), std::string::npos) << other.err;
  const Outcome itself = attempt("refused", started("parent", "step = 100\n") + rest);
  EXPECT_EQ(itself.exit_code, 2);
  EXPECT_NE(itself.err.find("cut off"), std::string::npos) << itself.err;
}

TEST_F(Start, TakesTheLastStateOfARunThatHasEndedOnly) {
  const int lock = open((folder("parent") / "run.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);
  const Outcome early = attempt("refused", started() + laws() + kPush);
  EXPECT_EQ(early.exit_code, 2);
  EXPECT_NE(early.err.find("start.from: this run is in progress"), std::string::npos) << early.err;
  run("by_step", started("parent", "step = 100\n") + laws() + kPush, 1, "--set time.max_steps=2");
  close(lock);
  run("ended", started() + laws() + kPush, 1, "--set time.max_steps=2");
}

TEST_F(Start, TakesTheSameCheckpointOnRanksThatSeeDifferentOnes) {
  run("on_1", started() + laws() + kPush);
  fs::create_directories(folder("other"));
  fs::copy(folder("parent"), folder("other") / "parent", fs::copy_options::recursive);
  fs::path last;
  for (const auto& entry : fs::directory_iterator(folder("other") / "parent" / "checkpoints"))
    last = std::max(last, entry.path());
  fs::remove(last);
  const std::string command = "run " + quoted("on_1.toml") + " --progress none -o " + quoted("on_2");
  fs::copy(folder("on_1.toml"), folder("other/on_1.toml"));
  const Outcome outcome =
      call_each_rank({{command, ""}, {replaced(command, quoted("on_1.toml"), quoted("other/on_1.toml")), ""}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_same_state("on_2", "on_1");
}

TEST_F(Start, NeverTakesAnEarlierStateThanTheOneAskedFor) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder("parent") / "checkpoints")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const std::string sound = read_text(files.back());
  const std::string text = started() + laws() + kPush;
  std::ofstream(files.back(), std::ios::binary) << sound.substr(0, sound.size() / 2);
  for (const int ranks : {1, 2}) {
    const Outcome cut = attempt("refused", text, ranks);
    EXPECT_EQ(cut.exit_code, 2);
    EXPECT_NE(cut.err.find("cut off"), std::string::npos) << cut.err;
    EXPECT_NE(cut.err.find(files.back().filename().string()), std::string::npos) << cut.err;
  }
  std::string flipped = sound;
  flipped[sound.size() / 3] = static_cast<char>(flipped[sound.size() / 3] ^ 4);
  std::ofstream(files.back(), std::ios::binary) << flipped;
  for (const char* command : {"run", "check"}) {
    const Outcome bad = attempt("refused", text, 1, "", command);
    EXPECT_EQ(bad.exit_code, 2) << command;
    EXPECT_NE(bad.err.find("damaged"), std::string::npos) << bad.err;
  }
}

}  // namespace
}  // namespace breccia::test::start_test
