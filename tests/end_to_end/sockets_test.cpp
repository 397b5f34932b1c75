#include <gtest/gtest.h>

#include <filesystem>

#include "end_to_end/process_tree.hpp"
#include "end_to_end/program.hpp"

/// Runs with ParaView in the process: MPI, which ParaView needs, opens no port to other machines, nor do its daemons.
namespace breccia::test::sockets_test {
namespace {

namespace fs = std::filesystem;

struct Watched {
  const char* name;
  int ranks;
  std::string settings;
};

class Sockets : public testing::TestWithParam<Watched> {};

TEST_P(Sockets, OfARunWithPipelinesListenToNoNetwork) {
  forget_network_settings();
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  const fs::path run = scratch.path("run");
  const std::string arguments = "run " + file + " --progress none -o '" + run.string() +
                                "' --set 'stage[0].end=1000 s' --set 'output.history_interval=1 ms' " +
                                GetParam().settings;
  const pid_t process = GetParam().ranks == 1 ? start_process("exec '" BRECCIA_PROGRAM "' " + arguments)
                                              : start_ranks(GetParam().ranks, arguments);
  EXPECT_TRUE(wait_until([&] { return fs::exists(run / "history.csv") && fs::file_size(run / "history.csv") > 4000; }));
  std::size_t seen = 0;
  for (const pid_t one : tree_below(process)) {
    if (name_of(one) == "mpiexec" || name_of(one) == "orterun") continue;  // the user's, who starts it
    EXPECT_EQ(open_listeners(one), "") << name_of(one);
    ++seen;
  }
  EXPECT_GE(seen, static_cast<std::size_t>(GetParam().ranks));
  end_tree(process);
}

const std::string kScript =
    "--set 'insitu.pipeline=[{name=\"" BRECCIA_SCRIPTS "/count_cells.py\", every_steps=5}, {name=\"fractures\"}]'";
const std::string kLive = "--live localhost:1";  // where nobody listens

INSTANTIATE_TEST_SUITE_P(Runs, Sockets,
                         testing::Values(Watched{"script", 1, kScript}, Watched{"script_on_two_ranks", 2, kScript},
                                         Watched{"live", 1, kLive}, Watched{"live_on_two_ranks", 2, kLive}),
                         [](const auto& watched) { return std::string(watched.param.name); });

}  // namespace
}  // namespace breccia::test::sockets_test
