// Time and memory of the pipelines in C++: the least of some executions, over all ranks the slowest; memory of the
// first rank.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test {
namespace {

constexpr int kRepeats = 5;
constexpr int kSides[] = {24, 41};  // 82,944 and 413,526 elements in all

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double ms_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void row(Adaptor& adaptor, int pipeline, const char* name, const BrecciaInstant& instant) {
  double least = 1e30;
  for (int i = 0; i < kRepeats; ++i) {
    barrier();
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(adaptor.execute(1U << pipeline, instant), 0U) << adaptor.text;
    barrier();
    least = std::min(least, ms_since(begin));
  }
  if (world().rank == 0)
    std::printf("  %-10s %9.2f ms  %10.0f bytes a rank and execution\n", name, least,
                static_cast<double>(adaptor.bytes(pipeline)) / kRepeats);
}

TEST(Bench, Pipelines) {
  constexpr const char* kPipelines[] = {"volume", "joints", "fractures", "contacts", "surface", "domains", "history"};
  const double before = resident_mb();
  const auto begin = std::chrono::steady_clock::now();
  plugin();
  if (world().rank == 0)
    std::printf("opening the plug-in: %.0f ms, %.0f MB -> %.0f MB\n", ms_since(begin), before, resident_mb());
  for (const int side : kSides) {
    SyntheticRun run(side, world().rank, world().size);
    const std::uint32_t all = (1U << BRECCIA_NUM_CHANNELS) - 1;
    const BrecciaInstant& instant = run.at(100000, all);
    const double loaded = resident_mb();
    Config config(fresh_folder("bench"), world().communicator, world().rank, world().size);
    for (const char* name : kPipelines) config.add(name);
    const bool last = side == kSides[1];
    if (last) config.add("live", 1U << BRECCIA_SURFACE).live(1);
    Adaptor adaptor(config.get());
    if (world().rank == 0)
      std::printf("%lld elements, %d ranks\n", static_cast<long long>(run.total(BRECCIA_ELEMENTS, 0)), world().size);
    for (int i = 0; i < BRECCIA_NUM_CHANNELS; ++i) row(adaptor, i, kPipelines[i], instant);
    if (world().rank == 0) std::printf("  memory besides the data: %+.0f MB\n", resident_mb() - loaded);
    if (!last) continue;
    constexpr int kCalls = 2000;
    const auto asked = std::chrono::steady_clock::now();
    for (int i = 0; i < kCalls; ++i) EXPECT_EQ(adaptor.channels(BRECCIA_NUM_CHANNELS, i, 0.0), 0U);
    if (world().rank == 0) std::printf("  live without a listener: %.4f ms a step\n", ms_since(asked) / kCalls);
  }
}

}  // namespace
}  // namespace breccia::test
