#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"

/// Gauges at points, conditions that end runs and stages, triggers: on any number of ranks and after a resume.
namespace breccia::test::experiment_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string kGauges = R"([[gauge]]
name = "mouth"
kind = "extensometer"
from = ["5 mm", "10 mm", "5 mm"]
to = ["15 mm", "10 mm", "5 mm"]
[[gauge]]
name = "corner"
kind = "point"
at = ["41 mm", "20 mm", "10 mm"]
[[gauge]]
name = "cut"
kind = "line"
from = [0, "10 mm", "5 mm"]
to = ["20 mm", "10 mm", "5 mm"]
points = 5
[[gauge]]
name = "side"
kind = "cracks"
group = "box.x1"
)";

/// The small case with these lines before its stage.
std::string with(const std::string& lines) { return changed("[[stage]]", kGauges + lines + "[[stage]]"); }

json summary_of(const fs::path& run) { return json::parse(read_text(run / "summary.json")); }

std::vector<json> events(const fs::path& run, const std::string& kind) {
  std::vector<json> found;
  std::ifstream file(run / "status.jsonl");
  for (std::string line; std::getline(file, line);) {
    const json read = json::parse(line);
    if (read.value("event", "") == kind) found.push_back(read);
  }
  return found;
}

std::vector<double> frame_times(const fs::path& run) {
  std::vector<double> times;
  const json series = json::parse(read_text(run / "frames/elements.hdf.series"));
  for (const json& file : series.at("files")) times.push_back(file.at("time"));
  return times;
}

class Experiment : public testing::Test {
 protected:
  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path(name); }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + folder(name).string() + "'"; }

  json run(const std::string& text, const std::string& name, int ranks = 1, const std::string& settings = "") {
    const std::string file = scratch_.write(name + ".toml", text);
    const Outcome outcome = call_ranks(ranks, "run --progress none -o " + quoted(name) + " " + file + " " + settings);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? summary_of(folder(name)) : json();
  }
  json resume(const std::string& name, int ranks, const std::string& settings = "") {
    const Outcome outcome = call_ranks(ranks, "resume " + quoted(name) + " --progress none " + settings);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? summary_of(folder(name)) : json();
  }
  void expect_same(const std::string& one, const std::string& other) {
    const json a = summary_of(folder(one)), b = summary_of(folder(other));
    for (const char* key : {"status", "steps", "state_hash", "gauges", "energy"})
      EXPECT_EQ(a.at(key), b.at(key)) << key;
    EXPECT_EQ(a.value("conditions", json()), b.value("conditions", json()));
    EXPECT_TRUE(history_without_couples(folder(one) / "history.csv") ==
                history_without_couples(folder(other) / "history.csv"));
    EXPECT_EQ(frame_times(folder(one)), frame_times(folder(other)));
  }
  std::vector<double> column(const std::string& run, const std::string& name) {
    return history_column(folder(run) / "history.csv", name);
  }

  Scratch scratch_;
};

TEST_F(Experiment, GaugesAtPointsLeaveTheMotionAsItIs) {
  const json without = run(kSmallCase, "without"), with_gauges = run(with(""), "with");
  EXPECT_EQ(without.at("state_hash"), with_gauges.at("state_hash"));
  EXPECT_GT(std::abs(column("with", "corner displacement x [m]").back()), 1e-4);
  EXPECT_GT(column("with", "cut 3 stress xx [Pa]").size(), 20U);
  EXPECT_GT(column("with", "mouth elongation [m]").back(), 0);
  const std::vector<double> side = column("with", "side broken joints");
  EXPECT_TRUE(std::is_sorted(side.begin(), side.end()));
  EXPECT_GT(side.back(), 0);
  EXPECT_LT(side.back(), with_gauges.at("broken_joints"));
}

TEST_F(Experiment, GivesTheSameBitsOnAnyNumberOfRanks) {
  const std::string text = with(
      "[time]\nstop_when = \"mouth.elongation > 0.1 mm and broken_joints > 55 for 0.1 ms\"\n"
      "[[trigger]]\nwhen = \"side.broken_joints > 0\"\naction = \"frame\"\n"
      "[[trigger]]\nwhen = \"max_speed < 0.7 * peak(max_speed)\"\naction = \"frame\"\nonce = "
      "false\n");
  const json one = run(text, "one");
  EXPECT_EQ(one.at("conditions").size(), 3U) << one.at("conditions");
  for (const int ranks : {2, 3, 4}) {
    (void)run(text, "on" + std::to_string(ranks), ranks);
    expect_same("one", "on" + std::to_string(ranks));
  }
  const Outcome diff = call("diff " + quoted("one") + " " + quoted("on2"));
  EXPECT_THAT(diff.out, HasSubstr("results\n  ranks: 1 | 2\nhistory: the same"));
  (void)run(text, "divided", 3, "--set domains.margin=0.1");
  expect_same("one", "divided");
}

