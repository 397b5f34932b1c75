// What may go wrong with an implementation of Catalyst 2 in the shipped program: before a run it is refused in one
// line, in its middle the run goes on, or ends with a line that names the pipeline.

#include <gtest/gtest.h>

#include <sstream>

#include "catalyst2/catalyst_run.hpp"

namespace breccia::test::faults_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPipelines =
    " --set 'insitu.pipeline=[{name=\"fractures\", every_steps=100, strict=true}, {name=\"surface\", every_steps=100, "
    "strict=true}]' ";

bool reports(const CatalystRun& run, const std::string& text) {
  return run.outcome.err.find(text) != std::string::npos;
}

/// Those that are not of the launcher of ranks.
std::ptrdiff_t lines_of_the_program(const CatalystRun& run) {
  std::istringstream text(run.outcome.err);
  std::ptrdiff_t lines = 0;
  for (std::string line; std::getline(text, line);) lines += line.find("insitu") != std::string::npos;
  return lines;
}

/// One line, exit code 2, and nothing was given to the implementation.
void expect_refused(const CatalystRun& run, const std::string& text) {
  EXPECT_EQ(run.outcome.exit_code, 2);
  EXPECT_TRUE(reports(run, text)) << run.outcome.err;
  EXPECT_EQ(lines_of_the_program(run), 1) << run.outcome.err;
  EXPECT_EQ(run.cells(), std::vector<std::string>{});
  EXPECT_FALSE(fs::exists(run.folder() / "history.csv")) << "the run has begun";
}

class Catalyst2Faults : public testing::TestWithParam<int> {
 protected:
  /// An implementation that does so on the last rank in its first execution.
  static std::string last_rank(const std::string& does) {
    return "STANDIN_FAIL_EXECUTE=" + does + " STANDIN_RANK=" + std::to_string(GetParam() - 1);
  }
};

TEST_P(Catalyst2Faults, AnImplementationThatFailsCostsTheRunItsPipelinesAndNothingElse) {
  const CatalystRun plain(1, ""), run(GetParam(), kBackend + kPipelines, last_rank("throw"));
  EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.summary()["state_hash"], plain.summary()["state_hash"]);
  EXPECT_TRUE(reports(run, "pipeline fractures: thrown on purpose")) << run.outcome.err;
  EXPECT_TRUE(reports(run, "switched off after 3 failures")) << run.outcome.err;
}

TEST_P(Catalyst2Faults, AnAbortWithinAnImplementationLeavesALineThatNamesThePipelineAndIt) {
  const CatalystRun run(GetParam(), kBackend + kPipelines, last_rank("abort"));
  EXPECT_NE(run.outcome.exit_code, 0);
  EXPECT_TRUE(reports(run,
                      "breccia: error: pipeline fractures: implementation 'standin' of Catalyst 2 has ended the run by "
                      "an abort (SIGABRT)\n"))
      << run.outcome.err;
}

TEST_P(Catalyst2Faults, AnImplementationThatDoesNotComeBackEndsTheRunWithALine) {
  const CatalystRun run(GetParam(), kBackend + kPipelines + "--set 'domains.patience=\"3 s\"'", last_rank("hang"));
  EXPECT_EQ(run.outcome.exit_code, 4) << run.outcome.err;
  EXPECT_TRUE(GetParam() == 1 ? reports(run, "pipeline fractures: has not come back for ")
                              : reports(run, "pipeline fractures: rank 0 has waited "))
      << run.outcome.err;
}

TEST_P(Catalyst2Faults, AStartThatDoesNotComeBackEndsTheRunWithALine) {
  const CatalystRun run(GetParam(), kBackend + kPipelines + "--set 'domains.patience=\"3 s\"'",
                        "STANDIN_FAIL_INITIALIZE=hang");
  EXPECT_EQ(run.outcome.exit_code, 4) << run.outcome.err;
  EXPECT_TRUE(reports(run, "start of the in-situ pipelines: has not come back for ")) << run.outcome.err;
}

TEST_P(Catalyst2Faults, AnImplementationOfAnotherVersionIsRefusedBeforeTheRun) {
  const CatalystRun run(GetParam(), kBackend + kPipelines, "STANDIN_FAIL_INITIALIZE=6");
  expect_refused(run,
                 "implementation 'standin' of Catalyst 2 does not start: catalyst_initialize returns 6 (the "
                 "implementation is of another version)");
}

TEST_P(Catalyst2Faults, AnotherImplementationThanThatAskedForIsRefusedBeforeTheRun) {
  const CatalystRun run(GetParam(), kBackend + kPipelines, "STANDIN_ABOUT=stub");
  expect_refused(run, "implementation 'standin' of Catalyst 2 was requested and 'stub' started");
}

TEST_P(Catalyst2Faults, AMissingImplementationIsRefusedBeforeTheRun) {
  const CatalystRun run(GetParam(), kBackend + kPipelines, "CATALYST_IMPLEMENTATION_NAME=nobody");
  expect_refused(run, "has no implementation 'nobody'; tried ");
}

TEST_P(Catalyst2Faults, ALibraryThatIsNoLibcatalystIsRefusedBeforeTheRun) {
  const CatalystRun run(GetParam(), kBackend + kPipelines,
                        std::string("BRECCIA_LIBCATALYST='") + BRECCIA_LACKING + "'");
  expect_refused(run, "is no libcatalyst of version 2, it lacks catalyst_finalize, catalyst_about, ");
}

TEST_P(Catalyst2Faults, ValuesAtPointsAreRefusedBeforeTheRun) {
  const CatalystRun run(GetParam(),
                        kBackend + "--set 'insitu.pipeline=[{name=\"surface\", parameters={point_data=\"stress\"}}]'");
  expect_refused(run, "surface: values at points, point_data, are not passed to Catalyst 2");
}

INSTANTIATE_TEST_SUITE_P(OfRanks, Catalyst2Faults, testing::Values(1, 2), testing::PrintToStringParamName());

}  // namespace
}  // namespace breccia::test::faults_test
