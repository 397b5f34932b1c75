// Channels of a synthetic run as meshes of the Conduit Mesh Blueprint, on all ranks, one of which owns nothing.

#include <gtest/gtest.h>
#include <mpi.h>

#include <bit>
#include <cmath>

#include "catalyst/plugin.hpp"
#include "catalyst/synthetic.hpp"
#include "catalyst/world.hpp"
#include "catalyst2/blueprint_check.hpp"
#include "catalyst2/opened_standin.hpp"

namespace breccia::test::channels_test {
namespace {

constexpr const char* kNames[] = BRECCIA_CHANNEL_NAMES;
constexpr const char* kPipelines[] = {"volume", "joints", "fractures", "contacts", "surface", "domains", "history"};
constexpr const char* kShapes[] = {"tet", "tri", "tri", "point", "tri", "hex", "point"};
constexpr std::int64_t kSteps[] = {0, 10, 20};

int without_cells() { return world().size > 1 ? world().size - 1 : -1; }

std::int64_t sum(std::int64_t value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

/// Values that differ from those of the run; a cell is known by its id.
std::int64_t wrong_values(const StandinTree& tree, const std::string& data, std::int64_t step) {
  const StandinLeaf* const ids = leaf_of(tree, data + "/fields/id/values");
  // A box has the number of its rank instead; the history has one row.
  const std::int64_t without_ids = data.find("/domains/") != std::string::npos ? world().rank : 0;
  std::int64_t wrong = 0;
  for (const std::string& field : names_below(tree, data + "/fields")) {
    const auto components = leaves_below(tree, data + "/fields/" + field + "/values");
    for (std::size_t c = 0; c < components.size(); ++c) {
      for (std::int64_t i = 0; i < components[c]->count; ++i) {
        const auto id = ids == nullptr ? without_ids : static_cast<std::int64_t>(bits_of(*ids, i));
        const std::uint64_t expected =
            components[c]->kind == StandinLeaf::view_f64
                ? std::bit_cast<std::uint64_t>(SyntheticRun::expected_f64(field, static_cast<int>(c), id, step))
                : static_cast<std::uint64_t>(SyntheticRun::expected_integer(field, id, step));
        wrong += bits_of(*components[c], i) == expected ? 0 : 1;
      }
    }
  }
  return wrong;
}

/// That all ranks together have each id from 0 once, by their number, their sum and that of their squares.
void expect_each_id_once(const StandinLeaf& ids, std::int64_t total) {
  std::int64_t first = 0, second = 0, all = 0, squares = 0;
  for (std::int64_t i = 0; i < ids.count; ++i) {
    const auto id = static_cast<std::int64_t>(bits_of(ids, i));
    first += id;
    second += id * id;
  }
  for (std::int64_t id = 0; id < total; ++id) {
    all += id;
    squares += id * id;
  }
  EXPECT_EQ(sum(ids.count), total);
  EXPECT_EQ(sum(first), all);
  EXPECT_EQ(sum(second), squares);
}

void expect_mesh_of(const StandinTree& tree, int channel, const BrecciaGrid& grid) {
  const std::string data = std::string("catalyst/channels/") + kNames[channel] + "/data";
  EXPECT_EQ(leaf_of(tree, data + "/state/domain_id")->number, world().rank);
  EXPECT_EQ(leaf_of(tree, data + "/topologies/mesh/elements/shape")->words, kShapes[channel]);
  if (channel != BRECCIA_HISTORY)
    expect_view_of(tree, data + "/coordsets/coords", {"", BRECCIA_F64, 3, grid.points}, grid.num_points);
  const StandinLeaf& corners = *leaf_of(tree, data + "/topologies/mesh/elements/connectivity");
  if (grid.corners != nullptr && grid.num_cells > 0) {
    EXPECT_EQ(corners.data, grid.corners);
  }
  for (std::int64_t i = 0; grid.corners == nullptr && i < corners.count; ++i)
    EXPECT_EQ(static_cast<std::int64_t>(bits_of(corners, i)), i);
  std::vector<std::string> names;
  for (std::int32_t i = 0; i < grid.num_arrays; ++i) {
    names.emplace_back(grid.arrays[i].name);
    expect_view_of(tree, data + "/fields/" + names.back(), grid.arrays[i], grid.num_cells);
  }
  EXPECT_EQ(names_below(tree, data + "/fields"), names);
}

TEST(Catalyst2Channels, AreViewsOfTheSolversMemoryThatHoldEachCellOnceOverAllRanks) {
  const auto folder = fresh_folder("channels");
  SyntheticRun run(4, world().rank, world().size, without_cells());
  Standin& standin = fresh_standin();
  Config config(folder, world().communicator, world().rank, world().size);
  for (const char* pipeline : kPipelines) config.add(pipeline);
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    EXPECT_EQ(leaf_of(standin.initialized, "catalyst/mpi_comm")->kind, StandinLeaf::integer);
    EXPECT_EQ(leaf_of(standin.initialized, "catalyst_load/implementation")->words, "standin");
    for (const std::int64_t step : kSteps) {
      for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
        SCOPED_TRACE(std::string(kNames[channel]) + " at step " + std::to_string(step));
        const std::uint32_t mask = adaptor.channels(channel, step, SyntheticRun::time_of(step));
        ASSERT_EQ(mask, 1U << channel);
        const BrecciaInstant& instant = run.at(step, mask);
        ASSERT_EQ(adaptor.execute(mask, instant), 0) << adaptor.text;
        const StandinTree& tree = standin.executed.back();
        EXPECT_EQ(leaf_of(tree, "catalyst/state/timestep")->number, step);
        EXPECT_EQ(leaf_of(tree, "catalyst/state/cycle")->number, step);
        EXPECT_EQ(leaf_of(tree, "catalyst/state/time")->value, SyntheticRun::time_of(step));
        EXPECT_EQ(names_below(tree, "catalyst/channels"), std::vector<std::string>{kNames[channel]});
        expect_mesh_of(tree, channel, *instant.channels[channel]);
        const std::string data = std::string("catalyst/channels/") + kNames[channel] + "/data";
        EXPECT_EQ(wrong_values(tree, data, step), 0);
        if (const StandinLeaf* ids = leaf_of(tree, data + "/fields/id/values"); ids != nullptr)
          expect_each_id_once(*ids, run.total(channel, step));
        run.take_away();  // from here on the adaptor must live without
        run.give_back();
      }
    }
    EXPECT_EQ(standin.live_nodes, 1) << "the last tree alone";
    EXPECT_EQ(standin.problems, std::vector<std::string>{});
    run.take_away();
  }
  EXPECT_EQ(standin.finalized, 1);
  EXPECT_EQ(standin.live_nodes, 0);
}

TEST(Catalyst2Channels, OfABoxAndSomeFieldsHaveItsCellsAndThoseFields) {
  const auto folder = fresh_folder("selected");
  SyntheticRun run(4, world().rank, world().size, without_cells());
  Standin& standin = fresh_standin();
  Config config(folder, world().communicator, world().rank, world().size);
  config.add("surface").region({-1, -1, -1, 9, 9, 0.5}).fields({"id", "stress"}).add("volume");
  {
    Adaptor adaptor(config.get());
    ASSERT_TRUE(adaptor.is_open());
    const std::string surface = "catalyst/channels/surface/data", volume = "catalyst/channels/elements/data";
    const std::uint32_t both = 1U << BRECCIA_SURFACE | 1U << BRECCIA_ELEMENTS;
    ASSERT_EQ(adaptor.execute(1, run.at(10, both)), 0) << adaptor.text;
    EXPECT_EQ(names_below(standin.executed.back(), surface + "/fields"), (std::vector<std::string>{"id", "stress"}));
    EXPECT_EQ(wrong_values(standin.executed.back(), surface, 10), 0);
    EXPECT_EQ(sum(leaf_of(standin.executed.back(), surface + "/fields/id/values")->count), 16) << "the lowest cubes";
    ASSERT_EQ(adaptor.execute(2, run.at(10, both)), 0) << adaptor.text;
    EXPECT_GT(names_below(standin.executed.back(), volume + "/fields").size(), 2U);
    EXPECT_EQ(sum(leaf_of(standin.executed.back(), volume + "/fields/id/values")->count),
              run.total(BRECCIA_ELEMENTS, 10));
    EXPECT_EQ(standin.problems, std::vector<std::string>{});
  }
}

TEST(Catalyst2Channels, FailureOnAnyRankIsOnAllOfThem) {
  SyntheticRun run(2, world().rank, world().size);
  Standin& standin = fresh_standin();
  Config config(fresh_folder("failure"), world().communicator, world().rank, world().size);
  Adaptor adaptor(config.add("surface").get());
  ASSERT_TRUE(adaptor.is_open());
  standin.execute_status = world().rank == world().size - 1 ? 7 : 0;
  EXPECT_EQ(adaptor.execute(1, run.at(0, 1U << BRECCIA_SURFACE)), 1);
  EXPECT_EQ(adaptor.text, "surface: catalyst_execute returns 7");
  standin.execute_status = 0;
  standin.execute_throws = world().rank == 0;
  EXPECT_EQ(adaptor.execute(1, run.at(1, 1U << BRECCIA_SURFACE)), 1);
  EXPECT_EQ(adaptor.text, "surface: thrown on purpose");
  standin.execute_throws = false;
  BrecciaInstant wrong = run.at(2, 1U << BRECCIA_SURFACE);
  BrecciaGrid grid = *wrong.channels[BRECCIA_SURFACE];
  if (world().rank == 0) ++grid.num_points;
  wrong.channels[BRECCIA_SURFACE] = &grid;
  const std::size_t executions = standin.executed.size();
  EXPECT_EQ(adaptor.execute(1, wrong), 1);
  EXPECT_NE(adaptor.text.find("surface: channel surface has "), std::string::npos) << adaptor.text;
  EXPECT_EQ(standin.executed.size(), executions) << "a rank alone in an implementation waits for the others for ever";
  EXPECT_EQ(adaptor.execute(1, run.at(3, 1U << BRECCIA_SURFACE)), 0) << adaptor.text;
}

/// What opening says, on all ranks alike; "" where it succeeds.
std::string refusal(Config& config) {
  Text text;
  void* const adaptor = plugin().open(&config.get(), text.text, sizeof text.text);
  if (adaptor != nullptr) plugin().close(adaptor, nullptr, 0);
  return adaptor != nullptr ? "" : text.string();
}

TEST(Catalyst2Channels, AnImplementationThatDoesNotStartIsTold) {
  Standin& standin = fresh_standin();
  Config config(fresh_folder("start"), world().communicator, world().rank, world().size);
  config.add("surface");
  standin.initialize_status = world().rank == world().size - 1 ? 3 : 0;
  EXPECT_EQ(refusal(config),
            "implementation 'standin' of Catalyst 2 does not start: catalyst_initialize returns 3 (the implementation "
            "is not found)");
  standin.initialize_status = 0;
  standin.about = "stub";
  EXPECT_NE(refusal(config).find("'standin' of Catalyst 2 was requested and 'stub' started"), std::string::npos);
  standin.about = "standin";
  EXPECT_EQ(refusal(config), "");
  EXPECT_EQ(standin.live_nodes, 0);
}

}  // namespace
}  // namespace breccia::test::channels_test
