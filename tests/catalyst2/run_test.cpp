// The shipped program over Catalyst 2, with a libcatalyst of our own.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catalyst2/catalyst_run.hpp"
#include "end_to_end/program.hpp"

namespace breccia::test::run_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const std::string kChannels =
    " --set 'insitu.pipeline=[{name=\"volume\", every_steps=100, strict=true}, {name=\"fractures\", every_steps=100, "
    "strict=true}, {name=\"surface\", first_break=true, strict=true}, {name=\"history\", every_steps=100, "
    "strict=true}]' ";

class Catalyst2 : public testing::TestWithParam<int> {};

TEST_P(Catalyst2, IsGivenTheCellsAndValuesOfTheSolverWhateverTheNumberOfRanksAndChangesNothing) {
  const CatalystRun plain(1, ""), alone(1, kBackend + kChannels), run(GetParam(), kBackend + kChannels);
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  for (const char* word : {"error", "pipeline", "Catalyst"})  // more ranks than cores are a warning, too
    EXPECT_EQ(run.outcome.err.find(word), std::string::npos) << run.outcome.err;
  EXPECT_EQ(run.summary()["state_hash"], plain.summary()["state_hash"]);
  const std::vector<std::string> cells = run.cells();
  EXPECT_EQ(cells, alone.cells());
  const auto of_channel = [&](const std::string& channel) {
    return std::count_if(cells.begin(), cells.end(),
                         [&](const std::string& line) { return line.starts_with(channel + ' '); });
  };
  EXPECT_GT(of_channel("fractures"), 0);
  EXPECT_GT(of_channel("surface"), 0);
  EXPECT_GT(of_channel("history"), 0);
  const json pipelines = run.summary()["insitu"]["pipelines"];
  EXPECT_EQ(of_channel("elements"), pipelines[0]["executed"].get<int>() * run.summary()["elements"].get<int>());
}

TEST_P(Catalyst2, AnImplementationThatFailsThreeTimesIsSwitchedOffAndTheRunGoesOn) {
  const CatalystRun run(GetParam(), kBackend + kChannels,
                        "STANDIN_FAIL_EXECUTE=5 STANDIN_RANK=" + std::to_string(GetParam() - 1));
  EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("pipeline volume: catalyst_execute returns 5"), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("switched off after 3 failures"), std::string::npos) << run.outcome.err;
}

TEST_P(Catalyst2, AnImplementationThatFailsEndsTheRunWhereTheUserWantsThat) {
  const CatalystRun run(GetParam(), kBackend + kChannels + "--set insitu.on_error=stop", "STANDIN_FAIL_EXECUTE=throw");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("volume: thrown on purpose"), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.summary()["status"], "complete");
}

TEST_P(Catalyst2, AnImplementationThatDoesNotStartIsToldBeforeTheFirstStep) {
  const CatalystRun run(GetParam(), kBackend + kChannels, "STANDIN_FAIL_INITIALIZE=4");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("catalyst_initialize returns 4 (the file is no implementation of Catalyst)"),
            std::string::npos)
      << run.outcome.err;
}

INSTANTIATE_TEST_SUITE_P(OfRanks, Catalyst2, testing::Values(1, 2, 3), testing::PrintToStringParamName());

TEST(Catalyst2Alone, AMissingLibrarySaysWhatToDoBeforeTheFirstStep) {
  const CatalystRun run(1, kBackend + kChannels, "BRECCIA_LIBCATALYST=/nowhere/libcatalyst.so.3");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("libcatalyst, the library of Catalyst 2, cannot be opened (/nowhere/libcatalyst.so.3"),
            std::string::npos)
      << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("install a ParaView from 5.12 on"), std::string::npos) << run.outcome.err;
}

TEST(Catalyst2Alone, ABackEndThatDoesNotExistIsRefusedWithTheNearestName) {
  const CatalystRun run(1, kChannels + "--set insitu.backend=catalyst");
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_NE(run.outcome.err.find("insitu.backend: "), std::string::npos) << run.outcome.err;
  EXPECT_NE(run.outcome.err.find("did you mean \"catalyst2\"?"), std::string::npos) << run.outcome.err;
}

