// The live link: a ParaView without windows (live_client.py) connects in mid-run, receives, pauses, continues, dies; the run goes on.

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

namespace breccia::test {
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
  Client(int port, const std::filesystem::path& folder) {
    child_ = fork();
    if (child_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    setpgid(0, 0);
    // Not a rank of this run: without what mpiexec has put into the environment.
    const std::string path = std::string("PATH=") + std::getenv("PATH");
    execlp("env", "env", "-i", path.c_str(), "HOME=/tmp", "OMPI_ALLOW_RUN_AS_ROOT=1",
           "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "xvfb-run", "-a", "-s", "-screen 0 800x600x24 -noreset", "pvpython",
           BRECCIA_LIVE_CLIENT, std::to_string(port).c_str(), folder.c_str(), nullptr);
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

TEST(Live, AParaViewConnectsInMidRunReceivesPausesContinuesAndDiesWhileTheRunGoesOn) {
  const auto folder = fresh_folder("live");
  const int port = broadcast(world().rank == 0 ? free_port() : 0);
  ASSERT_NE(port, 0);
  SyntheticRun run(3, world().rank, world().size);
  Config config(folder, world().communicator, world().rank, world().size);
  Adaptor adaptor(config.add("live", kPublished).live(port).get());
  ASSERT_TRUE(adaptor.is_open());
  EXPECT_EQ(adaptor.channels(0, 0, 0.0), 0U) << "nobody listens: nothing is asked of the solver";

  std::optional<Client> client;
  const auto begin = Clock::now();
  auto longest = Clock::duration::zero();
  std::int64_t steps_after_death = 0;
  std::int64_t connected_steps = 0;
  for (std::int64_t number = 1;
       steps_after_death < kStepsAfterDeath && broadcast(Clock::now() - begin < kLongest ? 1 : 0) != 0; ++number) {
    if (number == 10 && world().rank == 0) client.emplace(port, folder);
    const std::uint32_t channels = adaptor.channels(0, number, SyntheticRun::time_of(number));
    const auto before = Clock::now();
    if (channels != 0) {
      EXPECT_EQ(channels, kPublished);
      EXPECT_EQ(adaptor.execute(1, run.at(number, channels)), 0U) << adaptor.text;
      run.take_away();
      run.give_back();
      ++connected_steps;
    }
    longest = std::max(longest, Clock::now() - before);
    const bool done = world().rank == 0 && std::filesystem::exists(folder / "done");
    if (broadcast(done ? 1 : 0) != 0) ++steps_after_death;
    if (world().rank == 0) std::ofstream(folder / "step") << number;
    std::this_thread::sleep_for(kStep);
  }
  EXPECT_EQ(steps_after_death, kStepsAfterDeath) << "the client did not come to its end:\n"
                                                 << content(folder / "client.log");
  EXPECT_GT(connected_steps, 0);
  EXPECT_GT(longest, kPauseSeen) << "the pause held the run";
  EXPECT_EQ(adaptor.channels(0, 1000000, 1.0), 0U) << "the dead client was noticed";
  if (world().rank != 0) return;
  const std::string log = content(folder / "client.log");
  EXPECT_THAT(log, testing::HasSubstr("elements " + std::to_string(run.total(BRECCIA_ELEMENTS, 1)) + " cells"));
  EXPECT_THAT(log, testing::HasSubstr("domains " + std::to_string(world().size) + " cells"));
  EXPECT_THAT(log, testing::HasSubstr("fractures changed"));
  EXPECT_THAT(log, testing::HasSubstr("stood still"));
  EXPECT_THAT(log, testing::HasSubstr("went on"));
  EXPECT_THAT(log, testing::HasSubstr("picture shows something"));
}

}  // namespace
}  // namespace breccia::test
