// A run that ParaView holds: whoever wants it to end need not find that ParaView.

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <thread>

#include "end_to_end/program.hpp"

namespace breccia::test::live_pause_test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr auto kStill = milliseconds(3000);  // the history has a row every millisecond or so while the run goes on
constexpr int kLooks = 600;                  // of 100 ms: until ParaView has started and connected

/// A port that was free a moment ago.
int free_port() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  bind(listener, reinterpret_cast<sockaddr*>(&address), size);
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  close(listener);
  return ntohs(address.sin_port);
}

/// Waits for it, a minute at most.
bool comes(const std::function<bool()>& condition) {
  for (int look = 0; look < kLooks && !condition(); ++look) std::this_thread::sleep_for(milliseconds(100));
  return condition();
}

/// A run that would last for hours, held by a ParaView without windows.
class HeldRun {
 public:
  explicit HeldRun(int ranks) {
    const int port = free_port();
    client_ = fork();
    if (client_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      execlp("pvpython", "pvpython", "--force-offscreen-rendering", BRECCIA_PAUSE_CLIENT, std::to_string(port).c_str(),
             scratch_.path("paused").c_str(), nullptr);
      _exit(127);
    }
    const std::string file = scratch_.write("case.toml", kSmallCase);
    run_ = start_ranks(ranks, "run " + file + " --progress none -o '" + folder().string() +
                                  "' --set 'stage[0].end=1000 s' --set 'time.step=10 ns' --set "
                                  "'output.frame_interval=0 s' --set 'output.history_interval=1 us' --set "
                                  "'insitu.live.interval=0 s' --set insitu.live.max_overhead=0.9 --live localhost:" +
                                  std::to_string(port));
  }
  HeldRun(const HeldRun&) = delete;
  HeldRun& operator=(const HeldRun&) = delete;
  ~HeldRun() {
    for (const pid_t process : {client_, run_}) {
      if (process > 0) kill(process, SIGKILL);
      if (process > 0) waitpid(process, nullptr, 0);
    }
  }

  [[nodiscard]] fs::path folder() const { return scratch_.path("run"); }
  /// Asks each rank to end, not the launcher, which would soon kill them.
  void interrupt() const {
    const std::string launcher = std::to_string(run_);
    std::istringstream ranks(read_text("/proc/" + launcher + "/task/" + launcher + "/children"));
    for (pid_t rank = 0; ranks >> rank;) kill(rank, SIGTERM);
  }
  /// Whether the pause has come and the run stands still.
  [[nodiscard]] bool stands() const {
    if (!comes([&] { return fs::exists(scratch_.path("paused")); })) return false;
    return comes([&] {
      const auto before = rows();
      std::this_thread::sleep_for(kStill);
      return before > 0 && rows() == before;
    });
  }
  /// Whether it ends by itself.
  [[nodiscard]] bool ends() {
    return comes([&] {
      if (run_ > 0 && waitpid(run_, nullptr, WNOHANG) == run_) run_ = 0;
      return run_ == 0;
    });
  }
  [[nodiscard]] std::string status() const {
    return nlohmann::json::parse(read_text(folder() / "summary.json"))["status"].get<std::string>();
  }

 private:
  [[nodiscard]] std::uintmax_t rows() const {
    std::error_code error;
    const auto size = fs::file_size(folder() / "history.csv", error);
    return error ? 0 : size;
  }

  Scratch scratch_;
  pid_t client_ = 0, run_ = 0;
};

class LivePause : public testing::TestWithParam<int> {};

TEST_P(LivePause, OfParaViewIsEndedByAStopThatTheRunIsTold) {
  HeldRun run(GetParam());
  ASSERT_TRUE(run.stands());
  const Outcome asked = call("control '" + run.folder().string() + "' stop");
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  ASSERT_TRUE(run.ends());
  EXPECT_EQ(run.status().substr(0, 7), "stopped");
}

TEST_P(LivePause, OfParaViewIsEndedByASignalThatAsksTheRunToEnd) {
  HeldRun run(GetParam());
  ASSERT_TRUE(run.stands());
  run.interrupt();
  ASSERT_TRUE(run.ends());
  EXPECT_EQ(run.status().substr(0, 7), "stopped");
}

INSTANTIATE_TEST_SUITE_P(OfRanks, LivePause, testing::Values(1, 2), testing::PrintToStringParamName());

}  // namespace
}  // namespace breccia::test::live_pause_test