TEST_F(Experiment, AConditionEndsTheRunWithEverythingWritten) {
  const json stopped = run(with("[time]\nstop_when = \"broken_joints > 10\"\n"), "stopped");
  const json whole = run(with(""), "whole");
  const std::string parted = call("diff " + quoted("stopped") + " " + quoted("whole")).out;
  EXPECT_THAT(parted, HasSubstr("conditions[0].times: 1 | (none)"));
  EXPECT_EQ(parted.find("gauges"), std::string::npos) << "the history compares their columns";
  EXPECT_LT(stopped.at("steps"), whole.at("steps"));
  EXPECT_THAT(stopped.at("status").get<std::string>(),
              HasSubstr("stopped: time.stop_when = \"broken_joints > 10\" is true at "));
  EXPECT_GT(column("stopped", "broken joints").back(), 10);
  const std::vector<double> broken = column("stopped", "broken joints");
  EXPECT_LE(broken[broken.size() - 2], 10) << "at the first line at which it is true";
  const json held = stopped.at("conditions").at(0);
  EXPECT_EQ(held.at("last").at("values").at("broken_joints"), broken.back());
  EXPECT_EQ(held.at("last").at("time"), column("stopped", "time [s]").back());
  ASSERT_EQ(events(folder("stopped"), "condition").size(), 1U);
  EXPECT_THAT(events(folder("stopped"), "condition")[0].at("text").get<std::string>(), HasSubstr("broken_joints = "));
  EXPECT_DOUBLE_EQ(frame_times(folder("stopped")).back(), stopped.at("simulated_time"));
  const std::string checkpoint = std::to_string(stopped.at("steps").get<int>());
  EXPECT_TRUE(fs::exists(folder("stopped") / "checkpoints" /
                         ("step_" + std::string(12 - checkpoint.size(), '0') + checkpoint + ".h5")));
}

TEST_F(Experiment, AStoppedRunContinuesAsIfItHadNotStopped) {
  const json whole = run(with(""), "whole");
  (void)run(with("[time]\nstop_when = \"broken_joints > 10\"\n"), "stopped");
  EXPECT_EQ(resume("stopped", 2).at("state_hash"), whole.at("state_hash"));
  EXPECT_EQ(column("stopped", "time [s]"), column("whole", "time [s]"));
}

TEST_F(Experiment, ARunResumedBeforeTheEndDecidesTheSame) {
  // The peak lies before the interruption, the fall behind it.
  const std::string text = with(
      "[time]\nstop_when = \"broken_joints > 5 and max_speed < 0.97 * peak(max_speed) for 0.2 ms\"\n"
      "[[trigger]]\nwhen = \"broken_joints > 1\"\naction = \"frame\"\n");
  const json whole = run(text, "whole");
  ASSERT_THAT(whole.at("status").get<std::string>(), HasSubstr("stopped: time.stop_when"));
  const auto steps = whole.at("steps").get<int>();
  for (const int before : {steps / 2, steps - 15, steps - 1}) {
    const std::string name = "at" + std::to_string(before);
    (void)run(text, name, 2, "--set time.max_steps=" + std::to_string(before));
    (void)resume(name, 1, "--set time.max_steps=0");
    expect_same("whole", name);
  }
}

/// Two stages: the second one pushes from its start at 2 ms.
std::string two_stages(const std::string& first) {
  std::string text = with("[[gauge]]\nname = \"hold\"\nkind = \"point\"\nat = [0, 0, 0]\n");
  const std::string end = "end = \"4 ms\"", output = "[output]";
  text.replace(text.find(end), end.size(), "end = \"2 ms\"\n" + first);
  return text.replace(text.find(output), output.size(),
                      "[[stage]]\nname = \"push\"\nend = \"4 ms\"\n[[stage.constraint]]\ngroup = \"box.x0\"\n"
                      "displacement = { z = { table = [[\"2 ms\", 0], [\"4 ms\", \"1 mm\"]] } }\n[output]\n"
                      "history_interval = \"50 us\"");
}

TEST_F(Experiment, AStageThatEndsEarlyBringsTheNextOnesForward) {
  const json plain = run(two_stages(""), "plain"), early = run(two_stages("stop_when = \"time > 0.5 ms\""), "early");
  EXPECT_EQ(early.at("status"), "complete");
  EXPECT_NEAR(plain.at("simulated_time"), 4e-3, 1e-9);
  const double saved = 4e-3 - early.at("simulated_time").get<double>();
  EXPECT_NEAR(saved, 1.45e-3, 2e-5) << "by the line at 0.55 ms";
  EXPECT_EQ(early.at("conditions").at(0).at("action"), "end of the stage");
  // The table of the second stage begins with it and is done at its end.
  const std::vector<double> moved = column("early", "hold displacement z [m]"), times = column("early", "time [s]");
  const std::vector<double> plain_moved = column("plain", "hold displacement z [m]");
  const auto first = static_cast<std::size_t>(
      std::find_if(times.begin(), times.end(), [&](double t) { return t > 2e-3 - saved + 1e-4; }) - times.begin());
  EXPECT_GT(moved[first] - moved[first - 1], 1e-5);
  EXPECT_NEAR(moved.back(), 1e-3, 1e-5);
  EXPECT_NEAR(plain_moved.back(), 1e-3, 1e-5);
}

