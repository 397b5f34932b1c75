#include <gtest/gtest.h>
#include <signal.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "end_to_end/program.hpp"

namespace breccia::test::program_test {
namespace {

using nlohmann::json;

/// Runs the small case and returns its summary.
json summary_of(const Scratch& scratch, const std::string& arguments, const std::string& environment = "") {
  const std::string file = scratch.write("case.toml", kSmallCase);
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run " + file + " -f --progress none -o '" + folder + "' " + arguments, environment);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(read_text(folder + "/summary.json"));
}

TEST(Program, TellsItsVersionAndHelps) {
  EXPECT_NE(call("--version").out.find("breccia"), std::string::npos);
  for (const char* command : {"", "run", "race", "check", "mesh", "explain"}) {
    const Outcome outcome = call(std::string(command) + " --help");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_GT(outcome.out.size(), 200u) << command;
  }
}

TEST(Program, ExplainsEverySectionAndAKey) {
  const Outcome all = call("explain");
  EXPECT_EQ(all.exit_code, 0);
  for (const char* section : {"mesh", "material", "joint", "contact", "stage", "time", "detection", "output"}) {
    EXPECT_NE(all.out.find(section), std::string::npos) << section;
  }
  EXPECT_NE(call("explain material.young").out.find("Pa"), std::string::npos);
}

TEST(Program, ARunLeavesEverythingItPromises) {
  const Scratch scratch;
  const json summary = summary_of(scratch, "");
  for (const char* name :
       {"ranks", "steps", "simulated_time", "elements", "joints", "broken_joints", "fragments", "wall_s",
        "element_steps_per_s", "phases", "energy", "energy_residual_relative", "max_rss_bytes", "state_hash"}) {
    EXPECT_TRUE(summary.contains(name)) << name;
  }
  EXPECT_EQ(summary["status"], "complete");
  EXPECT_EQ(summary["elements"], 2 * 4 * 24);
  EXPECT_GT(summary["broken_joints"].get<int>(), 0) << "the case is meant to break something";
  constexpr double kResidual = 1e-3;  // the limit for every case of the repository
  EXPECT_LT(summary["energy_residual_relative"].get<double>(), kResidual);
  for (const char* file : {"case.toml", "provenance.json", "bodies.csv", "history.csv", "status.jsonl", "summary.txt",
                           "frames/elements.hdf.series"}) {
    EXPECT_TRUE(std::filesystem::exists(scratch.path("run") / file)) << file;
  }
}

TEST(Program, BoxesThatBurstIntoDebrisCreateNoEnergy) {
  // At half the speed of sound everything is crushed, slides far on closed cracks and ends as single tetrahedra that
  // overlap.
  const Scratch scratch;
  const json summary = summary_of(scratch,
                                  "--set time.safety=0.2 --set 'stage[0].end=2 ms' "
                                  "--set 'initial_velocity[0].random=[\"10 m/s\", \"20 m/s\"]'");
  constexpr double kStepError = 0.02;  // falls with the step; a jump in overlap or force costs several per cent at once
  EXPECT_LT(summary["energy_residual_relative"].get<double>(), kStepError);
  EXPECT_GT(summary["energy"]["joint_friction"].get<double>(), -1e-3 * summary["energy"]["kinetic"].get<double>());
  EXPECT_GT(summary["fragments"].get<int>(), 150);
}

TEST(Program, TheResolvedCaseGivesTheSameBitsAgain) {
  const Scratch scratch;
  const json first = summary_of(scratch, "");
  const std::string again = scratch.path("again").string();
  const Outcome outcome =
      call("run '" + scratch.path("run/case.toml").string() + "' --progress none -o '" + again + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(read_text(again + "/summary.json"))["state_hash"], first["state_hash"]);
}

TEST(Program, EveryDetectionAlgorithmGivesTheSameBits) {
  const Scratch scratch;
  const json reference = summary_of(scratch, "");
  for (const char* algorithm : {"ms", "ms_slices", "brute_force"}) {
    const json other = summary_of(scratch, std::string("--set detection.algorithm=") + algorithm);
    EXPECT_EQ(other["state_hash"], reference["state_hash"]) << algorithm;
  }
}

TEST(Program, CouplesAreNeverMissed) {
  const Scratch scratch;
  const json reference = summary_of(scratch, "");
  EXPECT_EQ(summary_of(scratch, "--set detection.verify=true")["state_hash"], reference["state_hash"]);
}

TEST(Program, TheBufferChangesNothingButSpeed) {
  const Scratch scratch;
  const json reference = summary_of(scratch, "");
  EXPECT_EQ(summary_of(scratch, "--set 'detection.buffer=4 mm'")["state_hash"], reference["state_hash"]);
}

TEST(Program, EverySimdWidthGivesTheSameBits) {
  const Scratch scratch;
  const json narrow = summary_of(scratch, "", "BRECCIA_SIMD=sse2");
  EXPECT_EQ(narrow["simd"], "sse2");
  for (const char* width : {"avx2", "avx512"}) {
    // A machine without the set falls back to one it has: still the same bits.
    EXPECT_EQ(summary_of(scratch, "", std::string("BRECCIA_SIMD=") + width)["state_hash"], narrow["state_hash"])
        << width;
  }
}

TEST(Program, OldResultsAreKeptUnlessToldOtherwise) {
  const Scratch scratch;
  summary_of(scratch, "");
  const std::string folder = scratch.path("run").string();
  const Outcome outcome = call("run '" + scratch.path("case.toml").string() + "' --progress none -o '" + folder + "'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find(folder), std::string::npos) << outcome.err;
}

TEST(Program, AnExplodingRunStopsWithCode3AndLeavesItsLastFrame) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const std::string folder = scratch.path("run").string();
  const Outcome outcome =
      call("run " + file + " --progress none --set 'time.step=1 ms' --set 'stage[0].end=1 s' -o '" + folder + "'");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("step"), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder + "/summary.json"));
  EXPECT_NE(json::parse(read_text(folder + "/summary.json"))["status"], "complete");
}

