#include "render/value_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace breccia::gui::test::value_range_test {
namespace {

using Range = std::array<double, 2>;

/// 1, 2, ... n.
std::vector<double> count_to(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(ValueRange, PassesOverHalfAPercentAtEachEnd) {
  std::vector<double> values = count_to(1000);
  for (std::size_t i = 0; i < 5; ++i) {
    values[i] = -1e9;
    values[values.size() - 1 - i] = 1e9;
  }
  EXPECT_EQ(value_range(values, 0), (Range{6, 995}));
  values[5] = -1e9;
  EXPECT_EQ(value_range(values, 0), (Range{-1e9, 995})) << "a sixth one counts";
}

TEST(ValueRange, OfFewValuesIsThatOfAllOfThem) {
  EXPECT_EQ(value_range(count_to(100), 0), (Range{1, 100}));
  EXPECT_EQ(value_range({-3, 2}, 0), (Range{-3, 2}));
  EXPECT_EQ(value_range(count_to(1000), 0, 0), (Range{1, 1000})) << "where none is an outlier";
}

TEST(ValueRange, OfRoundingIsNought) {
  EXPECT_EQ(value_range({1e-12, -3e-12, 2e-12}, 1e-11), (Range{0, 0}));
  EXPECT_EQ(value_range({}, 1), (Range{0, 0}));
  EXPECT_EQ(value_range({0, 0}, 0), (Range{0, 0}));
}

TEST(ValueRange, OfValuesThatAreAlikeBeginsOrEndsAtNought) {
  EXPECT_EQ(value_range({5, 5 + 1e-6}, 0), (Range{0, 5 + 1e-6}));
  EXPECT_EQ(value_range({-5, -5 - 1e-6}, 0), (Range{-5 - 1e-6, 0}));
}

TEST(ValueRange, HasTheFewThatDifferWhereAllOthersAreAlikeOrRounding) {
  std::vector<double> values(1000, 1e-13);
  values[0] = 8;
  EXPECT_EQ(value_range(values, 1e-9), (Range{1e-13, 8})) << "a projectile of few elements";
  values.assign(1000, 8);
  values[0] = 30;
  EXPECT_EQ(value_range(values, 1e-9), (Range{8, 30}));
}

TEST(ValueRange, DoesNotCountWhatIsNoNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(value_range({kNan, 1, kInfinite, 2, -kInfinite}, 0), (Range{1, 2}));
}

}  // namespace
}  // namespace breccia::gui::test::value_range_test
