#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "end_to_end/program.hpp"

/// The shipped program with its in-situ adaptor. No display is inherited: what draws makes its own.
namespace breccia::test::insitu_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Pipelines of which every trigger counts, as an override of the case.
std::string strict(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "{name=\"" : ", {name=\"") + name + "\", strict=true}";
  return " --set 'insitu.pipeline=[" + list + "]' ";
}

const std::string kRecordings = strict({"volume", "surface", "fractures", "joints", "contacts", "domains", "history"});

/// A run of the small case; --progress none.
struct WatchedRun {
  WatchedRun(int ranks, const std::string& arguments, const std::string& environment = "") {
    const std::string file = scratch.write("case.toml", kSmallCase);
    const std::string line = "run " + file + " --progress none -o '" + folder().string() + "' " + arguments;
    unsetenv("DISPLAY");
    outcome = ranks > 1 ? call_ranks(ranks, line) : call(line, environment);
  }
  [[nodiscard]] fs::path folder() const { return scratch.path("run"); }
  [[nodiscard]] json summary() const { return json::parse(read_text(folder() / "summary.json")); }
  [[nodiscard]] json pipeline(const std::string& name) const {
    const json all = summary();
    for (const json& p : all["insitu"]["pipelines"]) {
      if (p["name"] == name) return p;
    }
    return json::object();
  }
  Scratch scratch;
  Outcome outcome;
};

/// Files of a folder whose names end so.
std::ptrdiff_t count_files(const fs::path& folder, const std::string& ending) {
  std::error_code error;
  const fs::directory_iterator files(folder, error);
  return std::count_if(begin(files), end(files), [&](const auto& f) { return f.path().string().ends_with(ending); });
}

class InSitu : public testing::TestWithParam<int> {};

TEST_P(InSitu, ChangesNothingOfTheRun) {
  const WatchedRun plain(1, ""), watched(GetParam(), kRecordings);
  ASSERT_EQ(watched.outcome.exit_code, 0) << watched.outcome.err;
  EXPECT_EQ(watched.summary()["state_hash"], plain.summary()["state_hash"]);
  EXPECT_EQ(watched.outcome.err, "");
}

TEST_P(InSitu, RecordsEveryChannelAndTellsOfIt) {
  const WatchedRun run(GetParam(), kRecordings);
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const fs::path extracts = run.folder() / "extracts";
  for (const std::string channel : {"elements", "surface", "fractures", "joints", "contacts", "domains"}) {
    EXPECT_TRUE(fs::exists(extracts / channel / (channel + ".pvd"))) << channel;
    EXPECT_EQ(count_files(extracts / channel, ".pvtu") + count_files(extracts / channel, ".pvtp"), 51)
        << channel;  // 50, and the end
  }
  EXPECT_TRUE(fs::exists(extracts / "history" / "history.csv"));
  EXPECT_EQ(run.pipeline("surface")["executed"], 51);
  EXPECT_GT(run.pipeline("surface")["bytes"].get<int>(), 0);
  EXPECT_NE(read_text(run.folder() / "history.csv").find("in situ share of wall time"), std::string::npos);
}

TEST_P(InSitu, TriggersByTheFirstBreakAndByBrokenJointsHitTheSameStepsOnAnyNumberOfRanks) {
  const std::string triggers =
      "--set 'insitu.pipeline=[{name=\"fractures\", first_break=true, strict=true}, {name=\"surface\", "
      "every_broken=10, strict=true}]'";
  const WatchedRun alone(1, triggers), run(GetParam(), triggers + " --set domains.margin=0.1");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.summary()["decompositions"].get<int>() > 2, GetParam() > 1);
  for (const std::string channel : {"fractures", "surface"}) {
    const std::string series = "extracts/" + channel + "/" + channel + ".pvd";
    EXPECT_EQ(read_text(run.folder() / series), read_text(alone.folder() / series));
  }
  EXPECT_EQ(run.pipeline("fractures")["executed"], 2);  // at the first break, and at the end
  EXPECT_GT(run.pipeline("surface")["executed"].get<int>(), 2);
}