TEST(Program, JsonProgressIsOneObjectALine) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const Outcome outcome = call("run " + file + " --progress json -o '" + scratch.path("run").string() + "'");
  ASSERT_EQ(outcome.exit_code, 0);
  std::istringstream lines(outcome.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_TRUE(json::parse(line).contains("step")) << line;
  EXPECT_GE(count, 2);
}

TEST(Program, AFullDiskStopsTheRunWithCode2) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  // No file may grow past 8 blocks of 1 kB: the frames do not fit.
  const Outcome outcome =
      call("run " + file + " --progress none -o '" + scratch.path("run").string() + "'", "ulimit -f 8;");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("frames"), std::string::npos) << outcome.err;
}

TEST(Program, AnInterruptEndsTheRunInOrder) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const std::filesystem::path folder = scratch.path("run");
  const std::string arguments =
      "run " + file + " --progress none --set 'stage[0].end=100 s' -o '" + folder.string() + "'";
  EXPECT_EQ(call_interrupted(arguments, SIGINT,
                             [&] { return std::filesystem::exists(folder / "frames/elements.hdf.series"); }),
            130);
  EXPECT_EQ(json::parse(read_text(folder / "summary.json"))["status"].get<std::string>().substr(0, 7), "stopped");
}

TEST(Program, GivesUpAMeshThatTakesTooLongWhenItIsInterrupted) {
  const Scratch scratch;
  std::string text = changed("[mesh.raster]", "[mesh]\nfile = \"endless.geo\"\n[ignored]");
  const std::size_t ignored = text.find("[ignored]");
  const std::string file = scratch.write("case.toml", text.erase(ignored, text.find("[[material]]") - ignored));
  scratch.write("endless.geo", "For i In {1:1000000000}\n  For j In {1:1000000000}\n    x = i;\n  EndFor\nEndFor\n");
  const std::string err = scratch.path("err").string();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(
      call_interrupted("run " + file + " --progress log -o '" + scratch.path("run").string() + "' 2> '" + err + "'",
                       SIGINT, [&] { return read_text(err).find("reading the mesh") != std::string::npos; }),
      130);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_NE(read_text(err).find("interrupted while the mesh was read"), std::string::npos) << read_text(err);
  EXPECT_FALSE(std::filesystem::exists(scratch.path("run")));
}

