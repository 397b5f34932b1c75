#include <gtest/gtest.h>

#include "detection/point_body/slices.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::slices_test {
namespace {

using scenes::Random;

std::int64_t size_of(const CellRange& range) {
  return std::max<std::int64_t>(0, std::int64_t{range.high} - range.low + 1);
}

std::int64_t cells_in(const Slices& slices) {
  std::int64_t count = 0;
  for (std::int32_t z = slices.box().low[2]; z <= slices.box().high[2]; ++z) {
    const CellRange in_y = slices.y_range(z);
    for (std::int32_t y = in_y.low; y <= in_y.high; ++y) count += size_of(slices.x_range(z, y));
  }
  return count;
}

std::int64_t cells_in(const CellBox& box) {
  std::int64_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) count *= size_of({box.low[axis], box.high[axis]});
  return count;
}

bool contains(const CellRange& range, std::int32_t cell) { return cell >= range.low && cell <= range.high; }

TEST(Slices, ContainTheCellOfEveryCouple) {
  Random random(31);
  std::int64_t couples = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 centre = scenes::uniform_vector(random, -10, 10);
    const double size = k % 2 == 0 ? 1.0 : 0.01;
    const Corners corners = scenes::random_tetrahedron(random, centre, size);
    const CoupleTest test(corners, 0.03 * size * (k % 5));
    const Cells cells(size * (k % 3 == 0 ? 0.03 : 0.2));
    const Slices slices(cells, test);
    for (int j = 0; j < 200; ++j) {
      const Vec3 p = scenes::random_point_in(random, corners) + size * scenes::uniform_vector(random, -0.15, 0.15);
      if (!test.holds(p)) continue;
      ++couples;
      const std::int32_t z = cells.of(p[2]), y = cells.of(p[1]), x = cells.of(p[0]);
      ASSERT_TRUE(contains(slices.y_range(z), y));
      ASSERT_TRUE(contains(slices.x_range(z, y), x));
    }
  }
  EXPECT_GT(couples, 50000);
}

TEST(Slices, ContainTheCornersOfElementsWhoseCornersLieOnBordersOfCells) {
  // A bound that round-off puts a hair below a border would leave out the cell in which the corner lies.
  Random random(7);
  const Cells cells(0.1);
  const auto border = [&] { return 0.1 * std::floor(scenes::uniform_vector(random, -20, 20)[0]); };
  for (int k = 0; k < 3000; ++k) {
    Corners corners;
    for (Vec3& corner : corners) corner = Vec3(border(), border(), border());
    const CoupleTest test(corners, 0);
    const Slices slices(cells, test);
    for (const Vec3& p : corners) {
      ASSERT_TRUE(test.holds(p));
      const std::int32_t z = cells.of(p[2]), y = cells.of(p[1]), x = cells.of(p[0]);
      ASSERT_TRUE(contains(slices.y_range(z), y)) << "element " << k;
      ASSERT_TRUE(contains(slices.x_range(z, y), x)) << "element " << k;
    }
  }
}

TEST(Slices, ApproachTheSixthOfTheBoxThatACornerTetrahedronFills) {
  // 60 cells a side: the body has a sixth of the box; cells cut by the oblique face add about 60^2 / 2 / 60^3 each way.
  const Corners corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const CoupleTest test(corners, 0);
  const Cells cells(1.0 / 60);
  const Slices slices(cells, test);
  const double share = static_cast<double>(cells_in(slices)) / static_cast<double>(cells_in(slices.box()));
  EXPECT_GT(share, 1.0 / 6);
  EXPECT_LT(share, 1.0 / 6 + 0.04);
}

TEST(Slices, ApproachTheThirdOfTheBoxThatARegularTetrahedronFills) {
  const CoupleTest test(scenes::regular_tetrahedron(Vec3(0.1, 0.2, 0.3), 1), 0);
  const Cells cells(std::sqrt(0.5) / 60);
  const Slices slices(cells, test);
  const double share = static_cast<double>(cells_in(slices)) / static_cast<double>(cells_in(slices.box()));
  EXPECT_GT(share, 1.0 / 3);
  EXPECT_LT(share, 1.0 / 3 + 0.08);
}

TEST(Slices, HaveTheTriangleOfRowsThatASlantedTetrahedronCastsOnTheYzPlane) {
  // Sheared by x += 3 y - 2 z: the shadow stays y, z >= 0, y + z <= 1, though no face is parallel to x any more.
  const Corners corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 1, 0), Vec3(-2, 0, 1)};
  const CoupleTest test(corners, 0);
  const Cells cells(1.0 / 60);
  const Slices slices(cells, test);
  for (std::int32_t z = 0; z < 60; ++z) {
    const CellRange in_y = slices.y_range(z);
    EXPECT_LE(in_y.low, 0);
    EXPECT_GE(in_y.low, -1) << "no cell below the slack";
    EXPECT_NEAR(in_y.high, 60 - z, 1);  // the layer's lower side, at z / 60, reaches to y = 1 - z / 60
  }
}

TEST(Slices, AreTheWholeBoxForAnElementWithoutVolume) {
  Corners flat = scenes::regular_tetrahedron(Vec3::Zero(), 1);
  std::swap(flat[0], flat[1]);
  const CoupleTest test(flat, 0.1);
  const Cells cells(0.1);
  const Slices slices(cells, test);
  EXPECT_EQ(cells_in(slices), cells_in(slices.box()));
}

}  // namespace
}  // namespace breccia::detection::slices_test
