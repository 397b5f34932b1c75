// The cells of all ranks on the first one.

#include <gtest/gtest.h>

#include "catalyst/gathered_instant.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"

namespace breccia::test::gathered_test {
namespace {

constexpr std::int64_t kStep = 3;

TEST(Gathered, HasTheCellsOfAllRanksInTheirOrderOnTheFirstRankAndNoneElsewhere) {
  const int empty = world().size > 2 ? 1 : -1;
  SyntheticRun run(3, world().rank, world().size, empty);
  const insitu::Ranks ranks(world().communicator, 0);
  insitu::GatheredInstant gathered(ranks);
  const std::uint32_t all = (1U << BRECCIA_NUM_CHANNELS) - 1;
  const BrecciaInstant& instant = gathered.of(run.at(kStep, all));
  const BrecciaGrid& surface = *instant.channels[BRECCIA_SURFACE];
  if (world().rank != 0) {
    EXPECT_EQ(surface.num_cells, 0);
    EXPECT_EQ(surface.num_points, 0);
    EXPECT_GT(surface.num_arrays, 0);
    return;
  }
  for (const int channel : {BRECCIA_ELEMENTS, BRECCIA_SURFACE, BRECCIA_FRACTURES, BRECCIA_DOMAINS}) {
    const BrecciaGrid& grid = *instant.channels[channel];
    ASSERT_EQ(grid.num_cells, run.total(channel, kStep));
    for (std::int32_t i = 0; i < grid.num_arrays; ++i) {
      const BrecciaArray& array = grid.arrays[i];
      for (std::int64_t cell = 0; cell < grid.num_cells; ++cell) {
        for (int c = 0; c < array.components && array.type == BRECCIA_F64; ++c)
          ASSERT_EQ(static_cast<const double*>(array.values)[cell * array.components + c],
                    SyntheticRun::expected_f64(array.name, c, cell, kStep));
        if (array.type == BRECCIA_I64) {
          ASSERT_EQ(static_cast<const std::int64_t*>(array.values)[cell],
                    SyntheticRun::expected_integer(array.name, cell, kStep));
        }
        if (array.type == BRECCIA_I32) {
          ASSERT_EQ(static_cast<const std::int32_t*>(array.values)[cell],
                    SyntheticRun::expected_integer(array.name, cell, kStep));
        }
      }
    }
  }
  // Corners count on through the ranks.
  ASSERT_EQ(surface.num_points, 3 * surface.num_cells);
  for (std::int64_t corner = 0; corner < 3 * surface.num_cells; ++corner) ASSERT_EQ(surface.corners[corner], corner);
  EXPECT_EQ(instant.channels[BRECCIA_HISTORY]->num_cells, 1);
}

}  // namespace
}  // namespace breccia::test::gathered_test