TEST(Catalyst2Alone, CheckRefusesWhatItCannotDo) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const Outcome outcome = call("check " + file + " --set insitu.backend=catalyst2 --set 'insitu.run=[\"fractures\"]'",
                               std::string("BRECCIA_LIBCATALYST='") + BRECCIA_STANDIN + "'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("fractures: this recording is not made by ParaView's implementation of Catalyst 2"),
            std::string::npos)
      << outcome.err;
}

TEST(Catalyst2Alone, StandsInByItselfWhereTheAdaptorWithParaViewIsMissing) {
  const std::string missing = "BRECCIA_CATALYST=/nowhere/libbreccia_catalyst.so ";
  const CatalystRun run(1, kChannels, missing);
  EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_FALSE(run.cells().empty());
  const CatalystRun neither(1, kChannels, missing + "BRECCIA_LIBCATALYST=/nowhere/libcatalyst.so.3");
  EXPECT_EQ(neither.outcome.exit_code, 2);
  EXPECT_NE(neither.outcome.err.find("/nowhere/libbreccia_catalyst.so"), std::string::npos) << neither.outcome.err;
  EXPECT_NE(neither.outcome.err.find("insitu.backend = \"catalyst2\""), std::string::npos) << neither.outcome.err;
}

TEST(Catalyst2Alone, FindsLibcatalystAndTheImplementationByTheFoldersThatTheEnvironmentNames) {
  const std::string beside = fs::path(BRECCIA_STANDIN).parent_path().string();
  for (const std::string& folders : {beside + "/catalyst", "/nowhere:" + beside + "/catalyst"}) {
    const CatalystRun run(1, kBackend + kChannels,
                          "BRECCIA_LIBCATALYST= CATALYST_IMPLEMENTATION_PATHS='" + folders + "'");
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_FALSE(run.cells().empty());
  }
  const CatalystRun lost(1, kBackend + kChannels, "BRECCIA_LIBCATALYST= CATALYST_IMPLEMENTATION_PATHS=/nowhere");
  EXPECT_EQ(lost.outcome.exit_code, 2);
  EXPECT_NE(lost.outcome.err.find("/nowhere/libcatalyst.so.3"), std::string::npos) << lost.outcome.err;
}

TEST_P(Catalyst2, GoesOnWithARunThatWasStopped) {
  const CatalystRun whole(1, kBackend + kChannels);
  const CatalystRun run(GetParam(), kBackend + kChannels + "--set time.max_steps=250");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const std::size_t before = run.cells().size();
  const Outcome resumed = run.resumed(GetParam(), "--set time.max_steps=0");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(run.summary()["state_hash"], whole.summary()["state_hash"]);
  EXPECT_GT(run.cells().size(), before) << "the back end was forgotten";
  const std::vector<std::string> cells = run.cells(), all = whole.cells();
  // The stop is an end, too, at which every pipeline is executed.
  EXPECT_TRUE(std::includes(cells.begin(), cells.end(), all.begin(), all.end()));
}

#ifdef BRECCIA_HAS_PARAVIEW
TEST(Catalyst2Alone, IsNotTakenWhereTheAdaptorWithParaViewCanBeLoadedAndNobodyAsksForIt) {
  for (const char* asked : {"", "--set insitu.backend=auto", "--set insitu.backend=paraview"}) {
    const CatalystRun run(1, kChannels + asked);
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_TRUE(run.cells().empty());
    EXPECT_TRUE(fs::exists(run.folder() / "extracts/fractures/fractures.pvd"));
  }
}
#endif

TEST(Catalyst2Alone, InfoTellsWhatWasFoundAndWhatLacks) {
  const Outcome outcome = call("insitu info", std::string("BRECCIA_LIBCATALYST='") + BRECCIA_STANDIN +
                                                  "' BRECCIA_CATALYST=/nowhere/libbreccia_catalyst.so");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("paraview: not usable: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(std::string("catalyst2: libcatalyst ") + BRECCIA_STANDIN), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("implementation 'paraview'"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace breccia::test::run_test
