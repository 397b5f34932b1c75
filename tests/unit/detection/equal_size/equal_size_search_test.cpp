#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "detection/equal_size/bbts.hpp"
#include "detection/equal_size/cell_sweep.hpp"
#include "detection/equal_size/direct_search.hpp"
#include "detection/equal_size/mr.hpp"
#include "detection/equal_size/mr_s.hpp"
#include "detection/equal_size/nbs.hpp"

// One suite for all searches of bodies of similar size: each must visit the pairs that brute force finds, each once.
namespace breccia::detection::equal_size_search_test {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

template <int D, class Coordinate>
using Cells = std::vector<Cell<D, Coordinate>>;

/// Apart from the algorithms' own oracle, so that this does not share a mistake with it.
template <int D, class Coordinate>
Pairs brute_force(const Cells<D, Coordinate>& cells) {
  Pairs pairs;
  for (std::size_t a = 0; a < cells.size(); ++a) {
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      bool touch = true;
      for (std::size_t axis = 0; axis < D; ++axis) {
        touch =
            touch && std::llabs(static_cast<long long>(cells[a][axis]) - static_cast<long long>(cells[b][axis])) <= 1;
      }
      if (touch) pairs.emplace_back(static_cast<Index>(a), static_cast<Index>(b));
    }
  }
  return pairs;
}

template <template <int, class> class Search, int Dimension, class C>
struct Case {
  using Algorithm = Search<Dimension, C>;
  using Coordinate = C;
  static constexpr int kD = Dimension;
};

template <class T>
class EqualSizeSearchTest : public ::testing::Test {
 protected:
  static constexpr int kD = T::kD;
  using Coordinate = typename T::Coordinate;
  using Bodies = Cells<kD, Coordinate>;
  static constexpr Coordinate kLowest = std::numeric_limits<Coordinate>::min(),
                              kHighest = std::numeric_limits<Coordinate>::max();
  static_assert(EqualSizeSearch<typename T::Algorithm, kD, Coordinate>);

  void expect_brute_force(const Bodies& cells, const std::string& what) {
    Pairs visited;
    search_.detect(std::span<const Cell<kD, Coordinate>>(cells),
                   [&](Index a, Index b) { visited.emplace_back(std::min(a, b), std::max(a, b)); });
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, (brute_force<kD, Coordinate>(cells))) << what;
  }

  Bodies box(std::size_t count, long long lower, long long upper) {
    std::uniform_int_distribution<long long> coordinate(lower, upper);
    Bodies cells(count);
    for (auto& cell : cells) {
      for (auto& x : cell) x = static_cast<Coordinate>(coordinate(random_));
    }
    return cells;
  }
  /// As many cells a side as gives a body about three others to touch.
  static long long side(std::size_t count) {
    long long n = 1;
    const auto power = [](long long x) { return kD == 1 ? x : kD == 2 ? x * x : x * x * x; };
    while (power(n) < static_cast<long long>(2 * count)) ++n;
    return n;
  }
  Bodies raster() {
    Bodies cells{Cell<kD, Coordinate>{}};
    for (std::size_t axis = 0; axis < kD; ++axis) {
      Bodies longer;
      for (const auto& cell : cells) {
        for (int k = 0; k < (kD == 1 ? 150 : kD == 2 ? 12 : 6); ++k) {
          longer.push_back(cell);
          longer.back()[axis] = static_cast<Coordinate>(k);
        }
      }
      cells = std::move(longer);
    }
    return cells;
  }
  /// The movement of the published experiments: 0 or 1 cell along each axis.
  void move(Bodies& cells) {
    for (auto& cell : cells) {
      for (auto& x : cell) x = static_cast<Coordinate>(x + static_cast<Coordinate>(random_() % 2));
    }
  }

  std::mt19937 random_{7};
  typename T::Algorithm search_;
};

#define ALL_OF(search)                                                                         \
  Case<search, 1, std::int16_t>, Case<search, 2, std::int16_t>, Case<search, 3, std::int16_t>, \
      Case<search, 1, std::int32_t>, Case<search, 2, std::int32_t>, Case<search, 3, std::int32_t>
using Cases =
    ::testing::Types<ALL_OF(DirectSearch), ALL_OF(Nbs), ALL_OF(Mr), ALL_OF(MrS), ALL_OF(Bbts), ALL_OF(CellSweep)>;
#undef ALL_OF

struct Name {
  template <class T>
  static std::string GetName(int) {
    return std::string(T::Algorithm::name) + "_" + std::to_string(T::kD) + "D_int" +
           std::to_string(8 * sizeof(typename T::Coordinate));
  }
};
TYPED_TEST_SUITE(EqualSizeSearchTest, Cases, Name);

TYPED_TEST(EqualSizeSearchTest, FindsNothingAmongNoBodiesOrOne) {
  this->expect_brute_force({}, "none");
  this->expect_brute_force(this->box(1, -5, 5), "one");
  this->expect_brute_force({}, "none again");
}

TYPED_TEST(EqualSizeSearchTest, VisitsEachPairOfRandomBodiesOnce) {
  for (const std::size_t count : {2U, 3U, 10U, 100U, 500U})
    this->expect_brute_force(this->box(count, 0, this->side(count)), std::to_string(count));
}