TEST_P(InSitu, ADearPipelineIsPassedOver) {
  const WatchedRun run(GetParam(), "--insitu volume --set insitu.max_overhead=1e-6 --set insitu.least_instants=0");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_GE(run.pipeline("volume")["passed_over"].get<int>(), 40);
  EXPECT_LE(run.pipeline("volume")["executed"].get<int>(), 3);  // the first, the first that has a price, the last
}

TEST_P(InSitu, AskedForOnTheCommandLineItShowsTwentyInstantsAtEvenDistancesWhateverThatCosts) {
  const WatchedRun run(GetParam(), "--insitu volume --set insitu.max_overhead=1e-6");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.pipeline("volume")["executed"], 21);  // the second, to learn the cost, comes early
  EXPECT_EQ(run.outcome.err.find("passed over"), std::string::npos);
  const std::string status = read_text(run.folder() / "status.jsonl");
  EXPECT_NE(status.find("volume: a record every "), std::string::npos) << status;
  EXPECT_NE(status.find(", 21 in all, for "), std::string::npos) << status;
  EXPECT_NE(status.find("insitu.least_instants = 20"), std::string::npos) << status;
}

/// A run whose start is the state at 2 ms of another one, with its own pipelines.
struct StartedRun : WatchedRun {
  StartedRun(int ranks, const std::string& arguments) : WatchedRun(1, "--set 'stage[0].end=2 ms'") {
    const std::size_t laws = kSmallCase.find("[[material]]"), state = kSmallCase.find("[[initial_velocity]]");
    const std::string file =
        scratch.write("started.toml", "[start]\nfrom = \"run\"\n" + kSmallCase.substr(laws, state - laws) +
                                          kSmallCase.substr(kSmallCase.find("[[stage]]")));
    const std::string line = "run " + file + " --progress none -o '" + started().string() + "' " + arguments;
    outcome = ranks > 1 ? call_ranks(ranks, line) : call(line);
  }
  [[nodiscard]] fs::path started() const { return scratch.path("started"); }
  [[nodiscard]] json report() const {
    return json::parse(read_text(started() / "summary.json"))["insitu"]["pipelines"][0];
  }
};

TEST_P(InSitu, SpacesThePipelinesOfAStartedRunOverTheStepsThatItMayTake) {
  const StartedRun run(GetParam(), "--insitu history --set insitu.max_overhead=1e-6 --set time.max_steps=100");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_LE(run.report()["executed"].get<int>(), 22);
}