TEST_F(Experiment, AStageThatEndsEarlyDoesSoOnAnyNumberOfRanksAndAfterAResume) {
  const std::string text = two_stages("stop_when = \"broken_joints > 3\"");
  const json one = run(text, "one");
  ASSERT_EQ(one.at("conditions").size(), 1U);
  (void)run(text, "two", 2);
  expect_same("one", "two");
  const auto steps = one.at("steps").get<int>();
  const auto at = one.at("conditions").at(0).at("first").at("step").get<int>();
  for (const int before : {at, at + 1, at + 2, steps - 3}) {  // before its end, at it, in the second stage
    const std::string name = "at" + std::to_string(before);
    (void)run(text, name, 1, "--set time.max_steps=" + std::to_string(before));
    (void)resume(name, 2, "--set time.max_steps=0");
    expect_same("one", name);
  }
}

TEST_F(Experiment, ATriggerWritesAFrameAndACheckpoint) {
  const std::string text = with(
      "[[trigger]]\nwhen = \"broken_joints > 3\"\naction = \"frame\"\n"
      "[[trigger]]\nwhen = \"broken_joints > 6\"\naction = \"checkpoint\"\n");
  const json plain = run(with(""), "plain"), triggered = run(text, "triggered");
  EXPECT_EQ(plain.at("state_hash"), triggered.at("state_hash"));
  const json frame = triggered.at("conditions").at(0), checkpoint = triggered.at("conditions").at(1);
  EXPECT_EQ(frame_times(folder("triggered")).size(), frame_times(folder("plain")).size() + 1);
  const std::string step = std::to_string(checkpoint.at("first").at("step").get<int>() + 1);
  EXPECT_TRUE(
      fs::exists(folder("triggered") / "checkpoints" / ("step_" + std::string(12 - step.size(), '0') + step + ".h5")))
      << step;
  const std::vector<double> times = frame_times(folder("triggered"));
  const double at = frame.at("first").at("time").get<double>();
  EXPECT_TRUE(std::any_of(times.begin(), times.end(), [&](double t) {
    return t > at && t < at + 1.5 * triggered.at("time_step").get<double>();
  })) << at;
}

TEST_F(Experiment, PeaksOfEveryGaugeAreInTheSummary) {
  const json summary = run(with(""), "run");
  const auto found = std::find_if(summary.at("gauges").begin(), summary.at("gauges").end(), [](const json& entry) {
    return entry.at("gauge") == "corner" && entry.at("quantity") == "displacement x";
  });
  ASSERT_NE(found, summary.at("gauges").end());
  const std::vector<double> values = column("run", "corner displacement x [m]"), times = column("run", "time [s]");
  const auto largest = std::max_element(values.begin(), values.end());
  EXPECT_EQ(found->at("largest").at("value"), *largest);
  EXPECT_EQ(found->at("largest").at("time"), times[static_cast<std::size_t>(largest - values.begin())]);
  EXPECT_THAT(read_text(folder("run") / "summary.txt"), HasSubstr("mouth elongation: largest "));
}

TEST_F(Experiment, CheckNamesFileLineKeyAndWhatIsNear) {
  const auto refused = [&](const std::string& text) {
    const Outcome outcome = call("check " + scratch_.write("wrong.toml", text));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused(with("[[trigger]]\nwhen = \"mouth.elongatoin > 1 um\"\naction = \"stop\"\n")),
              AllOf(HasSubstr("wrong.toml:"), HasSubstr("trigger[0].when: the history of this case has no column"),
                    HasSubstr("allowed: mouth.elongation")));
  EXPECT_THAT(refused(with("[[gauge]]\nname = \"out\"\nkind = \"point\"\nat = [\"50 mm\", 0, 0]\n")),
              AllOf(HasSubstr("gauge[4].at: the point lies outside of the model at rest"),
                    HasSubstr("the nearest place of the model is [\"41 mm\", \"0 mm\", \"0 mm\"]")));
  EXPECT_THAT(refused(with("[[gauge]]\nname = \"on\"\nkind = \"cracks\"\ngroup = \"box.x5\"\n")),
              AllOf(HasSubstr("gauge[4].group: the mesh has no surface"), HasSubstr("box.x0")));
}

TEST_F(Experiment, ARunFromAStateLooksForItsPointsAsWell) {
  (void)run(with(""), "parent", 1, "--set stage.fly.end=3.2e-3");
  const auto started = [](std::string text) {
    return text.insert(text.find("[mesh.raster]"), "[start]\nfrom = \"parent\"\n");
  };
  const std::string beyond = with("[[gauge]]\nname = \"out\"\nkind = \"point\"\nat = [\"50 mm\", 0, 0]\n");
  const Outcome outside = call_ranks(
      2, "run --progress none -o " + quoted("outside") + " " + scratch_.write("outside.toml", started(beyond)));
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_THAT(outside.err, AllOf(HasSubstr("gauge[4].at: the point lies outside"), HasSubstr("\"41 mm\"")));
  (void)run(started(with("")), "child", 2);
  EXPECT_GT(column("child", "side broken joints").front(), 0) << "cracks of the first run count";
}

}  // namespace
}  // namespace breccia::test::experiment_test
