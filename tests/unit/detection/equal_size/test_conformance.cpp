#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "detection/equal_size/bbts.hpp"
#include "detection/equal_size/cell_sweep.hpp"
#include "detection/equal_size/direct_search.hpp"
#include "detection/equal_size/mr.hpp"
#include "detection/equal_size/mr_s.hpp"
#include "detection/equal_size/nbs.hpp"

// What cell.hpp promises of every search of bodies of similar size, in 1, 2 and 3 dimensions and both coordinate types.

namespace breccia::detection {
namespace {

using Pair = std::pair<Index, Index>;

/// Dimension and coordinate type of a search, from its template arguments.
template <class S>
struct Arguments;
template <template <int, std::signed_integral> class S, int D, class C>
struct Arguments<S<D, C>> {
  static constexpr int dimension = D;
  using Type = C;
};

template <class S>
class EqualSize : public testing::Test {
 protected:
  static constexpr int dimension = Arguments<S>::dimension;
  using Coordinate = typename Arguments<S>::Type;
  using Cells = std::vector<Cell<dimension, Coordinate>>;
  static_assert(EqualSizeSearch<S, dimension, Coordinate>);

  /// n bodies with coordinates drawn evenly from lowest..highest.
  Cells random_cells(std::size_t n, int lowest, int highest) {
    std::uniform_int_distribution<int> coordinate(lowest, highest);
    Cells cells(n);
    for (auto& cell : cells) {
      for (auto& c : cell) c = static_cast<Coordinate>(coordinate(random_));
    }
    return cells;
  }

  /// Side of a box that holds about n / 2 cells, so that most bodies have neighbours and many have none.
  static int side(std::size_t n) { return static_cast<int>(std::pow(4.0 * static_cast<double>(n), 1.0 / dimension)); }

  /// One body a cell, the last axis running fastest.
  static Cells raster(int n, int spacing) {
    Cells cells;
    int count = 1;
    for (int axis = 0; axis < dimension; ++axis) count *= n;
    for (int k = 0; k < count; ++k) {
      int rest = k;
      Cell<dimension, Coordinate> cell;
      for (auto c = cell.rbegin(); c != cell.rend(); ++c, rest /= n) *c = static_cast<Coordinate>(rest % n * spacing);
      cells.push_back(cell);
    }
    return cells;
  }

  /// Movement of the experiments: every coordinate stays or grows by one.
  void move(Cells& cells) {
    for (auto& cell : cells) {
      for (auto& c : cell) c = static_cast<Coordinate>(c + static_cast<Coordinate>(random_() % 2));
    }
  }

  static std::vector<Pair> touching_pairs(const Cells& cells) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < cells.size(); ++a) {
      for (std::size_t b = a + 1; b < cells.size(); ++b) {
        bool touch = true;
        for (std::size_t axis = 0; axis < cells[a].size(); ++axis) {
          touch = touch && std::abs(std::int64_t{cells[a][axis]} - std::int64_t{cells[b][axis]}) <= 1;
        }
        if (touch) pairs.emplace_back(a, b);
      }
    }
    return pairs;
  }

