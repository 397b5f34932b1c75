#include "output/folder/status_sink.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "unit/output/temporary_folder.hpp"

namespace breccia::status_test {
namespace {

using nlohmann::json;
using test::lines_of;
using test::TemporaryFolder;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

StatusLine example_line() {
  StatusLine line;
  line.step = 1234;
  line.steps_total = 10000;
  line.time = 1.234e-5;
  line.end = 1e-4;
  line.share = 0.1234;
  line.element_steps_per_s = 1.31e7;
  line.wall_s = 10;
  line.eta_s = 71;
  line.energy_residual = 2e-5;
  line.broken_joints = 231;
  line.fragments = 12;
  line.imbalance = 1.125;
  line.decompositions = 3;
  line.stage = "impact";
  return line;
}

Summary ended(const std::string& status) {
  Summary summary;
  summary.status = status;
  summary.steps = 10000;
  summary.simulated_time = 1e-4;
  return summary;
}

TEST(StatusFile, BeginsWithTheFirstStepAndEndsWithTheState) {
  const TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl", std::chrono::hours(1));
  sink.start({});
  EXPECT_TRUE(sink.status_due());
  StatusLine line = example_line();
  line.step = 0;
  sink.status(line);
  EXPECT_FALSE(sink.status_due());
  sink.status(example_line());  // an hour has not passed
  sink.finish(ended("complete"));
  const auto lines = lines_of(folder / "status.jsonl");
  ASSERT_THAT(lines, SizeIs(2));
  const json first = json::parse(lines[0]), last = json::parse(lines[1]);
  EXPECT_EQ(first.at("state"), "running");
  EXPECT_EQ(first.at("step"), 0);
  EXPECT_EQ(last.at("state"), "complete");
  EXPECT_EQ(last.at("step"), 10000);
  EXPECT_EQ(last.at("share"), 1.0);
  EXPECT_EQ(last.at("eta_s"), 0.0);
  EXPECT_EQ(last.at("stage"), "impact");
  EXPECT_FALSE(last.contains("message"));
}

TEST(StatusFile, GetsALineWheneverTheIntervalHasPassed) {
  const TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl", std::chrono::milliseconds(0));
  sink.start({});
  for (int i = 0; i < 3; ++i) sink.status(example_line());
  EXPECT_THAT(lines_of(folder / "status.jsonl"), SizeIs(3));
}

TEST(StatusFile, OfAFailedRunEndsWithItsMessageAndTheShareItReached) {
  const TemporaryFolder folder;
  StatusSink sink(folder / "status.jsonl");
  sink.start({});
  sink.status(example_line());
  sink.finish(ended("step 99: element 3 has no finite velocity"));
  const json last = json::parse(lines_of(folder / "status.jsonl").back());
  EXPECT_EQ(last.at("state"), "failed");
  EXPECT_EQ(last.at("message"), "step 99: element 3 has no finite velocity");
  EXPECT_EQ(last.at("share"), 0.1234);
}

TEST(StatusFile, InAnUnwritablePlaceIsAnOutputError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(StatusSink(folder / "missing/status.jsonl").start({}), OutputError);
}

TEST(StatusJson, HoldsEveryMemberOnOneLine) {
  const std::string text = status_json(example_line(), RunState::running, "");
  EXPECT_THAT(text, Not(HasSubstr("\n")));
  EXPECT_EQ(json::parse(text), json({{"state", "running"},
                                     {"stage", "impact"},
                                     {"step", 1234},
                                     {"steps_total", 10000},
                                     {"time", 1.234e-5},
                                     {"end", 1e-4},
                                     {"share", 0.1234},
                                     {"element_steps_per_s", 1.31e7},
                                     {"wall_s", 10.0},
                                     {"eta_s", 71.0},
                                     {"energy_residual", 2e-5},
                                     {"imbalance", 1.125},
                                     {"decompositions", 3},
                                     {"broken_joints", 231},
                                     {"fragments", 12}}));
}

TEST(StatusJson, IsValidForNumbersAndNamesThatJsonCannotHold) {
  StatusLine line = example_line();
  line.eta_s = -1;
  line.energy_residual = std::numeric_limits<double>::quiet_NaN();
  line.stage = "\xff\"\n";
  const std::string text = status_json(line, RunState::running, "");
  EXPECT_THAT(text, Not(HasSubstr("\n")));
  const json parsed = json::parse(text);
  EXPECT_TRUE(parsed.at("eta_s").is_null());
  EXPECT_TRUE(parsed.at("energy_residual").is_null());
}

TEST(ProgressMode, SaysHowOftenAPersonAndAProgramHear) {
  using namespace std::chrono_literals;
  EXPECT_EQ(interval_of(ProgressMode::bar), 200ms);
  EXPECT_EQ(interval_of(ProgressMode::json), 500ms);
  EXPECT_EQ(interval_of(ProgressMode::log), 5s);
}

TEST(ProgressText, ShowsShareStepTimeSpeedTimeToGoAndStage) {
  const std::string text = progress_text(example_line());
  for (const char* part : {"12.3 %", "step 1,234 of 10,000", "12.3 us of 100 us", "13.1 M element-steps/s",
                           "1 min 11 s to go", "2.0e-05", "broken joints 231", "fragments 12", "[impact]"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(BarText, NeverFillsTheTerminalsWidth) {
  for (const int columns : {2, 20, 80, 200}) {
    EXPECT_LT(bar_text(example_line(), columns).size(), static_cast<std::size_t>(columns));
  }
  EXPECT_THAT(bar_text(example_line(), 200), StartsWith("[##......................]  12.3 %"));
}

TEST(BarText, StandsForAShareThatIsNotANumber) {
  StatusLine line = example_line();
  line.share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(bar_text(line, 200), StartsWith("[........................]"));
}

TEST(ProgressBar, IsRedrawnInPlaceAndEndsWithALineFeed) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::bar, stream);
  sink.status(example_line());
  EXPECT_THAT(stream.str(), StartsWith("\r"));
  EXPECT_THAT(stream.str(), Not(HasSubstr("\n")));
  sink.finish(ended("complete"));
  EXPECT_THAT(stream.str(), EndsWith("\n"));
  EXPECT_THAT(stream.str(), HasSubstr("[########################] 100.0 %"));
}

TEST(ProgressLog, EndsWithTheState) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::log, stream);
  sink.status(example_line());
  sink.finish(ended("no finite velocity"));
  EXPECT_THAT(stream.str(), EndsWith("failed\n"));
}

TEST(ProgressJson, LinesParseAndTheLastHasTheState) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::json, stream);
  sink.status(example_line());
  sink.status(example_line());  // not due yet
  sink.finish(ended("stopped: signal 15"));
  std::istringstream text(stream.str());
  std::vector<json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_EQ(lines[0].at("state"), "running");
  EXPECT_EQ(lines[1].at("state"), "stopped");
  EXPECT_EQ(lines[1].at("message"), "stopped: signal 15");
}

TEST(ProgressNone, IsNeverDueAndSilent) {
  std::ostringstream stream;
  ProgressSink sink(ProgressMode::none, stream);
  EXPECT_FALSE(sink.status_due());
  sink.status(example_line());
  sink.finish(ended("complete"));
  EXPECT_THAT(stream.str(), IsEmpty());
}

TEST(ProgressMode, IsALogUnderALauncherOfRanksThoughItGivesThemATerminal) {
  const std::vector<const char*> launched{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
  for (const char* name : launched) ::unsetenv(name);
  const int pair = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(pair, 0);
  ASSERT_EQ(::grantpt(pair) + ::unlockpt(pair), 0);
  const int terminal = ::open(::ptsname(pair), O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  EXPECT_EQ(default_progress_mode(terminal), ProgressMode::bar);
  for (const char* name : launched) {
    ::setenv(name, "2", 1);
    EXPECT_EQ(default_progress_mode(terminal), ProgressMode::log) << name;
    ::unsetenv(name);
  }
  ::close(terminal);
  ::close(pair);
}

}  // namespace
}  // namespace breccia::status_test
