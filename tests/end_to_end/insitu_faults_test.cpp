#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <tuple>

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

/// A script of tests/catalyst/scripts and why it fails, as the run reports it.
struct Failing {
  const char* script;
  const char* reason;
  friend std::ostream& operator<<(std::ostream& out, const Failing& failing) { return out << failing.script; }
};

constexpr Failing kFailing[] = {
    {"raises_at_import.py", "ValueError: this cannot continue (raises_at_import.py:5)"},
    {"raises_at_import_on_one_rank.py", "ValueError: cannot be read here (raises_at_import_on_one_rank.py:10)"},
    {"no_options.py", "AttributeError: 'NoneType' object has no attribute"},
    {"raises_in_initialize.py", "ValueError: cannot begin (raises_in_initialize.py:12)"},
    {"raises_in_initialize_on_one_rank.py", "ValueError: cannot begin here (raises_in_initialize_on_one_rank.py:15)"},
    {"exits_in_initialize.py", "SystemExit: called sys.exit (exits_in_initialize.py:12)"},
    {"wrong_signature.py", "TypeError: catalyst_initialize() missing 1 required positional argument"},
    {"raises_at_request.py", "ValueError: cannot request (raises_at_request.py:10)"},
    {"raises_at_request_on_one_rank.py", "ValueError: cannot request here (raises_at_request_on_one_rank.py:13)"},
    {"raises_on_one_rank.py", "RuntimeError: only here (raises_on_one_rank.py:16)"},
    {"raises_without_text.py", "Mute: an error without a text (raises_without_text.py:15)"},
    {"raises_in_finalize.py", "at its end: ValueError: cannot end (raises_in_finalize.py:14)"},
    {"raises_in_finalize_on_one_rank.py", "at its end: ValueError: cannot end here"},
};

class FailingScripts : public testing::TestWithParam<std::tuple<Failing, int>> {};

TEST_P(FailingScripts, EndTheRunAsWithoutThemAndTheReasonIsReportedOnce) {
  const auto& [failing, ranks] = GetParam();
  static const std::string plain = FaultyRun(1, "").hash();
  const FaultyRun run(ranks, script(failing.script));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  EXPECT_EQ(run.hash(), plain);
  const std::string reason = std::string(failing.script) + ": " + failing.reason;
  EXPECT_TRUE(run.reports(reason)) << run.outcome.err;
  EXPECT_EQ(run.outcome.err.find(reason), run.outcome.err.rfind(reason)) << run.outcome.err;
  EXPECT_LE(run.lines(), 2) << run.outcome.err;  // and that it is switched off
  EXPECT_FALSE(run.reports("Traceback")) << "that is in the log";
}

INSTANTIATE_TEST_SUITE_P(OfRanks, FailingScripts, testing::Combine(testing::ValuesIn(kFailing), testing::Values(1, 2)),
                         [](const auto& info) {
                           const std::string name = std::get<0>(info.param).script;
                           return name.substr(0, name.find('.')) + "_" + std::to_string(std::get<1>(info.param));
                         });

std::ptrdiff_t times(const std::string& text, const std::string& part) {
  std::ptrdiff_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_P(InSituFaults, WhatAScriptWritesAndWarnsOfIsInItsLogAndReportedOnceAndIsNoFailure) {
  const FaultyRun run(GetParam(), script("writes_and_warns.py"));
  ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
  const json pipeline = json::parse(read_text(run.folder() / "summary.json"))["insitu"]["pipelines"][0];
  EXPECT_EQ(pipeline["failed"], 0) << pipeline;
  const std::string log = read_text(run.folder() / "extracts/writes_and_warns/script.log");
  const std::string events = read_text(run.folder() / "status.jsonl");
  const auto of_script = [](const std::string& text) { return "writes_and_warns.py: " + text + "\""; };
  for (const std::string line : {"read", "begun", "cells of 0: some", "ended", "line 4"}) {
    EXPECT_EQ(times(log, line + "\n") > 0, true) << line << log;
    EXPECT_EQ(times(events, of_script(line)), 1) << line << events;
  }
  EXPECT_EQ(times(log, "line 11\n"), times(log, "some\n")) << "the log has all";
  EXPECT_EQ(times(events, of_script("line 11")), 0) << "only some lines are reported at a time";
  EXPECT_EQ(times(events, "more lines in " + (run.folder() / "extracts/writes_and_warns/script.log").string()), 1);
  const std::string warnings[] = {"on stderr", "UserWarning: by Python (writes_and_warns.py:25)",
                                  "WARNING:root:by logging", "by ParaView", "by VTK"};
  for (const std::string& warning : warnings) {
    EXPECT_GT(times(log, warning + "\n"), 0) << warning << log;
    EXPECT_EQ(times(run.outcome.err, warning + "\n"), 1) << warning << run.outcome.err;
  }
  EXPECT_EQ(run.lines(), std::size(warnings)) << run.outcome.err;
  EXPECT_EQ(times(events, of_script("rank 1: by the second rank")), GetParam() - 1);
  EXPECT_EQ(fs::exists(run.folder() / "extracts/writes_and_warns/script_rank_1.log"), GetParam() > 1);
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