TEST_P(InSitu, ShowsAStartedRunAsOftenAsAnother) {
  const StartedRun run(GetParam(), "--insitu history --set insitu.max_overhead=1e-6 --set 'stage[0].end=2.4 ms'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_GE(run.report()["executed"].get<int>(), 20);
  EXPECT_LE(run.report()["executed"].get<int>(), 22);
}

TEST_P(InSitu, ARunThatGoesOnHasTheExtractsOfOneThatWasNeverStopped) {
  const std::string triggers =
      "--set 'insitu.pipeline=[{name=\"fractures\", first_break=true, strict=true}, {name=\"surface\", "
      "every_broken=3, strict=true}]' ";
  const WatchedRun whole(1, triggers);
  const std::string first = read_text(whole.folder() / "extracts/fractures/fractures.pvd");
  const std::size_t at = first.find("fractures_");
  ASSERT_NE(at, std::string::npos) << first;
  const int seen = std::stoi(first.substr(at + 10));
  for (const int stop : {seen - 1, seen, seen + 1}) {
    const WatchedRun run(GetParam(), triggers + "--set time.max_steps=" + std::to_string(stop));
    const Outcome resumed = call("resume '" + run.folder().string() + "' --progress none --set time.max_steps=0");
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    for (const std::string channel : {"fractures", "surface"}) {
      const std::string series = "extracts/" + channel + "/" + channel + ".pvd";
      EXPECT_EQ(read_text(run.folder() / series), read_text(whole.folder() / series)) << "stopped after " << stop;
    }
  }
}

/// A line through both boxes and beyond them, a plane, and a point.
const std::string kProbes =
    "{name=\"probes\", every_time=\"0.3 ms\", strict=true, fields=[\"body\", \"velocity\", \"stress\"], probe=["
    "{name=\"line\", at=[\"-5 mm\", \"7 mm\", \"4 mm\"], along=[\"60 mm\", 0, 0], points=25}, "
    "{name=\"plane\", at=[0, 0, \"5 mm\"], along=[\"41 mm\", 0, 0], points=8, across=[0, \"20 mm\", 0], rows=5}, "
    "{name=\"point\", at=[\"10 mm\", \"10 mm\", \"5 mm\"]}]}";

TEST_P(InSitu, ProbesRecordTheSameOnAnyNumberOfRanksAndOnceWhenARunGoesOn) {
  const std::string probes = "--set 'insitu.pipeline=[" + kProbes + "]' ";
  const WatchedRun alone(1, probes), run(GetParam(), probes + "--set time.max_steps=300");
  ASSERT_EQ(alone.outcome.exit_code, 0) << alone.outcome.err;
  std::ofstream(run.folder() / "extracts/probes/line.csv", std::ios::app) << "301,0.0";  // where a run was killed
  const Outcome resumed = call("resume '" + run.folder().string() + "' --progress none --set time.max_steps=0");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  for (const std::string name : {"line", "plane", "point"}) {
    const std::string file = "extracts/probes/" + name + ".csv";
    std::istringstream lines(read_text(alone.folder() / file)), others(read_text(run.folder() / file));
    std::set<std::string> expected, seen;
    int number = 0;
    for (std::string line; std::getline(lines, line);) expected.insert(line);
    for (std::string line; std::getline(others, line); ++number) seen.insert(line);
    EXPECT_EQ(number, static_cast<int>(seen.size())) << "a line stands twice in " << name;
    // Where the run ended and went on there is an instant more.
    EXPECT_TRUE(std::includes(seen.begin(), seen.end(), expected.begin(), expected.end())) << name;
    const int points = name == "line" ? 25 : name == "plane" ? 40 : 1;
    EXPECT_EQ((number - 1) % points, 0) << name;
    EXPECT_GE(number - 1, 14 * points) << name;
  }
  const std::string line = read_text(alone.folder() / "extracts/probes/line.csv");
  EXPECT_EQ(line.substr(0, line.find('\n')),
            "step,time [s],row,point,x [m],y [m],z [m],element,body,velocity x,velocity y,velocity z,stress xx,stress "
            "yy,stress zz,stress xy,stress yz,stress xz");
  EXPECT_NE(line.find("\n0,0,0,0,-0.005,0.007,0.004,-1,,,,,,,,,,\n"), std::string::npos) << line.substr(0, 2000);
}

TEST_P(InSitu, ABoxAndSomeFieldsAreRecordedWithoutAChangeToTheRun) {
  const WatchedRun plain(1, ""),
      run(GetParam(),
          "--set 'insitu.pipeline=[{name=\"volume\", every_time=\"2 ms\", strict=true, fields=[\"id\", \"mass\"], "
          "region={lower=[0, 0, 0], upper=[\"10 mm\", 1, 1]}}, {name=\"surface\", every_time=\"2 ms\", strict=true}]'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.summary()["state_hash"], plain.summary()["state_hash"]);
  const fs::path extracts = run.folder() / "extracts";
  const std::string first = read_text(extracts / "elements/elements_000000000.pvtu");
  EXPECT_NE(first.find("\"mass\""), std::string::npos) << first;
  EXPECT_EQ(first.find("\"stress\""), std::string::npos) << first;
  EXPECT_NE(read_text(extracts / "surface/surface_000000000.pvtp").find("\"stress\""), std::string::npos);
  int cells = 0;
  for (int rank = 0; rank < GetParam(); ++rank) {
    const std::string piece = read_text(extracts / ("elements/elements_000000000/000" + std::to_string(rank) + ".vtu"));
    const std::size_t at = piece.find("NumberOfCells=\"");
    ASSERT_NE(at, std::string::npos);
    cells += std::stoi(piece.substr(at + 15));
  }
  EXPECT_EQ(cells, 48) << "two of eight cubes of 24, whose centres lie in the box";
}

/// Lines of a file a rank, sorted.
std::vector<std::string> lines_of_ranks(const fs::path& folder, const std::string& stem, int ranks) {
  std::vector<std::string> lines;
  for (int rank = 0; rank < ranks; ++rank) {
    std::istringstream text(read_text(folder / (stem + "_" + std::to_string(rank) + ".txt")));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST_P(InSitu, ValuesAtPointsGiveContoursAndGradientsAndAreTheSameOnAnyNumberOfRanks) {
  const std::string pipelines =
      "--set 'insitu.pipeline=[{name=\"" BRECCIA_SCRIPTS
      "/writes_point_data.py\", every_time=\"1 ms\", strict=true, "
      "parameters={point_data=\"von_mises, stress, displacement\"}}, "
      "{name=\"surface\", every_time=\"1 ms\", strict=true, parameters={point_data=\"velocity\"}}, "
      "{name=\"volume\", every_time=\"1 ms\", strict=true}]' ";
  const WatchedRun plain(1, ""), alone(1, pipelines), run(GetParam(), pipelines);
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.outcome.err, "");
  EXPECT_EQ(run.summary()["state_hash"], plain.summary()["state_hash"]);
  const fs::path own = "extracts/writes_point_data";
  const std::vector<std::string> expected = lines_of_ranks(alone.folder() / own, "rank", 1),
                                 lines = lines_of_ranks(run.folder() / own, "rank", GetParam());
  EXPECT_EQ(lines, expected);
  EXPECT_EQ(std::adjacent_find(lines.begin(), lines.end()), lines.end());
  int most = 0;
  for (const std::string& line : lines_of_ranks(run.folder() / own, "cells", GetParam())) {
    std::istringstream words(line);
    int cells = 0, arrays = 0;
    words >> cells >> arrays;
    EXPECT_EQ(arrays, 3) << "what it has asked for, and no more";
    most = std::max(most, cells);
  }
  EXPECT_GT(most, 0);
  const std::string surface = read_text(run.folder() / "extracts/surface/surface_000000000.pvtp");
  EXPECT_NE(surface.find("<PPointData>\n      <PDataArray type=\"Float64\" Name=\"velocity\""), std::string::npos);
  EXPECT_EQ(read_text(run.folder() / "extracts/elements/elements_000000000.pvtu").find("PPointData"),
            std::string::npos);
}

TEST_P(InSitu, ContactsHaveAnIdEachTheSameOnAnyNumberOfRanks) {
  const std::string pipelines =
      "--set 'insitu.pipeline=[{name=\"" BRECCIA_SCRIPTS "/writes_contacts.py\", every_time=\"20 us\", strict=true}]' ";
  const WatchedRun alone(1, pipelines), run(GetParam(), pipelines);
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const fs::path own = "extracts/writes_contacts";
  const std::vector<std::string> lines = lines_of_ranks(run.folder() / own, "rank", GetParam());
  EXPECT_EQ(lines, lines_of_ranks(alone.folder() / own, "rank", 1));
  std::set<std::pair<std::string, std::string>> ids;
  std::map<std::string, std::string> couples;  // by id
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string step, id, point, other;
    words >> step >> id >> point >> other;
    EXPECT_TRUE(ids.emplace(step, id).second) << line;
    const auto [known, is_new] = couples.emplace(id, point + " " + other);
    EXPECT_EQ(known->second, point + " " + other) << "an id means the same at all instants";
  }
  EXPECT_GT(ids.size(), 50U);
}

TEST_P(InSitu, AScriptThatFailsThreeTimesIsSwitchedOffAndTheRunGoesOn) {
  const Scratch scratch;
  (void)scratch.write("always.py",
                      "from paraview.simple import TrivialProducer\n"
                      "surface = TrivialProducer(registrationName='surface')\n"
                      "def catalyst_execute(info):\n"
                      "    raise ValueError('on purpose')\n");
  const WatchedRun run(GetParam(), strict({scratch.path("always.py").string(), "fractures"}));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("ValueError: on purpose (always.py:4)"), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("switched off after 3 failures"), std::string::npos) << run.outcome.err;
  EXPECT_EQ(run.outcome.err.find("on purpose"), run.outcome.err.rfind("on purpose")) << "the reason is reported once";
  EXPECT_EQ(std::count(run.outcome.err.begin(), run.outcome.err.end(), '\n'), 2) << run.outcome.err;
  EXPECT_EQ(run.pipeline("fractures")["executed"], 51);
}

TEST_P(InSitu, AScriptThatFailsEndsTheRunWhereTheUserWantsThat) {
  const WatchedRun run(GetParam(),
                       "--set insitu.on_error=stop" + strict({BRECCIA_SCRIPTS "/raises_at_seventh_call.py"}));
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("raises_at_seventh_call"), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.summary()["status"], "complete");
}

