#include "mesh/space_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace breccia::space_curve_test {
namespace {

struct Place {
  std::uint64_t rank;
  std::array<std::uint32_t, 3> cell;
};

/// A cube of 16^3 cells at a corner of the grid that is a cube of the curve's own division, in the curve's order.
std::vector<Place> cube_in_order(std::array<std::uint32_t, 3> corner) {
  std::vector<Place> places;
  for (std::uint32_t i = 0; i < 16; ++i) {
    for (std::uint32_t j = 0; j < 16; ++j) {
      for (std::uint32_t k = 0; k < 16; ++k) {
        const std::array<std::uint32_t, 3> cell{corner[0] + i, corner[1] + j, corner[2] + k};
        places.push_back({hilbert_rank(cell), cell});
      }
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.rank < b.rank; });
  return places;
}

TEST(HilbertCurve, RunsThroughEachCubeOfItsDivisionWithoutGapsFromFaceToFace) {
  constexpr std::uint32_t kTop = (1u << kHilbertBits) - 16;
  for (const auto& corner : {std::array<std::uint32_t, 3>{0, 0, 0},
                             {kTop, kTop, kTop},
                             {16, 32, 48},
                             {kTop, 0, 524288},
                             {1600, 160, 16000}}) {
    const auto places = cube_in_order(corner);
    EXPECT_EQ(places.front().rank % 4096, 0u);
    for (std::size_t n = 1; n < places.size(); ++n) {
      ASSERT_EQ(places[n].rank, places[n - 1].rank + 1);
      int steps = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        steps += std::abs(static_cast<int>(places[n].cell[a]) - static_cast<int>(places[n - 1].cell[a]));
      }
      ASSERT_EQ(steps, 1) << "consecutive cells share a face";
    }
  }
}

TEST(HilbertCurve, StartsAtTheOriginAndUsesSixtyBits) {
  EXPECT_EQ(hilbert_rank({0, 0, 0}), 0u);
  constexpr std::uint32_t kLast = (1u << kHilbertBits) - 1;
  std::uint64_t highest = 0;
  for (const std::uint32_t i : {0u, kLast}) {
    for (const std::uint32_t j : {0u, kLast}) {
      for (const std::uint32_t k : {0u, kLast}) highest = std::max(highest, hilbert_rank({i, j, k}));
    }
  }
  EXPECT_EQ(highest, (std::uint64_t{1} << (3 * kHilbertBits)) - 1);
}

}  // namespace
}  // namespace breccia::space_curve_test
