#include "parallel/halo.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "base/error.hpp"
#include "mpi/allocations.hpp"
#include "mpi/world.hpp"
#include "parallel/mpi_handle.hpp"

namespace breccia::halo_test {
namespace {

using test::world;
using testing::HasSubstr;

constexpr std::size_t kFields = 2;
constexpr double kUntouched = -1;

std::size_t place_of(std::size_t node) { return node / kHaloStride * 3 * kHaloStride + node % kHaloStride; }

double value_of(std::size_t id, std::size_t component, std::size_t field, int round) {
  return static_cast<double>(id * 100 + component * 10 + field) + 1e-3 * round;
}

/// Nodes that belong to ranks at random, and are proxies at random on others; the same on all ranks.
class Partition {
 public:
  Partition(std::size_t nodes, unsigned seed) {
    std::mt19937 random(seed);
    const auto ranks = static_cast<unsigned>(world().size());
    for (std::size_t id = 0; id < nodes; ++id) {
      owner_.push_back(static_cast<int>(random() % ranks));
      held_.emplace_back();
      for (unsigned r = 0; r < ranks; ++r) {
        held_.back().push_back(static_cast<int>(r) == owner_.back() || random() % 3 == 0);
      }
    }
  }

  /// @return ids of the nodes that a rank has, by place
  [[nodiscard]] std::vector<std::size_t> nodes_of(int rank) const {
    std::vector<std::size_t> ids;
    for (std::size_t id = 0; id < owner_.size(); ++id) {
      if (held_[id][static_cast<std::size_t>(rank)]) ids.push_back(id);
    }
    return ids;
  }
  [[nodiscard]] bool owns(int rank, std::size_t id) const { return owner_[id] == rank; }

  [[nodiscard]] std::vector<HaloNeighbour> neighbours() const {
    std::vector<HaloNeighbour> all;
    const std::vector<std::size_t> mine = nodes_of(world().rank());
    for (int other = world().size() - 1; other >= 0; --other) {
      if (other == world().rank()) continue;
      HaloNeighbour n{other, {}, {}};
      for (std::size_t node = 0; node < mine.size(); ++node) {
        const std::size_t id = mine[node];
        if (owns(world().rank(), id) && held_[id][static_cast<std::size_t>(other)]) n.send.push_back(place_of(node));
        if (owns(other, id)) n.receive.push_back(place_of(node));
      }
      if (!n.send.empty() || !n.receive.empty()) all.push_back(std::move(n));
    }
    return all;
  }

 private:
  std::vector<int> owner_;
  std::vector<std::vector<bool>> held_;  ///< by node and rank
};

/// Nodal fields of this rank: originals have their values, everything else a mark.
class Fields {
 public:
  explicit Fields(const Partition& partition) : partition_(partition), ids_(partition.nodes_of(world().rank())) {
    for (std::vector<double>& values : values_) values.assign(place_of(ids_.size() + 2 * kHaloStride), kUntouched);
  }
  void set(int round, bool originals_only) { fill(values_, round, originals_only); }
  [[nodiscard]] std::vector<double*> pointers() {
    std::vector<double*> pointers;
    for (std::vector<double>& values : values_) pointers.push_back(values.data());
    return pointers;
  }
  /// Whether every node has the value of its original, and nothing else was written.
  [[nodiscard]] bool complete(int round) const {
    auto expected = values_;
    for (std::vector<double>& values : expected) values.assign(values.size(), kUntouched);
    fill(expected, round, false);
    return values_ == expected;
  }

 private:
  void fill(std::vector<std::vector<double>>& values, int round, bool originals_only) const {
    for (std::size_t f = 0; f < kFields; ++f) {
      for (std::size_t node = 0; node < ids_.size(); ++node) {
        if (originals_only && !partition_.owns(world().rank(), ids_[node])) continue;
        for (std::size_t i = 0; i < 3; ++i) {
          values[f][place_of(node) + i * kHaloStride] = value_of(ids_[node], i, f, round);
        }
      }
    }
  }

  const Partition& partition_;
  std::vector<std::size_t> ids_;
  std::vector<std::vector<double>> values_{kFields};
};

class HaloOf : public testing::TestWithParam<ExchangeKind> {};

TEST_P(HaloOf, AnyPartitionGivesEveryProxyTheValuesOfItsOriginalStepAfterStep) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Partition partition(seed < 10 ? 4 : 500, seed);  // few nodes: some ranks have none to give or take
    Halo halo(world(), partition.neighbours(), kFields, GetParam());
    Fields fields(partition);
    const std::vector<double*> pointers = fields.pointers();
    for (int round = 0; round < 5; ++round) {
      fields.set(round, true);
      halo.gather_begin(pointers);
      halo.gather_end();
      EXPECT_TRUE(fields.complete(round)) << "seed " << seed << ", round " << round;
    }
  }
}