TYPED_TEST(EqualSizeSearchTest, TakesNegativeCoordinates) {
  const long long n = this->side(200);
  this->expect_brute_force(this->box(200, -n, -1), "below 0");
  this->expect_brute_force(this->box(200, -n / 2, n / 2), "about 0");
}

TYPED_TEST(EqualSizeSearchTest, TakesAFullRasterInOrderAndInReverse) {
  auto cells = this->raster();
  this->expect_brute_force(cells, "in order");
  std::reverse(cells.begin(), cells.end());
  this->expect_brute_force(cells, "in reverse");
}

TYPED_TEST(EqualSizeSearchTest, TakesClustersFarApart) {
  auto cells = this->box(100, -30000, -29997), others = this->box(100, 29997, 30000);
  cells.insert(cells.end(), others.begin(), others.end());
  std::shuffle(cells.begin(), cells.end(), this->random_);
  this->expect_brute_force(cells, "two clusters");
}

TYPED_TEST(EqualSizeSearchTest, TakesAllBodiesInOneCellAndAllOnALine) {
  this->expect_brute_force(this->box(60, 3, 3), "one cell");
  for (std::size_t axis = 0; axis < TypeParam::kD; ++axis) {
    auto cells = this->box(100, 0, 120);
    for (auto& cell : cells) {
      for (std::size_t other = 0; other < TypeParam::kD; ++other) {
        if (other != axis) cell[other] = -4;
      }
    }
    this->expect_brute_force(cells, "line along axis " + std::to_string(axis));
  }
}

TYPED_TEST(EqualSizeSearchTest, KnowsNoNeighboursBeyondTheLimitsOfTheType) {
  auto cells = this->box(80, this->kLowest, this->kLowest + 2LL),
       others = this->box(80, this->kHighest - 2LL, this->kHighest);
  cells.insert(cells.end(), others.begin(), others.end());
  // Corners of the whole range: each axis at either limit.
  for (unsigned corner = 0; corner < 1U << TypeParam::kD; ++corner) {
    cells.emplace_back();
    for (std::size_t axis = 0; axis < TypeParam::kD; ++axis)
      cells.back()[axis] = (corner >> axis & 1U) != 0 ? this->kHighest : this->kLowest;
  }
  this->expect_brute_force(cells, "limits");
  this->expect_brute_force(this->box(150, this->kLowest, this->kHighest), "the whole range");
}

TYPED_TEST(EqualSizeSearchTest, StaysRightThroughAHundredMoves) {
  auto cells = this->box(150, -40, -40 + this->side(150));
  for (int cycle = 0; cycle < 100; ++cycle) {
    this->expect_brute_force(cells, "cycle " + std::to_string(cycle));
    this->move(cells);
  }
}

TYPED_TEST(EqualSizeSearchTest, FollowsBodiesThatComeGoAndAreThrownElsewhere) {
  for (const std::size_t count : {100U, 101U, 37U, 300U, 0U, 1U, 150U}) {
    this->expect_brute_force(this->box(count, -20, -20 + this->side(count)), std::to_string(count) + " bodies");
  }
  auto cells = this->box(150, 0, this->side(150));
  for (int cycle = 0; cycle < 5; ++cycle) {
    this->expect_brute_force(cells, "before the throw");
    std::shuffle(cells.begin(), cells.end(), this->random_);
    for (auto& cell : cells) cell[0] = static_cast<typename TypeParam::Coordinate>(-cell[0] + 1000);
    this->expect_brute_force(cells, "after the throw");
  }
}

/// Bytes a body in 3D with 16-bit coordinates and integer ids as printed; NBS by its arrays; for the rest no figure is
/// printed.
double published_bytes(const std::string& name, std::size_t count, long long side) {
  if (name == "direct_search") return 0;
  if (name == "bbts") return 40;
  if (name == "mr") return 26;
  if (name == "mr_s") return 14;
  // A link for each axis; heads of the layers, of the rows of two layers and of the columns of five rows, with a slot
  // to spare at either end.
  if (name == "nbs") return 4 * 3 + 4 * 8 * static_cast<double>(side + 3) / static_cast<double>(count);
  return std::numeric_limits<double>::infinity();
}

TYPED_TEST(EqualSizeSearchTest, NeedsNoMoreMemoryThanPublished) {
  constexpr std::size_t kCount = 10000;
  const long long side = this->side(kCount);
  const auto cells = this->box(kCount, 0, side);
  std::size_t pairs = 0;
  this->search_.detect(std::span<const Cell<TypeParam::kD, typename TypeParam::Coordinate>>(cells),
                       [&](Index, Index) { ++pairs; });
  EXPECT_GT(pairs, kCount / 2);
  if (TypeParam::kD < 3 || sizeof(typename TypeParam::Coordinate) > 2) return;  // nothing is printed for these
  constexpr double kListHead = 64;  // bytes that do not grow with the bodies
  EXPECT_LE(static_cast<double>(this->search_.bytes()),
            published_bytes(std::string(TypeParam::Algorithm::name), kCount, side) * kCount + kListHead);
}

}  // namespace
}  // namespace breccia::detection::equal_size_search_test
