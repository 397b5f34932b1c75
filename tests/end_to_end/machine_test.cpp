#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "end_to_end/process_tree.hpp"
#include "end_to_end/program.hpp"

/// File systems without locks, logouts, suspended jobs and networks.
namespace breccia::test::machine_test {
namespace {

namespace fs = std::filesystem;

std::size_t count_in(const fs::path& folder, const std::string& ending) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    count += entry->path().string().ends_with(ending) ? 1 : 0;
  return count;
}

class Machine : public testing::TestWithParam<int> {
 protected:
  [[nodiscard]] std::string arguments(const std::string& settings = "") const {
    return "run " + case_ + " --progress none -o '" + run_.string() + "' " + settings;
  }
  const Scratch scratch_;
  const std::string case_ = scratch_.write("case.toml", kSmallCase + "[checkpoint]\nsteps = 20\n");
  const fs::path run_ = scratch_.path("run");
};
INSTANTIATE_TEST_SUITE_P(Ranks, Machine, testing::Values(1, 2));

TEST_P(Machine, WithoutLocksOfFilesWritesFramesAndCheckpointsAllTheSame) {
  const std::string preload = "LD_PRELOAD=" BRECCIA_NO_LOCKS;
  const Outcome outcome = GetParam() == 1 ? call(arguments(), preload) : call_ranks(GetParam(), arguments(), preload);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_GE(count_in(run_ / "frames", ".vtkhdf"), 4U);
  EXPECT_GE(count_in(run_ / "checkpoints", ".h5"), 1U);
  const Outcome resumed = call("resume '" + run_.string() + "' --until '4.05 ms' --progress none", preload);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

TEST_P(Machine, ThatRunsAJobLetsNothingOfItListenBeyondTheMachine) {
  forget_network_settings();
  const std::string longer = arguments("--set 'stage[0].end=1000 s'");
  const pid_t process =
      GetParam() == 1 ? start_process("exec '" BRECCIA_PROGRAM "' " + longer) : start_ranks(GetParam(), longer);
  ASSERT_TRUE(wait_until([&] { return count_in(run_ / "checkpoints", ".h5") > 0; }));
  // What the launcher itself listens at is the launcher's: mpiexec speaks to daemons of other machines there.
  for (const pid_t one : tree_below(process)) {
    if (name_of(one) == "breccia") {
      EXPECT_EQ(open_listeners(one), "") << "process " << one;
    }
  }
  end_tree(process);
}

TEST(BackgroundRun, OutlivesALogoutWhereTheSignalWasIgnoredAtItsStart) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase + "[checkpoint]\nsteps = 20\n");
  const fs::path run = scratch.path("run");
  for (const auto& [number, name] : {std::pair{SIGHUP, "HUP"}, {SIGINT, "INT"}}) {
    fs::remove_all(run);
    const pid_t process = start_process("trap '' " + std::string(name) + "; exec '" BRECCIA_PROGRAM "' run " + file +
                                        " --progress none -o '" + run.string() + "'");
    ASSERT_TRUE(wait_until([&] { return count_in(run / "checkpoints", ".h5") > 0; }));
    kill(process, number);
    int status = 0;
    waitpid(process, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << name;
    EXPECT_THAT(read_text(run / "summary.json"), testing::HasSubstr("\"status\": \"complete\"")) << name;
  }
}

TEST(SuspendedRun, GoesOnWhateverItsPatience) {
  constexpr auto kSuspended = std::chrono::seconds(6);  // more than twice the patience, after which a run ends
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase + "[checkpoint]\nsteps = 20\n");
  const fs::path run = scratch.path("run");
  const pid_t launcher = start_ranks(2, "run " + file + " --progress none --set domains.patience=2 --set " +
                                            "'stage[0].end=20 ms' -o '" + run.string() + "'");
  ASSERT_TRUE(wait_until([&] { return count_in(run / "checkpoints", ".h5") > 0; }));
  const std::vector<pid_t> all = tree_below(launcher);
  for (const pid_t one : all) kill(one, SIGSTOP);
  std::this_thread::sleep_for(kSuspended);
  for (const pid_t one : all) kill(one, SIGCONT);
  int status = 0;
  waitpid(launcher, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_THAT(read_text(run / "summary.json"), testing::HasSubstr("\"status\": \"complete\""));
}

}  // namespace
}  // namespace breccia::test::machine_test
