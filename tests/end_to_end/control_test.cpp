#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "end_to_end/program.hpp"

namespace breccia::test::control_test {
namespace {

using nlohmann::json;

/// A run of the small case that would last for hours, on several ranks; ended with the object. Its steps are so short
/// that nothing much happens in a test.
class LongRun {
 public:
  explicit LongRun(int ranks, const std::string& settings = "") : folder_(scratch_.path("run").string()) {
    const std::string file = scratch_.write("case.toml", kSmallCase);
    launcher_ = start_ranks(ranks, "run " + file +
                                       " --progress none --set 'stage[0].end=1000 s' --set 'time.step=10 ns' --set "
                                       "'output.frame_interval=0 s' " +
                                       settings + " -o '" + folder_ + "'");
    for (int look = 0; look < 500 && lines().empty(); ++look)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  LongRun(const LongRun&) = delete;
  LongRun& operator=(const LongRun&) = delete;
  ~LongRun() {
    if (launcher_ > 0) {
      kill(launcher_, SIGTERM);
      waitpid(launcher_, nullptr, 0);
    }
  }

  [[nodiscard]] Outcome ask(const std::string& command) const { return call("control '" + folder_ + "' " + command); }
  [[nodiscard]] std::vector<json> lines() const {
    std::vector<json> found;
    std::ifstream file(folder_ + "/status.jsonl");
    for (std::string line; std::getline(file, line);) {
      json parsed = json::parse(line, nullptr, false);
      if (parsed.is_object()) found.push_back(std::move(parsed));
    }
    return found;
  }
  /// The lines that tell the state of the run, as soon as they are as wanted, but no later than after half a minute.
  template <class Wanted>
  [[nodiscard]] std::vector<json> states_until(Wanted&& wanted) const {
    std::vector<json> states;
    for (int look = 0; look < 300; ++look) {
      states = lines();
      std::erase_if(states, [](const json& line) { return !line.contains("state"); });
      if (!states.empty() && wanted(states)) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return states;
  }
  void signal(int number) const { kill(launcher_, number); }
  int wait_for_end() {
    int status = 0;
    waitpid(std::exchange(launcher_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] const std::string& folder() const { return folder_; }

 private:
  Scratch scratch_;
  std::string folder_;
  pid_t launcher_ = 0;
};

std::ptrdiff_t count_paused(const std::vector<json>& states) {
  return std::count_if(states.begin(), states.end(), [](const json& line) { return line["state"] == "paused"; });
}

class Control : public testing::TestWithParam<int> {};

TEST_P(Control, PausesAndLetsGoOn) {
  LongRun run(GetParam());
  ASSERT_EQ(run.ask("pause").exit_code, 0);
  const std::vector<json> paused =
      run.states_until([](const std::vector<json>& seen) { return count_paused(seen) >= 2; });
  ASSERT_GE(count_paused(paused), 2) << "no word of a pause";
  EXPECT_EQ(paused.back()["step"], paused[paused.size() - 2]["step"]) << "a paused run went on";
  EXPECT_EQ(run.ask("pause").exit_code, 2) << "a second pause";
  ASSERT_EQ(run.ask("resume").exit_code, 0);
  const std::int64_t step = paused.back()["step"];
  const std::vector<json> after = run.states_until(
      [&](const std::vector<json>& seen) { return seen.back()["state"] == "running" && seen.back()["step"] > step; });
  EXPECT_EQ(after.back()["state"], "running");
  EXPECT_GT(after.back()["step"].get<std::int64_t>(), step);
}

TEST_P(Control, StopsInOrderAlsoWhilePaused) {
  LongRun run(GetParam());
  ASSERT_EQ(run.ask("pause").exit_code, 0);
  ASSERT_EQ(run.ask("stop").exit_code, 0);
  EXPECT_EQ(run.wait_for_end(), 0);
  EXPECT_EQ(run.lines().back()["state"], "stopped");
  EXPECT_EQ(json::parse(read_text(run.folder() + "/summary.json"))["status"].get<std::string>().substr(0, 7),
            "stopped");
  EXPECT_EQ(run.ask("pause").exit_code, 2) << "of a run that has ended";
}

TEST_P(Control, WritesACheckpointThatASignalAsksForAlsoWhilePaused) {
  LongRun run(GetParam(), "--set 'checkpoint.steps=0'");
  ASSERT_EQ(run.ask("pause").exit_code, 0);
  run.signal(SIGUSR1);
  std::ptrdiff_t told = 0;
  for (int look = 0; look < 500 && told == 0; ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::vector<json> lines = run.lines();
    told = std::count_if(lines.begin(), lines.end(), [](const json& line) {
      return line.value("text", "").starts_with("checkpoint ") && line.value("accepted", false);
    });
  }
  EXPECT_EQ(told, 1);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(run.folder() + "/checkpoints"), {}), 1);
}

TEST_P(Control, SamplesTheEnergiesOfTheStepInWhichARunIsStopped) {
  LongRun run(GetParam(), "--set 'output.history_interval=1000 s'");
  const auto is_running = [](const std::vector<json>& seen) { return seen.back()["step"] > 100; };
  ASSERT_GT(run.states_until(is_running).back()["step"], 100);
  ASSERT_EQ(run.ask("stop").exit_code, 0);
  EXPECT_EQ(run.wait_for_end(), 0);
  const double first = history_column(run.folder() + "/history.csv", "kinetic [J]").front();
  EXPECT_NE(json::parse(read_text(run.folder() + "/summary.json"))["energy"]["kinetic"].get<double>(), first);
}

TEST_P(Control, GetsAFrameAtOnceAndThenAsOftenAsAsked) {
  LongRun run(GetParam());
  ASSERT_EQ(run.ask("frame").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(run.folder() + "/frames/elements_000000.vtkhdf"));
  EXPECT_FALSE(std::filesystem::exists(run.folder() + "/frames/elements_000001.vtkhdf"));
  ASSERT_EQ(run.ask("frame_interval 1 us").exit_code, 0);
  for (int look = 0; look < 500 && !std::filesystem::exists(run.folder() + "/frames/elements_000002.vtkhdf"); ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(std::filesystem::exists(run.folder() + "/frames/elements_000002.vtkhdf"));
}

TEST_P(Control, RefusesWhatCannotBeAndSaysWhy) {
  LongRun run(GetParam());
  const Outcome extract = run.ask("extract");
  EXPECT_EQ(extract.exit_code, 2);
  EXPECT_NE(extract.err.find("no pipelines"), std::string::npos) << extract.err;
  const Outcome resume = run.ask("resume");
  EXPECT_EQ(resume.exit_code, 2);
  EXPECT_NE(resume.err.find("not paused"), std::string::npos) << resume.err;
  std::ofstream(run.folder() + "/control") << "dance id=7\n";
  json answer;
  for (int look = 0; look < 250 && answer.is_null(); ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (const json& line : run.lines()) {
      if (line.value("id", "") == "7") answer = line;
    }
  }
  EXPECT_FALSE(answer.value("accepted", true));
  EXPECT_NE(answer.value("text", "").find("pause, resume, stop"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(OfRanks, Control, testing::Values(1, 2), testing::PrintToStringParamName());

}  // namespace
}  // namespace breccia::test::control_test
