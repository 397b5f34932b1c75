#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

#include "detection/point_body/curve_order.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::curve_order_test {
namespace {

using scenes::Random;

TEST(HilbertCurve, VisitsEveryCellOnceAndGoesThroughAFaceAtEveryStep) {
  for (const int pairs : {1, 2}) {
    const std::uint32_t edge = 1U << 2 * pairs;
    std::vector<std::array<int, 3>> cell_at(edge * edge * edge, {-1, -1, -1});
    for (std::uint32_t x = 0; x < edge; ++x) {
      for (std::uint32_t y = 0; y < edge; ++y) {
        for (std::uint32_t z = 0; z < edge; ++z) {
          const std::uint32_t place = HilbertCurve::place(x, y, z, pairs);
          ASSERT_LT(place, cell_at.size());
          ASSERT_EQ(cell_at[place][0], -1) << "two cells share place " << place;
          cell_at[place] = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
        }
      }
    }
    for (std::size_t k = 1; k < cell_at.size(); ++k) {
      int steps = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) steps += std::abs(cell_at[k][axis] - cell_at[k - 1][axis]);
      ASSERT_EQ(steps, 1) << "at place " << k;
    }
  }
}

TEST(HilbertCurve, KeepsThePlaceOfACoarserCellInTheUpperDigits) {
  Random random(3);
  std::uniform_int_distribution<std::uint32_t> coordinate(0, 1023);
  for (int k = 0; k < 1000; ++k) {
    const std::uint32_t x = coordinate(random), y = coordinate(random), z = coordinate(random);
    const std::uint32_t fine = HilbertCurve::place(x, y, z, 5);
    EXPECT_EQ(fine >> 6, HilbertCurve::place(x >> 2, y >> 2, z >> 2, 4));
  }
}

/// Mean extent of eight that follow one another, the largest of the three axes.
double mean_extent(const std::vector<Vec3>& points, std::span<const CurveOrder::Record> order) {
  double sum = 0;
  for (std::size_t i = 0; i + 8 <= order.size(); i += 8) {
    Vec3 low = points[order[i].number], high = low;
    for (std::size_t k = 1; k < 8; ++k) {
      low = low.cwiseMin(points[order[i + k].number]);
      high = high.cwiseMax(points[order[i + k].number]);
    }
    sum += (high - low).maxCoeff();
  }
  return sum / static_cast<double>(order.size() / 8);
}

class CurveOrderOf : public testing::Test {
 protected:
  std::span<const CurveOrder::Record> sort(const std::vector<Vec3>& points) {
    return order_.sort(points.size(), frame_of(points), [&](std::size_t i) { return points[i]; });
  }
  CurveOrder order_;
};

TEST_F(CurveOrderOf, PointsHoldsEveryFiniteOneOnce) {
  Random random(4);
  std::vector<Vec3> points;
  for (int k = 0; k < 5000; ++k) points.push_back(scenes::uniform_vector(random, -1, 1));
  points[17][1] = std::numeric_limits<double>::quiet_NaN();
  points[4000][2] = -std::numeric_limits<double>::infinity();
  points[60] = points[61] = points[62];
  std::set<std::uint32_t> numbers;
  for (const auto& record : sort(points)) numbers.insert(record.number);
  EXPECT_EQ(numbers.size(), points.size() - 2);
  EXPECT_EQ(numbers.count(17) + numbers.count(4000), 0u);
}

TEST_F(CurveOrderOf, EvenlySpreadPointsPutsEightNeighboursIntoABoxOfAboutTwiceTheirShare) {
  // 32,768 points in a unit cube: a cube of edge 1/16 holds eight of them in the mean.
  Random random(5);
  std::vector<Vec3> points;
  for (int k = 0; k < 32768; ++k) points.push_back(scenes::uniform_vector(random, 0, 1));
  EXPECT_LT(mean_extent(points, sort(points)), 2.0 / 16);
}

TEST_F(CurveOrderOf, ADenseCrowdIsAsGoodWhateverLiesAroundIt) {
  Random random(6);
  std::vector<Vec3> crowd;
  for (int k = 0; k < 4096; ++k) crowd.push_back(1e-4 * scenes::uniform_vector(random, 0, 1));
  const double alone = mean_extent(crowd, sort(crowd));
  for (const double width : {1.0, 1e3, 1e9}) {
    std::vector<Vec3> points = crowd;
    for (int k = 0; k < 4096; ++k) points.push_back(width * scenes::uniform_vector(random, -1, 1));
    std::shuffle(points.begin(), points.end(), random);
    std::vector<CurveOrder::Record> inner;
    for (const auto& record : sort(points)) {
      if (points[record.number].cwiseAbs().maxCoeff() <= 1e-4) inner.push_back(record);
    }
    EXPECT_LT(mean_extent(points, inner), 1.5 * alone) << "among points " << width << " apart";
  }
}

TEST_F(CurveOrderOf, PointsKeepsAnOrderThatIsAsGoodAndNoOther) {
  Random random(7);
  std::vector<Vec3> points;
  for (int k = 0; k < 20000; ++k) points.push_back(scenes::uniform_vector(random, 0, 1));
  const auto arrange = [&] {
    return order_.arrange(points.size(), frame_of(points), [&](std::size_t i) { return points[i]; });
  };
  const auto is_kept = [](std::span<const CurveOrder::Record> order) {
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (order[i].number < order[i - 1].number) return false;
    }
    return true;
  };
  EXPECT_FALSE(is_kept(arrange()));
  EXPECT_LT(mean_extent(points, arrange()), 1.01 * mean_extent(points, sort(points)));

  std::vector<Vec3> in_order;
  for (const auto& record : sort(points)) in_order.push_back(points[record.number]);
  points = in_order;
  points[777][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_kept(arrange()));
  EXPECT_EQ(arrange().size(), points.size() - 1);

  points.clear();  // near ones are together, but the pieces are strewn
  for (std::size_t piece = 0; piece < 1000; ++piece) {
    const auto begin = in_order.begin() + static_cast<std::ptrdiff_t>(20 * (piece * 377 % 1000));
    points.insert(points.end(), begin, begin + 20);
  }
  EXPECT_FALSE(is_kept(arrange()));

  points = in_order;  // a fifth is in disorder
  std::shuffle(points.begin() + 8000, points.begin() + 12000, random);
  EXPECT_FALSE(is_kept(arrange()));
}

TEST_F(CurveOrderOf, PointsInOnePlaceEnds) {
  const std::vector<Vec3> points(1000, Vec3(0.3, -2e5, 1e-300));
  EXPECT_EQ(sort(points).size(), points.size());
}

}  // namespace
}  // namespace breccia::detection::curve_order_test