TEST_P(InSitu, AScriptThatFailsWhenItIsReadIsSwitchedOffAtOnce) {
  const WatchedRun run(GetParam(), strict({BRECCIA_SCRIPTS "/raises_at_import.py", "fractures"}));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("raises_at_import.py:"), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("switched off, as it requests nothing after its failure"), std::string::npos)
      << run.outcome.err;
  EXPECT_EQ(std::count(run.outcome.err.begin(), run.outcome.err.end(), '\n'), 2) << run.outcome.err;
  EXPECT_EQ(run.pipeline("fractures")["executed"], 51);
}

TEST_P(InSitu, AScriptThatDoesNotCompileIsRefusedBeforeTheFirstStep) {
  const WatchedRun run(GetParam(), "--insitu fractures," BRECCIA_SCRIPTS "/syntax_error.py");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("syntax_error.py"), std::string::npos) << run.outcome.err;
  EXPECT_FALSE(fs::exists(run.folder() / "summary.json"));
}

TEST_P(InSitu, PicturesNeedNoDisplay) {
  const WatchedRun run(GetParam(),
                       "--set insitu.pipeline='[{name=\"stress\", every_time=\"2 ms\", strict=true, "
                       "parameters={width=320, height=200}}]'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.outcome.err, "");
  EXPECT_EQ(count_files(run.folder() / "extracts/stress", ".png"), 3);  // 0, 2 and 4 ms
  std::istringstream table(read_text(run.folder() / "extracts/stress/data.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "time,FILE");
  int rows = 0;
  for (; std::getline(table, line); ++rows)
    EXPECT_TRUE(fs::exists(run.folder() / "extracts/stress" / line.substr(line.find(',') + 1))) << line;
  EXPECT_EQ(rows, 3);
  const std::string status = read_text(run.folder() / "status.jsonl");
  EXPECT_NE(status.find("animation: "), std::string::npos) << status;
  if (status.find("apt-get install ffmpeg") == std::string::npos) {
    EXPECT_TRUE(fs::exists(run.folder() / "extracts/stress/stress.mp4")) << status;
  }
}

TEST_P(InSitu, ARunThatGoesOnListsThePicturesThatWereDrawnBefore) {
  const WatchedRun run(GetParam(),
                       "--set insitu.pipeline='[{name=\"ranks\", every_time=\"1 ms\", strict=true, "
                       "parameters={width=160, height=100}}]' --set time.max_steps=400");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const Outcome resumed = call("resume '" + run.folder().string() + "' --progress none --set time.max_steps=0");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const fs::path folder = run.folder() / "extracts/ranks";
  const std::string table = read_text(folder / "data.csv");
  EXPECT_EQ(count_files(folder, ".png"), 6) << "0 to 4 ms, and where the run went on";
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 6) << table;
}

TEST_P(InSitu, NobodyListeningDoesNotMatter) {
  const WatchedRun run(GetParam(), "--live localhost:1");
  EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.outcome.err, "");
}

INSTANTIATE_TEST_SUITE_P(OfRanks, InSitu, testing::Values(1, 2), testing::PrintToStringParamName());

TEST(InSituAlone, CheckRefusesWhatARunWould) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const Outcome outcome = call("check " + file + " --set 'insitu.pipeline=[{name=\"stress\", parameters={widht=3}}]'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("stress: has no parameter 'widht'; allowed: "), std::string::npos) << outcome.err;
  const Outcome kinds =
      call("check " + file + " --set 'insitu.pipeline=[{name=\"stress\", parameters={title=3, width=\"wide\"}}]'");
  EXPECT_EQ(kinds.exit_code, 2);
  EXPECT_NE(kinds.err.find("stress: the parameter 'title' is a text; given: 3"), std::string::npos) << kinds.err;
  EXPECT_NE(kinds.err.find("stress: the parameter 'width' is a number, or a text with a unit; given: \"wide\""),
            std::string::npos)
      << kinds.err;
}

TEST(InSituAlone, ALiveViewThatLeavesTheMachineIsWarnedOf) {
  char host[256] = "";
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  const WatchedRun run(1, std::string("--live-remote --live ") + host + ":1 --set time.max_steps=3");
  EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("another machine"), std::string::npos) << run.outcome.err;
}