TEST_P(HaloOf, TheFirstFieldAloneLeavesTheOthersAsTheyWere) {
  // Rank r owns the nodes 2 r, of which all fields go everywhere, and 2 r + 1, of which only the first does.
  const auto ranks = static_cast<std::size_t>(world().size()), mine = static_cast<std::size_t>(world().rank());
  std::vector<HaloNeighbour> neighbours;
  for (std::size_t other = 0; other < ranks; ++other) {
    if (other == mine) continue;
    neighbours.push_back({static_cast<int>(other),
                          {place_of(2 * mine)},
                          {place_of(2 * other)},
                          {place_of(2 * mine + 1)},
                          {place_of(2 * other + 1)}});
  }
  Halo halo(world(), neighbours, 2, GetParam());
  const auto value = [](std::size_t field, std::size_t node, std::size_t i) {
    return static_cast<double>(100 * field + 10 * node + i);
  };
  std::vector<std::vector<double>> fields(
      2, std::vector<double>(place_of(2 * ranks + kHaloStride) + 3 * kHaloStride, kUntouched));
  const auto fill = [&](std::vector<double>& values, std::size_t field, std::size_t node) {
    for (std::size_t i = 0; i < 3; ++i) values[place_of(node) + i * kHaloStride] = value(field, node, i);
  };
  for (std::size_t field = 0; field < 2; ++field) {
    fill(fields[field], field, 2 * mine);
    fill(fields[field], field, 2 * mine + 1);
  }
  auto expected = fields;
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    fill(expected[0], 0, 2 * rank);
    fill(expected[0], 0, 2 * rank + 1);
    fill(expected[1], 1, 2 * rank);
  }
  halo.gather_begin(std::array{fields[0].data(), fields[1].data()});
  halo.gather_end();
  EXPECT_EQ(fields, expected);
}

TEST_P(HaloOf, ValuesAtTheBeginSendsThoseAndNotLaterOnes) {
  const Partition partition(300, 5);
  Halo halo(world(), partition.neighbours(), kFields, GetParam());
  Fields fields(partition);
  const std::vector<double*> pointers = fields.pointers();
  fields.set(1, true);
  halo.gather_begin(pointers);
  fields.set(2, true);
  halo.gather_end();
  fields.set(1, true);
  EXPECT_TRUE(fields.complete(1));
}

TEST_P(HaloOf, ManyNodesSendsOneMessageANeighbourAndCountsIt) {
  const Partition partition(500, 11);
  const std::vector<HaloNeighbour> neighbours = partition.neighbours();
  std::size_t sent = 0, messages = 0;
  for (const HaloNeighbour& n : neighbours) {
    sent += n.send.size();
    messages += n.send.empty() ? 0 : 1;
  }
  Halo halo(world(), neighbours, kFields, GetParam());
  Fields fields(partition);
  constexpr std::size_t kGathers = 3;
  for (std::size_t i = 0; i < kGathers; ++i) {
    halo.gather_begin(fields.pointers());
    halo.gather_end();
  }
  EXPECT_EQ(halo.messages(), static_cast<std::int64_t>(kGathers * messages));
  EXPECT_EQ(halo.bytes(), static_cast<std::int64_t>(kGathers * sent * kFields * 3 * sizeof(double)));
  EXPECT_EQ(halo.seconds_waiting() > 0, world().size() > 1);
}

TEST_P(HaloOf, NeighboursOnAllRanksHasInPairsOneMessageUnderwayAndElseAll) {
  // Every rank gives each of the others its own node.
  const auto ranks = static_cast<std::size_t>(world().size()), mine = static_cast<std::size_t>(world().rank());
  std::vector<HaloNeighbour> neighbours;
  for (std::size_t other = 0; other < ranks; ++other) {
    if (other != mine) neighbours.push_back({static_cast<int>(other), {place_of(mine)}, {place_of(other)}});
  }
  Halo halo(world(), neighbours, 1, GetParam());
  std::vector<double> field(place_of(ranks) + 3 * kHaloStride, static_cast<double>(mine));
  double* const pointer = field.data();
  const auto all = static_cast<std::int64_t>(ranks - 1);
  const std::int64_t at_once = GetParam() == ExchangeKind::pairwise ? std::min<std::int64_t>(all, 1) : all;
  for (std::int64_t gather = 0; gather < 3; ++gather) {
    halo.gather_begin(std::span(&pointer, 1));
    EXPECT_EQ(halo.messages(), gather * all + at_once);
    halo.gather_end();
    EXPECT_EQ(halo.messages(), (gather + 1) * all);
  }
  for (std::size_t rank = 0; rank < ranks; ++rank) EXPECT_EQ(field[place_of(rank)], static_cast<double>(rank));
}

