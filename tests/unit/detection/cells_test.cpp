#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "detection/point_body/cells.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::cells_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Cells, GoByFloorOnBothSidesOfZero) {
  const Cells cells(0.5);
  EXPECT_EQ(cells.of(0.0), 0);
  EXPECT_EQ(cells.of(-0.0), 0);
  EXPECT_EQ(cells.of(0.49), 0);
  EXPECT_EQ(cells.of(-0.01), -1);
  EXPECT_EQ(cells.of(-0.5), -1);
  EXPECT_EQ(cells.of(-0.51), -2);
  EXPECT_EQ(cells.of(7.25), 14);
}

TEST(Cells, PutAPointOnABorderIntoTheUpperCell) {
  const Cells cells(0.25);
  for (int k = -1000; k <= 1000; ++k) {
    EXPECT_EQ(cells.of(0.25 * k), k);
    EXPECT_EQ(cells.of(std::nextafter(0.25 * k, -infinity)), k - 1);
  }
}

TEST(Cells, StayAtTheBoundForCoordinatesBeyondIt) {
  const Cells cells(1e-3);
  EXPECT_EQ(cells.of(1e300), Cells::bound);
  EXPECT_EQ(cells.of(-1e300), -Cells::bound);
  EXPECT_EQ(cells.of(infinity), Cells::bound);
  EXPECT_EQ(cells.of(-infinity), -Cells::bound);
  EXPECT_EQ(Cells(1e-320).of(1e10), Cells::bound);
  EXPECT_EQ(Cells(1e308).of(-1.0), -1);
}

TEST(Cells, NeverDecreaseWithTheCoordinate) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-3, 3), size(0.001, 1);
  for (int k = 0; k < 100000; ++k) {
    const Cells cells(size(random));
    const double x = coordinate(random);
    const double border = std::round(x / cells.size()) * cells.size();
    for (const double y : {x, border}) {
      ASSERT_LE(cells.of(std::nextafter(y, -infinity)), cells.of(y));
      ASSERT_LE(cells.of(y), cells.of(std::nextafter(y, infinity)));
    }
  }
}

TEST(ChosenCell, IsTheShareOfTheEnlargedWidthOfEqualContactors) {
  // The box of a regular tetrahedron of edge sqrt(2) in this position is the unit cube.
  const std::vector<Corners> contactors(10000, scenes::regular_tetrahedron(Vec3(3, -2, 1), std::sqrt(2.0)));
  constexpr double tolerance = 1e-12;  // logarithm and exponential of a sum of 4,096 terms
  EXPECT_NEAR(choose_cell(contactors, 0.5, 0.25), 0.25 * 2.0, tolerance);
}

TEST(ChosenCell, IsTheGeometricMeanOfTwoSizes) {
  const std::vector<Corners> contactors{scenes::regular_tetrahedron(Vec3::Zero(), std::sqrt(2.0)),
                                        scenes::regular_tetrahedron(Vec3::Zero(), 100 * std::sqrt(2.0))};
  constexpr double tolerance = 1e-12;  // as above
  EXPECT_NEAR(choose_cell(contactors, 0, 1), 10.0, tolerance);
}

TEST(ChosenCell, ExistsWithoutAnyUsableContactor) {
  EXPECT_EQ(choose_cell({}, 0, 0.5), 1.0);
  Corners point;
  point.fill(Vec3(1, 2, 3));
  Corners broken = scenes::regular_tetrahedron(Vec3::Zero(), 1);
  broken[2][1] = infinity;
  EXPECT_EQ(choose_cell(std::vector<Corners>{point, broken}, 0, 0.5), 1.0);
}

}  // namespace
}  // namespace breccia::detection::cells_test