TEST(InSituAlone, AScriptInWhichRanksWaitForEachOtherInVainEndsTheRun) {
  const WatchedRun run(2, "--set 'domains.patience=\"6 s\"'" + strict({BRECCIA_SCRIPTS "/leaves_the_others.py"}));
  EXPECT_EQ(run.outcome.exit_code, 4);
  EXPECT_NE(run.outcome.err.find("leaves_the_others.py: rank 1 has waited "), std::string::npos) << run.outcome.err;
  EXPECT_NE(
      run.outcome.err.find(
          " s for others that are still in it; here it failed: RuntimeError: on my own (leaves_the_others.py:12)"),
      std::string::npos)
      << run.outcome.err;
}

TEST(InSituAlone, WithoutAnAdaptorTheRunSaysWhatToInstall) {
  const WatchedRun run(1, "--insitu fractures", "BRECCIA_CATALYST=/nowhere/libbreccia_catalyst.so");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("/nowhere/libbreccia_catalyst.so"), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("./run build"), std::string::npos) << run.outcome.err;
  EXPECT_FALSE(fs::exists(run.folder()));
}

TEST(InSituAlone, SomethingElseThanAnAdaptorIsRefused) {
  const WatchedRun run(1, "--insitu fractures", "BRECCIA_CATALYST=/bin/true");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("cannot be loaded"), std::string::npos) << run.outcome.err;
}

