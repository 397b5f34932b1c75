#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"

/// What may go wrong in situ in the middle of a run: displays that die, scripts that never end, disks that are full,
/// aborts within ParaView. The run ends as it would without, or with a line that names the pipeline.
namespace breccia::test::insitu_faults_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string script(const std::string& name) { return BRECCIA_SCRIPTS "/" + name; }

/// A run of the small case with a pipeline at ten instants, whatever they cost.
class FaultyRun {
 public:
  FaultyRun(int ranks, const std::string& pipeline, const std::string& arguments = "",
            const std::string& environment = "") {
    const std::string file = scratch_.write("case.toml", kSmallCase);
    std::string line = "run " + file + " --progress none -o '" + folder().string() + "' " + arguments;
    if (!pipeline.empty())
      line += " --set 'insitu.pipeline=[{name=\"" + pipeline + "\", every_time=\"0.4 ms\", strict=true}]'";
    unsetenv("DISPLAY");
    outcome = ranks > 1 ? call_ranks(ranks, line, environment) : call(line, environment);
  }
  [[nodiscard]] fs::path folder() const { return scratch_.path("run"); }
  [[nodiscard]] std::string hash() const {
    return json::parse(read_text(folder() / "summary.json"))["state_hash"].get<std::string>();
  }
  [[nodiscard]] std::ptrdiff_t lines() const { return std::count(outcome.err.begin(), outcome.err.end(), '\n'); }
  [[nodiscard]] bool reports(const std::string& text) const { return outcome.err.find(text) != std::string::npos; }
  Outcome outcome;

 private:
  Scratch scratch_;
};

class InSituFaults : public testing::TestWithParam<int> {};

TEST_P(InSituFaults, ADisplayThatDiesInTheMiddleOfAPictureCostsTheRunItsPicturesAndNothingElse) {
  const FaultyRun plain(1, ""), run(GetParam(), script("loses_display.py"));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.hash(), plain.hash());
  EXPECT_TRUE(run.reports("loses_display.py: the X display on which it draws has closed")) << run.outcome.err;
  EXPECT_LE(run.lines(), 2) << run.outcome.err;  // and that it is switched off
}

TEST_P(InSituFaults, AScriptThatNeverEndsIsInterruptedAndSwitchedOffAndTheRunGoesOn) {
  const FaultyRun plain(1, ""), run(GetParam(), script("loops.py"), "--set 'domains.patience=\"12 s\"'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.hash(), plain.hash());
  EXPECT_TRUE(
      run.reports("loops.py: KeyboardInterrupt: interrupted: it has taken more than 12 s (domains.patience) "
                  "(loops.py:"))
      << run.outcome.err;
  EXPECT_EQ(std::count(run.outcome.err.begin(), run.outcome.err.end(), '\n'), 2) << run.outcome.err;
}

TEST_P(InSituFaults, AScriptThatDoesNotComeBackFromALibraryEndsTheRunWithALine) {
  const FaultyRun run(GetParam(), script("sleeps.py"), "--set 'domains.patience=\"3 s\"'");
  EXPECT_EQ(run.outcome.exit_code, 4) << run.outcome.err;
  EXPECT_TRUE(run.reports("breccia: error: pipeline " + script("sleeps.py") + ": has not come back for "))
      << run.outcome.err;
}

TEST_P(InSituFaults, AScriptThatAsksForTheEndGetsTheStepThatFollowsWithItsEnergies) {
  const FaultyRun run(GetParam(), script("asks_for_the_end.py"), "--set 'output.history_interval=1000 s'");
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const json summary = json::parse(read_text(run.folder() / "summary.json"));
  EXPECT_TRUE(summary["status"].get<std::string>().starts_with("stopped")) << summary["status"];
  const double first = history_column(run.folder() / "history.csv", "kinetic [J]").front();
  EXPECT_NE(summary["energy"]["kinetic"].get<double>(), first);
}

TEST_P(InSituFaults, AnAbortWithinParaviewLeavesALineThatNamesThePipeline) {
  const FaultyRun run(GetParam(), script("aborts.py"));
  EXPECT_NE(run.outcome.exit_code, 0);
  EXPECT_TRUE(run.reports("breccia: error: pipeline " + script("aborts.py") +
                          ": ParaView has ended the run by an abort (SIGABRT)\n"))
      << run.outcome.err;
  EXPECT_FALSE(run.reports("*** Process received signal ***")) << run.outcome.err;
}

INSTANTIATE_TEST_SUITE_P(OfRanks, InSituFaults, testing::Values(1, 2), testing::PrintToStringParamName());

}  // namespace
}  // namespace breccia::test::insitu_faults_test
