#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "end_to_end/program.hpp"

/// What happens to a run from outside: a rank that is stopped; and that the run goes on to the same end afterwards.
namespace breccia::test::disturbance_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Long enough for what is done to the run, with checkpoints.
constexpr const char* kSettings = " --progress none --set 'stage[0].end=20 ms' --set checkpoint.steps=200 ";

std::string hash_of(const fs::path& run) {
  const json summary = json::parse(read_text(run / "summary.json"), nullptr, false);
  return summary.is_object() ? summary.value("state_hash", "") : "no summary";
}

bool within(std::chrono::seconds limit, const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// Ranks that a launcher has started.
std::vector<pid_t> ranks_of(pid_t launcher) {
  std::ifstream file("/proc/" + std::to_string(launcher) + "/task/" + std::to_string(launcher) + "/children");
  std::vector<pid_t> ranks;
  for (pid_t child = 0; file >> child;) ranks.push_back(child);
  return ranks;
}

class Disturbed : public testing::Test {
 protected:
  Disturbed() : case_(scratch_.write("case.toml", kSmallCase)) {}

  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path(name); }
  [[nodiscard]] std::string quoted(const std::string& name) const { return "'" + folder(name).string() + "'"; }
  [[nodiscard]] bool has_checkpoint(const std::string& name) const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder(name) / "checkpoints", error))
      if (entry.path().extension() == ".h5") return true;
    return false;
  }
  /// The launcher of a run that has written a checkpoint.
  pid_t start(int ranks, const std::string& settings = "") {
    const pid_t launcher = start_ranks(ranks, "run " + case_ + kSettings + settings + " -o " + quoted("run"));
    EXPECT_TRUE(within(std::chrono::seconds(60), [&] { return has_checkpoint("run"); }));
    return launcher;
  }
  /// Exit code of the launcher, which is killed where it does not end.
  static int end_of(pid_t launcher) {
    int status = 0;
    if (!within(std::chrono::seconds(90), [&] { return waitpid(launcher, &status, WNOHANG) == launcher; })) {
      kill(launcher, SIGKILL);
      waitpid(launcher, &status, 0);
      return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void expect_goes_on_to_the_same_end(const std::string& name) {
    const Outcome whole = call("run " + case_ + kSettings + " -o " + quoted("whole"));
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    const Outcome resumed = call("resume " + quoted(name) + " --progress none");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(hash_of(folder(name)), hash_of(folder("whole")));
    EXPECT_EQ(history_without_couples(folder(name) / "history.csv"),
              history_without_couples(folder("whole") / "history.csv"));
  }

  Scratch scratch_;
  std::string case_;
};

TEST_F(Disturbed, ByARankThatIsStoppedARunEndsAfterItsPatienceAsByAFaultOfTheMachine) {
  const pid_t launcher = start(2, "--set domains.patience=1");
  const std::vector<pid_t> ranks = ranks_of(launcher);
  ASSERT_EQ(ranks.size(), 2U);
  ASSERT_EQ(kill(ranks[1], SIGSTOP), 0);
  EXPECT_EQ(end_of(launcher), 2);
  kill(ranks[1], SIGCONT);
  expect_goes_on_to_the_same_end("run");
}

}  // namespace
}  // namespace breccia::test::disturbance_test