TEST(InSituAlone, AnInterruptStillEndsTheRunInOrder) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const fs::path folder = scratch.path("run");
  unsetenv("DISPLAY");
  const std::string arguments = "run " + file +
                                " --progress none --insitu ranks,fractures --set 'stage[0].end=1000 s' -o '" +
                                folder.string() + "'";
  EXPECT_EQ(
      call_interrupted(arguments, SIGTERM, [&] { return fs::exists(folder / "extracts/fractures/fractures.pvd"); }),
      143);
  EXPECT_EQ(json::parse(read_text(folder / "summary.json"))["status"].get<std::string>().substr(0, 7), "stopped");
}

TEST(InSituAlone, AReplayDrawsWhatARunHasRecorded) {
  const WatchedRun run(1, "--set time.max_steps=50" + strict({"volume", "fractures"}));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const Outcome replay = call("insitu replay '" + run.folder().string() + "' " BRECCIA_SCRIPTS "/count_cells.py");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_TRUE(fs::exists(run.folder() / "replay/count_cells/rank_0.txt"));
  const Outcome again = call("insitu replay '" + run.folder().string() + "' " BRECCIA_SCRIPTS "/count_cells.py -o '" +
                             run.scratch.path("again").string() + "' -p factor='2 mm' -p label='half open'");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(read_text(run.scratch.path("again") / "count_cells/rank_0.txt").find(" 0.002 half open\n"),
            std::string::npos);
  const Outcome nothing = call("insitu replay '" + run.scratch.path("empty").string() + "' fractures");
  EXPECT_EQ(nothing.exit_code, 2);
}

}  // namespace
}  // namespace breccia::test::insitu_test
