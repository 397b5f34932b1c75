#include "parallel/exchange_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/error.hpp"

namespace breccia::exchange_schedule_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Pairs = std::vector<RankPair>;

/// Domains of a grid of n x n x n that share a face, an edge or a corner.
Pairs grid(int n) {
  Pairs pairs;
  const auto id = [n](int x, int y, int z) { return (z * n + y) * n + x; };
  for (int i = 0; i < n * n * n; ++i) {
    const int x = i % n, y = i / n % n, z = i / (n * n);
    for (int k = std::max(z - 1, 0); k <= std::min(z + 1, n - 1); ++k) {
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n - 1); ++j) {
        for (int h = std::max(x - 1, 0); h <= std::min(x + 1, n - 1); ++h) {
          if (id(h, j, k) > i) pairs.push_back({i, id(h, j, k)});
        }
      }
    }
  }
  return pairs;
}

Pairs complete(int ranks) {
  Pairs pairs;
  for (int a = 0; a < ranks; ++a) {
    for (int b = a + 1; b < ranks; ++b) pairs.push_back({a, b});
  }
  return pairs;
}

std::size_t largest_degree(const Pairs& pairs) {
  std::map<int, std::size_t> degree;
  std::size_t largest = 0;
  for (const RankPair& pair : pairs) largest = std::max({largest, ++degree[pair.a], ++degree[pair.b]});
  return largest;
}

void expect_every_pair_once(const Pairs& pairs, const std::string& name) {
  const std::vector<Pairs> steps = exchange_schedule(pairs);
  Pairs met, expected = pairs;
  for (const Pairs& step : steps) {
    std::set<int> busy;
    for (const RankPair& pair : step) {
      EXPECT_TRUE(busy.insert(pair.a).second && busy.insert(pair.b).second) << name << ": a rank twice in a step";
    }
    met.insert(met.end(), step.begin(), step.end());
  }
  std::sort(met.begin(), met.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(met, expected) << name;
  EXPECT_LE(steps.size(), largest_degree(pairs) + 1) << name;
}

TEST(ExchangeSchedule, LetsTheDomainsOfAGridMeetOnceInAtMostOneStepMoreThanTheyHaveNeighbours) {
  for (int n = 2; n <= 8; ++n) expect_every_pair_once(grid(n), "grid of side " + std::to_string(n));
}

TEST(ExchangeSchedule, DoesSoOnCompleteAndOnRandomGraphs) {
  for (int ranks = 2; ranks <= 17; ++ranks) {
    expect_every_pair_once(complete(ranks), "complete, " + std::to_string(ranks));
  }
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const int ranks = 3 + static_cast<int>(random() % 30);
    const auto kept = random() % 100;
    Pairs pairs = complete(ranks);
    std::erase_if(pairs, [&](const RankPair&) { return random() % 100 >= kept; });
    expect_every_pair_once(pairs, "random graph " + std::to_string(trial));
  }
}

TEST(ExchangeSchedule, DependsOnTheSetOfPairsOnly) {
  Pairs shuffled = grid(3);
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
  shuffled.push_back(shuffled.front());
  EXPECT_EQ(exchange_schedule(shuffled), exchange_schedule(grid(3)));
}

TEST(ExchangeSchedule, NeedsOneStepForPairsApartAndTwoForAChain) {
  EXPECT_THAT(exchange_schedule({{2, 3}, {0, 1}}), ElementsAre(ElementsAre(RankPair{0, 1}, RankPair{2, 3})));
  EXPECT_EQ(exchange_schedule({{0, 1}, {1, 2}}).size(), 2u);
  EXPECT_THAT(exchange_schedule({}), IsEmpty());
}

TEST(ExchangeSchedule, RefusesAPairOfOneRankWithItselfOrInTheWrongOrder) {
  EXPECT_THROW((void)exchange_schedule({{1, 1}}), InternalError);
  EXPECT_THROW((void)exchange_schedule({{2, 1}}), InternalError);
}

}  // namespace
}  // namespace breccia::exchange_schedule_test
