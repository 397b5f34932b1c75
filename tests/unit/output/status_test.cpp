#include "output/status_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "unit/output/temporary_folder.hpp"

namespace breccia {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

StatusLine some_line() {
  StatusLine line;
  line.step = 1200;
  line.steps_total = 4800;
  line.time = 2.5e-5;
  line.end = 1e-4;
  line.share = 0.25;
  line.element_steps_per_s = 7.5e6;
  line.wall_s = 30;
  line.eta_s = 90;
  line.energy_residual = 3e-5;
  line.broken_joints = 1234;
  line.fragments = 17;
  line.stage = "impact";
  return line;
}

Summary ended(const std::string& status) {
  Summary summary;
  summary.status = status;
  summary.steps = 4800;
  summary.simulated_time = 1e-4;
  return summary;
}

std::vector<json> json_lines(const std::filesystem::path& path) {
  std::vector<json> parsed;
  for (const std::string& line : test::lines_of(path)) parsed.push_back(json::parse(line));
  return parsed;
}

TEST(StatusFile, HoldsEveryNumberUnderItsName) {
  const test::TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl");
  sink.start(RunStart{});
  sink.status(some_line());
  const auto expected = json::parse(R"({"state": "running", "stage": "impact", "step": 1200, "steps_total": 4800,
    "time": 2.5e-5, "end": 1e-4, "share": 0.25, "element_steps_per_s": 7.5e6, "wall_s": 30.0, "eta_s": 90.0,
    "energy_residual": 3e-5, "broken_joints": 1234, "fragments": 17})");
  EXPECT_EQ(json_lines(folder / "status.jsonl"), std::vector<json>{expected});
}

TEST(StatusFile, KeepsTheFirstAndTheLastLineAndFewBetween) {
  const test::TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl", std::chrono::hours(1));
  sink.start(RunStart{});
  EXPECT_TRUE(sink.status_due());
  for (int step = 1; step <= 1000; ++step) {
    StatusLine line = some_line();
    line.step = step;
    sink.status(line);
    EXPECT_FALSE(sink.status_due());
  }
  sink.finish(ended("complete"));
  const std::vector<json> lines = json_lines(folder / "status.jsonl");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["step"], 1);
  EXPECT_EQ(lines[1]["step"], 4800);
  EXPECT_EQ(lines[1]["state"], "complete");
  EXPECT_EQ(lines[1]["share"], 1.0);
}

TEST(StatusFile, GrowsAgainWhenTheIntervalHasPassed) {
  const test::TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl", std::chrono::milliseconds(20));
  sink.start(RunStart{});
  sink.status(some_line());
  std::this_thread::sleep_for(std::chrono::milliseconds(25));
  EXPECT_TRUE(sink.status_due());
  sink.status(some_line());
  EXPECT_EQ(json_lines(folder / "status.jsonl").size(), 2u);
}

TEST(StatusFile, EndsWithTheMessageOfAFailedRunAndTheShareItReached) {
  const test::TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl");
  sink.start(RunStart{});
  sink.status(some_line());
  sink.finish(ended("step 1201: energy residual\npast its limit"));
  const json last = json_lines(folder / "status.jsonl").back();
  EXPECT_EQ(last["state"], "failed");
  EXPECT_EQ(last["message"], "step 1201: energy residual\npast its limit");
  EXPECT_EQ(last["share"], 0.25);
}

TEST(StatusFile, KnowsAStoppedRunFromAFailedOne) {
  EXPECT_EQ(state_of(ended("complete")), RunState::complete);
  EXPECT_EQ(state_of(ended("stopped: by the user")), RunState::stopped);
  EXPECT_EQ(state_of(ended("energy residual")), RunState::failed);
}

TEST(StatusJson, WritesNullForWhatIsUnknownAndReplacesBrokenText) {
  StatusLine line = some_line();
  line.eta_s = -1;
  line.energy_residual = std::numeric_limits<double>::quiet_NaN();
  line.stage = "\xff";
  const json parsed = json::parse(status_json(line, RunState::running, ""));
  EXPECT_TRUE(parsed["eta_s"].is_null());
  EXPECT_TRUE(parsed["energy_residual"].is_null());
}

TEST(Progress, BarRedrawsOneLineThatFitsTheTerminal) {
  std::ostringstream terminal;
  constexpr int kColumns = 60;
  ProgressSink sink(ProgressMode::bar, terminal, kColumns);
  sink.status(some_line());
  EXPECT_THAT(terminal.str(), Not(HasSubstr("\n")));
  EXPECT_THAT(terminal.str(), testing::StartsWith("\r"));
  EXPECT_THAT(terminal.str(), HasSubstr("25.0 %"));
  EXPECT_LT(bar_text(some_line(), kColumns).size(), static_cast<std::size_t>(kColumns));
  sink.finish(ended("complete"));
  EXPECT_THAT(terminal.str(), testing::EndsWith("\n"));
  EXPECT_THAT(terminal.str(), HasSubstr("100.0 %"));
}

TEST(Progress, BarIsFilledByTheShareAlsoWhenTheShareIsNonsense) {
  StatusLine line = some_line();
  EXPECT_THAT(bar_text(line, 200), HasSubstr("[######..................]"));  // 6 of 24
  line.share = 7;
  EXPECT_THAT(bar_text(line, 200), HasSubstr("[########################]"));
  line.share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(bar_text(line, 200), HasSubstr("[........................]"));
}

TEST(Progress, LogWritesWholeLinesWithAllAPersonWants) {
  std::ostringstream log;
  ProgressSink sink(ProgressMode::log, log);
  sink.status(some_line());
  sink.status(some_line());  // too soon for a second line
  const std::string text = log.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  for (const char* part : {"25.0 %", "1,200 of 4,800", "25 us of 100 us", "7.5 M element-steps/s", "1 min 30 s to go",
                           "residual 3.0e-05", "broken joints 1,234", "fragments 17", "[impact]"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(Progress, JsonWritesTheLinesOfTheStatusFile) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::json, stream);
  sink.status(some_line());
  EXPECT_EQ(stream.str(), status_json(some_line(), RunState::running, "") + "\n");
}

TEST(Progress, NoneWritesNothingAndAsksForNothing) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::none, stream);
  EXPECT_FALSE(sink.status_due());
  sink.status(some_line());
  sink.finish(ended("complete"));
  EXPECT_EQ(stream.str(), "");
}

TEST(Progress, GoesOnWhenNobodyListensAnyMore) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::log, stream);
  stream.setstate(std::ios::badbit);
  EXPECT_NO_THROW(sink.status(some_line()));
  EXPECT_NO_THROW(sink.finish(ended("complete")));
}

}  // namespace
}  // namespace breccia
