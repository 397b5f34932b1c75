// Pictures of our own are drawn on the first rank alone, which gathers what it draws.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::first_rank_test {
namespace {

/// Whether this process has started Python, without which no script draws.
bool has_started_python() {
  using IsInitialized = int();
  auto* const function = reinterpret_cast<IsInitialized*>(dlsym(RTLD_DEFAULT, "Py_IsInitialized"));
  return function != nullptr && function() != 0;
}

TEST(FirstRank, DrawsAloneAndTheOthersStartNoPython) {
  const std::filesystem::path folder = fresh_folder("first_rank");
  SyntheticRun run(3, world().rank, world().size, world().size > 1 ? world().size / 2 : -1);
  Config config(folder, world().communicator, world().rank, world().size);
  config.add("stress").add("surface");
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    for (const std::int64_t step : {1, 2}) {
      std::uint32_t channels = 0;
      for (int i = 0; i < 2; ++i) channels |= adaptor.channels(i, step, SyntheticRun::time_of(step));
      EXPECT_EQ(adaptor.execute(3, run.at(step, channels)), 0) << adaptor.text;
      run.take_away();
      run.give_back();
    }
    EXPECT_EQ(has_started_python(), world().rank == 0);
    EXPECT_EQ(adaptor.bytes(0) > 0, world().rank == 0);
  }
  barrier();
  EXPECT_TRUE(std::filesystem::exists(folder / "surface/surface_000000002.pvtp"));
}

}  // namespace
}  // namespace breccia::test::first_rank_test