/// Ranks 1, 2, ... give rank 0 a node; those after its first partner keep it waiting, whose turns have not come.
TEST(Halo, InPairsTurnsToTheNextNeighbourOnlyWhenTheOneBeforeHasAnswered) {
  if (world().size() < 3) GTEST_SKIP() << "needs two other ranks";
  constexpr double kPatience = 0.1;  // s
  const Communicator aside(std::make_shared<Communicator::Handle>(world().handle()->comm));
  const double usual = world().handle()->patience;
  std::vector<HaloNeighbour> neighbours;
  if (world().is_root()) {
    for (int r = 1; r < world().size(); ++r) neighbours.push_back({r, {0}, {place_of(static_cast<std::size_t>(r))}});
  } else {
    neighbours.push_back({0, {place_of(static_cast<std::size_t>(world().rank()))}, {0}});
  }
  Halo halo(world(), std::move(neighbours), 1, ExchangeKind::pairwise);
  std::vector<double> field(place_of(static_cast<std::size_t>(world().size())) + 3 * kHaloStride, world().rank());
  double* const pointer = field.data();
  if (world().is_root()) {
    world().set_patience(kPatience);
    halo.gather_begin(std::span(&pointer, 1));
    testing::internal::CaptureStderr();
    EXPECT_THROW(halo.gather_end(), NoResponse);
    (void)testing::internal::GetCapturedStderr();
    EXPECT_EQ(halo.messages(), 1);
    world().set_patience(usual);
    aside.barrier();  // now the others may give
  } else {
    aside.barrier();
    halo.gather_begin(std::span(&pointer, 1));
  }
  halo.gather_end();
  EXPECT_EQ(field[0], 0);
  if (world().is_root()) {
    EXPECT_EQ(halo.messages(), world().size() - 1);
    for (int r = 1; r < world().size(); ++r) EXPECT_EQ(field[place_of(static_cast<std::size_t>(r))], r);
  }
}

TEST(Halo, WaitsForWhatItGetsAndNotForWhatItGives) {
  if (world().size() == 1) GTEST_SKIP() << "needs another rank";
  const Communicator aside(std::make_shared<Communicator::Handle>(world().handle()->comm));
  constexpr std::size_t kNodes = 100'000;  // more than MPI takes without the receiver
  std::vector<std::size_t> all;
  for (std::size_t node = 0; node < kNodes; ++node) all.push_back(place_of(node));
  std::vector<HaloNeighbour> neighbours;
  if (world().is_root()) {
    for (int r = 1; r < world().size(); ++r) neighbours.push_back({r, all, {}});
  } else {
    neighbours.push_back({0, {}, all});
  }
  Halo halo(world(), std::move(neighbours), 1);
  std::vector<double> field(3 * kNodes, world().is_root() ? 3.5 : 0.0);
  double* const pointer = field.data();
  if (!world().is_root()) aside.barrier();  // until the root has got all it waits for: nothing
  halo.gather_begin(std::span(&pointer, 1));
  halo.gather_end();
  if (world().is_root()) aside.barrier();
  EXPECT_EQ(field, std::vector<double>(3 * kNodes, 3.5));
  halo.gather_begin(std::span(&pointer, 1));  // waits for what is on its way still
  halo.gather_end();
}

TEST_P(HaloOf, AnySizeAllocatesNothingInAGather) {
  const Partition partition(500, 12);
  Halo halo(world(), partition.neighbours(), kFields, GetParam());
  Fields fields(partition);
  const std::vector<double*> pointers = fields.pointers();
  const long before = test::allocations();
  for (int i = 0; i < 3; ++i) {
    halo.gather_begin(pointers);
    halo.gather_end();
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST_P(HaloOf, ARankThatIsLateNamesItAndCanBeWaitedForAgain) {
  if (world().size() == 1) GTEST_SKIP() << "needs another rank";
  constexpr double kPatience = 0.1;  // s
  const Communicator aside(std::make_shared<Communicator::Handle>(world().handle()->comm));
  const double usual = world().handle()->patience;
  // Rank 0 gives each of the others a node.
  std::vector<HaloNeighbour> neighbours;
  if (world().is_root()) {
    for (int r = 1; r < world().size(); ++r) neighbours.push_back({r, {0}, {}});
  } else {
    neighbours.push_back({0, {}, {0}});
  }
  Halo halo(world(), std::move(neighbours), 1, GetParam());
  std::vector<double> field(3 * kHaloStride, world().is_root() ? 3.5 : 0.0);
  double* const pointer = field.data();
  std::string error;
  if (world().is_root()) {
    aside.barrier();  // until the others have lost their patience
    halo.gather_begin(std::span(&pointer, 1));
  } else {
    world().set_patience(kPatience);
    halo.gather_begin(std::span(&pointer, 1));
    testing::internal::CaptureStderr();
    try {
      halo.gather_end();
    } catch (const InternalError& thrown) {
      error = thrown.what();
    }
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("for rank 0 in phase"));
    world().set_patience(usual);
    aside.barrier();
    EXPECT_THAT(error, HasSubstr("for rank 0 in phase"));
  }
  halo.gather_end();
  EXPECT_EQ(field[2 * kHaloStride], 3.5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, HaloOf, testing::Values(ExchangeKind::non_blocking, ExchangeKind::pairwise),
                         [](const auto& kind) {
                           return kind.param == ExchangeKind::pairwise ? "pairwise" : "non_blocking";
                         });

TEST(Halo, WithANeighbourIsRefusedToARankThatIsAlone) {
  EXPECT_THROW(Halo(Communicator(), {{1, {0}, {}}}, 1), InternalError);
}

}  // namespace
}  // namespace breccia::halo_test