  /// Every pair visited, smaller number first, in order; one that was visited twice stands twice.
  std::vector<Pair> visited_pairs(const Cells& cells) {
    std::vector<Pair> pairs;
    search_.detect(cells, [&](Index a, Index b) { pairs.emplace_back(std::min(a, b), std::max(a, b)); });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  void expect_all_pairs_once(const Cells& cells, const char* what) {
    const std::vector<Pair> visited = visited_pairs(cells), expected = touching_pairs(cells);
    EXPECT_TRUE(visited == expected) << what << ": " << cells.size() << " bodies, " << visited.size()
                                     << " pairs visited, " << expected.size() << " touch";
  }

  std::mt19937 random_{11};
  S search_;
};

using Searches =
    testing::Types<DirectSearch<1, std::int16_t>, DirectSearch<2, std::int16_t>, DirectSearch<3, std::int16_t>,
                   DirectSearch<1, std::int32_t>, DirectSearch<2, std::int32_t>, DirectSearch<3, std::int32_t>,
                   Nbs<1, std::int16_t>, Nbs<2, std::int16_t>, Nbs<3, std::int16_t>, Nbs<1, std::int32_t>,
                   Nbs<2, std::int32_t>, Nbs<3, std::int32_t>, Mr<1, std::int16_t>, Mr<2, std::int16_t>,
                   Mr<3, std::int16_t>, Mr<1, std::int32_t>, Mr<2, std::int32_t>, Mr<3, std::int32_t>,
                   MrS<1, std::int16_t>, MrS<2, std::int16_t>, MrS<3, std::int16_t>, MrS<1, std::int32_t>,
                   MrS<2, std::int32_t>, MrS<3, std::int32_t>, Bbts<1, std::int16_t>, Bbts<2, std::int16_t>,
                   Bbts<3, std::int16_t>, Bbts<1, std::int32_t>, Bbts<2, std::int32_t>, Bbts<3, std::int32_t>,
                   CellSweep<1, std::int16_t>, CellSweep<2, std::int16_t>, CellSweep<3, std::int16_t>,
                   CellSweep<1, std::int32_t>, CellSweep<2, std::int32_t>, CellSweep<3, std::int32_t>>;
TYPED_TEST_SUITE(EqualSize, Searches);

TYPED_TEST(EqualSize, finds_nothing_among_none_and_one) {
  this->expect_all_pairs_once({}, "none");
  this->expect_all_pairs_once(this->random_cells(1, -5, 5), "one");
  this->expect_all_pairs_once({}, "none again");
}

TYPED_TEST(EqualSize, visits_each_touching_pair_of_random_bodies_once) {
  for (const std::size_t n : {2U, 3U, 10U, 100U, 500U}) {
    const int side = this->side(n);
    this->expect_all_pairs_once(this->random_cells(n, 0, side), "positive coordinates");
    this->expect_all_pairs_once(this->random_cells(n, -side / 2, side / 2), "around zero");
    this->expect_all_pairs_once(this->random_cells(n, -side - 200, -200), "negative coordinates");
  }
}

TYPED_TEST(EqualSize, visits_each_touching_pair_of_a_raster_once) {
  const int n = this->dimension == 1 ? 300 : this->dimension == 2 ? 17 : 7;
  for (const int spacing : {1, 2, 100}) this->expect_all_pairs_once(this->raster(n, spacing), "raster");
  auto cells = this->raster(n, 1);
  std::reverse(cells.begin(), cells.end());
  this->expect_all_pairs_once(cells, "raster from its end");
}

TYPED_TEST(EqualSize, visits_each_touching_pair_of_clusters_once) {
  auto cells = this->random_cells(150, 0, 2);
  for (const int corner : {-3000, 3000, 30000}) {
    const auto more = this->random_cells(100, corner, corner + 3);
    cells.insert(cells.end(), more.begin(), more.end());
  }
  this->expect_all_pairs_once(cells, "four clusters");
}

TYPED_TEST(EqualSize, visits_every_pair_of_one_cell_once) {
  this->expect_all_pairs_once(this->random_cells(60, 7, 7), "one cell");
}

TYPED_TEST(EqualSize, visits_each_touching_pair_on_a_line_once) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->dimension); ++axis) {
    auto cells = this->random_cells(200, 4, 4);
    for (auto& cell : cells) {
      cell[axis] = static_cast<typename TestFixture::Coordinate>(this->random_() % 100);
    }
    this->expect_all_pairs_once(cells, "line");
  }
}

TYPED_TEST(EqualSize, does_not_wrap_around_at_the_limits_of_the_type) {
  using Limits = std::numeric_limits<typename TestFixture::Coordinate>;
  const std::array<typename TestFixture::Coordinate, 8> choice{
      Limits::min(), Limits::min() + 1, Limits::min() + 2, -1, 0, 1, Limits::max() - 1, Limits::max()};
  auto cells = this->random_cells(400, 0, 0);
  for (auto& cell : cells) {
    for (auto& c : cell) c = choice[this->random_() % choice.size()];
  }
  this->expect_all_pairs_once(cells, "limits and zero");
}

TYPED_TEST(EqualSize, follows_a_hundred_moves) {
  auto cells = this->random_cells(200, -20, this->side(200) - 20);
  for (int cycle = 0; cycle < 100; ++cycle) {
    this->expect_all_pairs_once(cells, "moved");
    this->move(cells);
  }
}

TYPED_TEST(EqualSize, follows_a_change_of_the_number_of_bodies) {
  auto cells = this->random_cells(300, 0, this->side(300));
  for (const std::size_t n : {300U, 299U, 120U, 0U, 40U, 41U, 500U}) {
    const auto fresh = this->random_cells(n > cells.size() ? n - cells.size() : 0, 0, this->side(300));
    cells.resize(std::min(n, cells.size()));
    cells.insert(cells.end(), fresh.begin(), fresh.end());
    this->expect_all_pairs_once(cells, "changed number");
    this->move(cells);
  }
}

TYPED_TEST(EqualSize, follows_bodies_thrown_elsewhere_at_once) {
  for (int cycle = 0; cycle < 6; ++cycle) {
    const int corner = cycle % 2 == 0 ? -30000 : 20000;
    this->expect_all_pairs_once(this->random_cells(300, corner, corner + this->side(300)), "thrown");
    auto reversed = this->raster(this->dimension == 1 ? 300 : this->dimension == 2 ? 17 : 7, 1);
    if (cycle % 2 == 1) std::reverse(reversed.begin(), reversed.end());
    this->expect_all_pairs_once(reversed, "onto a raster");
  }
}

}  // namespace
}  // namespace breccia::detection
