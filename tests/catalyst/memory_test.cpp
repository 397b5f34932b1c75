// A thousand executions of recordings and of a script need no more memory than the first hundred.

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::memory_test {
namespace {

constexpr int kWarmUp = 100;
constexpr int kExecutions = 1000;
constexpr double kGrowth = 0.01;  // asked for: flat to 1 %

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

TEST(Memory, IsFlatOverAThousandExecutions) {
  constexpr std::uint32_t kChannels = (1U << BRECCIA_FRACTURES) | (1U << BRECCIA_HISTORY) | (1U << BRECCIA_ELEMENTS);
  const auto folder = fresh_folder("memory");
  SyntheticRun run(3, world().rank, world().size);
  Config config(folder, world().communicator, world().rank, world().size);
  config.add("fractures").add("history").add(std::string(BRECCIA_SCRIPTS) + "/count_cells.py");
  Adaptor adaptor(config.get());
  ASSERT_TRUE(adaptor.is_open());
  double warm = 0.0;
  for (int i = 0; i < kWarmUp + kExecutions; ++i) {
    if (i == kWarmUp) warm = resident_mb();
    ASSERT_EQ(adaptor.execute(7, run.at(3 + i, kChannels)), 0U) << adaptor.text;
  }
  EXPECT_LT(resident_mb(), (1.0 + kGrowth) * warm);
  RecordProperty("resident_mb", std::to_string(resident_mb()));
  std::printf("resident: %.1f MB after %d executions, %.1f MB after %d\n", warm, kWarmUp, resident_mb(),
              kWarmUp + kExecutions);
}

}  // namespace
}  // namespace breccia::test::memory_test