TEST(Program, GivesUpALargeModelBeforeItsFirstStepWhenItIsInterrupted) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", changed("cells = [2, 2, 1]", "cells = [20, 20, 20]"));
  const std::string err = scratch.path("err").string(), run = scratch.path("run").string();
  for (const auto& [phase, words] : {std::pair{"reading the mesh", "interrupted; nothing has been written"},
                                     {"dividing the model", "interrupted before the first step"}}) {
    EXPECT_EQ(call_interrupted("run " + file + " --progress log -f -o '" + run + "' 2> '" + err + "'", SIGTERM,
                               [&] { return read_text(err).find(phase) != std::string::npos; }),
              143);
    EXPECT_NE(read_text(err).find(std::string("breccia: error: ") + words + "\n"), std::string::npos)
        << read_text(err);
  }
  EXPECT_FALSE(std::filesystem::exists(run + "/summary.json"));
}

TEST(Program, ThatIsKilledIsToldInterruptedAndLeavesItsFolderFree) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), run = scratch.path("run").string();
  const std::string arguments = "run " + file + " --progress none --set 'stage[0].end=100 s' -o '" + run + "'";
  const auto status = [&] { return read_text(run + "/status.jsonl"); };
  bool refused = false;
  EXPECT_EQ(call_interrupted(arguments, SIGKILL,
                             [&] {
                               if (status().empty()) return false;
                               const Outcome second = call(arguments + " -f");
                               refused = second.exit_code == 2 && second.err.find("another run") != std::string::npos;
                               return true;
                             }),
            -1);
  EXPECT_TRUE(refused) << "two runs in one folder";
  for (int look = 0; look < 100 && status().find("interrupted") == std::string::npos; ++look)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_NE(status().find("{\"state\":\"interrupted\""), std::string::npos) << status();
  EXPECT_EQ(call("run " + file + " -f --progress none --set time.max_steps=3 -o '" + run + "'").exit_code, 0);
}

TEST(Program, WhoseTerminalIsClosedOrWhoseTimeIsUpEndsAsIfAskedTo) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), run = scratch.path("run").string();
  for (const int signal : {SIGHUP, SIGUSR2, SIGXCPU}) {
    std::filesystem::remove_all(run);
    EXPECT_EQ(call_interrupted("run " + file + " --progress none --set 'stage[0].end=100 s' -o '" + run + "'", signal,
                               [&] { return !read_text(run + "/status.jsonl").empty(); }),
              128 + signal);
    EXPECT_NE(read_text(run + "/status.jsonl").find("{\"state\":\"stopped\""), std::string::npos) << signal;
  }
}

TEST(Program, CheckAdvisesInSentences) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const Outcome outcome = call("check " + file);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* fragment : {"stable time step", "limited by", "softer", "memory", "fracture process zone",
                               "steps of", "5 frames", "on disk"}) {
    EXPECT_NE(outcome.out.find(fragment), std::string::npos) << fragment << " in\n" << outcome.out;
  }
}

/// The number that stands before some words.
double number_before(const std::string& text, const std::string& words) {
  const std::size_t end = text.find(words);
  if (end == std::string::npos) throw std::runtime_error("no \"" + words + "\" in\n" + text);
  return std::stod(text.substr(text.find_last_of(' ', end - 1) + 1));
}

