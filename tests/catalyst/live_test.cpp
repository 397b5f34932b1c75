// The live link: a ParaView without windows (live_client.py) connects in mid-run, receives, pauses, continues, dies;
// the run goes on, and another one connects.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::live_test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kStep = std::chrono::milliseconds(20);         // of the run that is watched
constexpr auto kLongest = std::chrono::seconds(200);          // until the client must have done all
constexpr auto kPauseSeen = std::chrono::milliseconds(1500);  // the client pauses for two seconds
constexpr std::int64_t kStepsAfterDeath = 100;
constexpr std::uint32_t kPublished = (1U << BRECCIA_ELEMENTS) | (1U << BRECCIA_FRACTURES) | (1U << BRECCIA_DOMAINS);

/// A port p such that p and the ports after it, one a rank, which ParaView takes for data, are free.
int free_port() {
  for (int port = 21000 + getpid() % 8000; port < 32000; port += 10) {
    bool all_free = true;
    for (int next = port; next < port + 5; ++next) {
      const int listener = socket(AF_INET, SOCK_STREAM, 0);
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(static_cast<std::uint16_t>(next));
      all_free = bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 && all_free;
      close(listener);
    }
    if (all_free) return port;
  }
  return 0;
}

/// A child process that dies with us.
class Client {
 public:
  /// @param how  an option of live_client.py, or nothing
  Client(int port, const std::filesystem::path& folder, const char* how) {
    child_ = fork();
    if (child_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    setpgid(0, 0);
    // Not a rank of this run: without what mpiexec has put into the environment.
    const std::string path = std::string("PATH=") + std::getenv("PATH");
    execlp("env", "env", "-i", path.c_str(), "HOME=/tmp", "OMPI_ALLOW_RUN_AS_ROOT=1",
           "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "xvfb-run", "-a", "-s", "-screen 0 800x600x24 -noreset", "pvpython",
           BRECCIA_LIVE_CLIENT, std::to_string(port).c_str(), folder.c_str(), how, nullptr);
    _exit(127);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() {
    if (child_ <= 0) return;
    kill(-child_, SIGTERM);  // xvfb-run ends its server
    for (int i = 0; i < 30 && waitpid(child_, nullptr, WNOHANG) == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(-child_, SIGKILL);
  }

 private:
  pid_t child_;
};

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A run that a client may watch.
class WatchedRun {
 public:
  /// What became of it while a client came and went.
  struct Course {
    std::int64_t connected_steps = 0, steps_after_death = 0;
    Clock::duration longest{};  ///< step
  };

  WatchedRun(const std::filesystem::path& folder, int port)
      : config_(folder, world().communicator, world().rank, world().size), port_(port) {
    adaptor_.emplace(config_.add("live", kPublished).live(port).get());
  }
  [[nodiscard]] bool is_open() const { return adaptor_->is_open(); }
  [[nodiscard]] std::uint32_t channels() { return adaptor_->channels(0, step_, SyntheticRun::time_of(step_)); }
  [[nodiscard]] std::int64_t total(int channel) const { return run_.total(channel, 1); }

  /// Goes on, with a client from the tenth step on, until some steps after it has died, or until patience is at an end.
  /// Collective.
  /// @param folder  where the client leaves its word
  Course go_on(const std::filesystem::path& folder, const char* how) {
    Course course;
    std::optional<Client> client;
    const auto begin = Clock::now();
    for (int i = 0;
         course.steps_after_death < kStepsAfterDeath && broadcast(Clock::now() - begin < kLongest ? 1 : 0) != 0; ++i) {
      if (i == 10 && world().rank == 0) client.emplace(port_, folder, how);
      const auto before = Clock::now();
      if (step()) ++course.connected_steps;
      course.longest = std::max(course.longest, Clock::now() - before);
      const bool done = world().rank == 0 && std::filesystem::exists(folder / "done");
      if (broadcast(done ? 1 : 0) != 0) ++course.steps_after_death;
      if (world().rank == 0) std::ofstream(folder / "step") << step_;
      std::this_thread::sleep_for(kStep);
    }
    return course;
  }

 private:
  /// @return  whether somebody listened
  bool step() {
    ++step_;
    const std::uint32_t wanted = channels();
    if (wanted == 0) return false;
    EXPECT_EQ(wanted, kPublished);
    EXPECT_EQ(adaptor_->execute(1, run_.at(step_, wanted)), 0U) << adaptor_->text;
    run_.take_away();
    run_.give_back();
    return true;
  }

  SyntheticRun run_{3, world().rank, world().size};
  Config config_;
  int port_;
  std::optional<Adaptor> adaptor_;
  std::int64_t step_ = 0;
};

TEST(Live, AParaViewConnectsInMidRunReceivesPausesContinuesAndDiesAndAnotherOneConnects) {
  const auto folder = fresh_folder("live"), again = fresh_folder("live_again");
  const int port = broadcast(world().rank == 0 ? free_port() : 0);
  ASSERT_NE(port, 0);
  WatchedRun run(folder, port);
  ASSERT_TRUE(run.is_open());
  EXPECT_EQ(run.channels(), 0U) << "nobody listens: nothing is asked of the solver";

  const WatchedRun::Course first = run.go_on(folder, nullptr);
  const std::string log = content(folder / "client.log");
  EXPECT_EQ(first.steps_after_death, kStepsAfterDeath) << "the client did not come to its end:\n" << log;
  EXPECT_GT(first.connected_steps, 0);
  EXPECT_GT(first.longest, kPauseSeen) << "the pause held the run";
  EXPECT_EQ(run.channels(), 0U) << "the dead client was noticed";

  const WatchedRun::Course second = run.go_on(again, "--briefly");
  const std::string log_again = content(again / "client.log");
  EXPECT_EQ(second.steps_after_death, kStepsAfterDeath) << "the second client did not come to its end:\n" << log_again;
  EXPECT_GT(second.connected_steps, 0);

  if (world().rank != 0) return;
  const std::string elements = "elements " + std::to_string(run.total(BRECCIA_ELEMENTS)) + " cells";
  EXPECT_THAT(log, testing::HasSubstr(elements));
  EXPECT_THAT(log, testing::HasSubstr("domains " + std::to_string(world().size) + " cells"));
  EXPECT_THAT(log, testing::HasSubstr("fractures changed"));
  EXPECT_THAT(log, testing::HasSubstr("stood still"));
  EXPECT_THAT(log, testing::HasSubstr("went on"));
  EXPECT_THAT(log, testing::HasSubstr("picture shows something"));
  EXPECT_THAT(log_again, testing::HasSubstr(elements));
}

}  // namespace
}  // namespace breccia::test::live_test
