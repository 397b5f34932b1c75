// Scripts under the plug-in. ParaView starts once in a process, so all pipelines are those of one adaptor.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Scripts, SeeTheChannelsOfTheirRankAndTheirParametersAndReachTheSolver) {
  const auto folder = fresh_folder("scripts");
  SyntheticRun run(3, world().rank, world().size);
  Config config(folder, world().communicator, world().rank, world().size);
  config.add(std::string(BRECCIA_SCRIPTS) + "/count_cells.py", {"factor"}, {2.5});
  std::string expected;
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    for (std::int64_t step = 1; step <= 3; ++step) {
      const std::uint32_t channels = adaptor.channels(0, step, SyntheticRun::time_of(step));
      EXPECT_EQ(channels, 1U << BRECCIA_ELEMENTS);
      EXPECT_EQ(adaptor.execute(1, run.at(step, channels)), 0U) << adaptor.text;
      run.take_away();
      EXPECT_EQ(adaptor.requests.stop, step == 2 ? 1 : 0);
      EXPECT_EQ(adaptor.requests.frame_interval, step == 2 ? 2.5e-6 : 0.0);
      run.give_back();
      const auto share = run.share(BRECCIA_ELEMENTS, step);
      expected += std::to_string(step) + " " + std::to_string(share.end - share.first) + " 2.5\n";
    }
    run.take_away();
  }
  EXPECT_EQ(content(folder / "count_cells" / ("rank_" + std::to_string(world().rank) + ".txt")), expected);
}

}  // namespace
}  // namespace breccia::test