TEST(Program, CheckTellsHowMuchSofterJointsMakeTheBody) {
  const Scratch scratch;
  const Outcome outcome = call("check " + scratch.write("case.toml", kSmallCase));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // Joints in a cube of edge a: 24 triangles centre - face - corner of a^2/(4 sqrt 2), 12 centre - edge of
  // a^2/(2 sqrt 2); and in a box of 2 x 2 cubes four faces between cubes.
  constexpr double kEdge = 0.01, kYoung = 4e6;  // m, Pa
  const double area_per_volume = (4 * (24 / (4 * std::sqrt(2.0)) + 12 / (2 * std::sqrt(2.0))) + 4) / (4 * kEdge);
  const double softness = kYoung * area_per_volume / (3 * number_before(outcome.out, " Pa/m with"));
  constexpr double kTwoDigits = 0.05;  // as many as are told
  EXPECT_NEAR(number_before(outcome.out, " % softer") / (100 * softness), 1.0, kTwoDigits);
  EXPECT_NEAR(number_before(outcome.out, " % softer. For 5 %") / (100 * softness), 1.0, kTwoDigits);
}

TEST(Program, CheckTellsAlongWhichDirectionJointsOfFlatElementsMakeTheBodySoftest) {
  const Scratch scratch;
  const std::string flat =
      "--set 'mesh.raster.cells=[10, 1, 1]' --set 'mesh.raster.cell_size=[\"1 mm\", \"4 mm\", \"4 mm\"]'";
  const Outcome outcome = call("check " + scratch.write("case.toml", kSmallCase) + " " + flat);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // Joints of a cell of a x b x b by the squares of their normals along a: 16 triangles centre - face - corner and 8
  // centre - edge, 2 b^3 / sqrt(a^2 + b^2) each kind, and nine faces b^2 between ten cells.
  constexpr double kThin = 1e-3, kWide = 4e-3, kYoung = 4e6;  // m, Pa
  const double areas = 4 * kWide / (kThin * std::hypot(kThin, kWide)) + 0.9 / kThin;
  const double softness = kYoung * areas / number_before(outcome.out, " Pa/m with");
  constexpr double kTwoDigits = 0.05;  // as many as are told
  EXPECT_NEAR(number_before(outcome.out, " % along x") / (100 * softness), 1.0, kTwoDigits);
  EXPECT_NEAR(number_before(outcome.out, " % softer along x. For 5 %") / (100 * softness), 1.0, kTwoDigits);
}

TEST(Program, CheckTellsHowRanksWouldShareTheModel) {
  const Scratch scratch;
  const Outcome outcome =
      call("check " + scratch.write("case.toml", kSmallCase) + " --ranks 3 --set mesh.raster.boxes=[12,1,1]");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* fragment :
       {"1152 elements, 3 domains, rcb", "predicted efficiency", "cut faces", "Contact is not included"}) {
    EXPECT_NE(outcome.out.find(fragment), std::string::npos) << fragment << " in\n" << outcome.out;
  }
}

TEST(Program, MeshReportsAndWritesTheElements) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const Outcome outcome = call("mesh " + file + " -o '" + scratch.path("mesh").string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("192 elements"), std::string::npos) << outcome.out;
  EXPECT_TRUE(std::filesystem::exists(scratch.path("mesh/elements.hdf.series")));
}

TEST(Program, AMeshDoesNotTakeThePlaceOfTheFramesOfARun) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase), run = scratch.path("run").string();
  ASSERT_EQ(call("run " + file + " --set time.max_steps=10 -o '" + run + "'").exit_code, 0);
  const std::string index = read_text(run + "/frames/elements.hdf.series");
  for (const char* frames : {"/frames", "/frames/", "/checkpoints/../frames/."}) {
    const Outcome outcome = call("mesh " + file + " -o '" + run + frames + "'");
    EXPECT_EQ(outcome.exit_code, 2) << frames;
    EXPECT_NE(outcome.err.find("these are the frames of a run"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(read_text(run + "/frames/elements.hdf.series"), index);
}

}  // namespace
}  // namespace breccia::test::program_test
