#include "contact/cell_marks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace breccia::cell_marks_test {
namespace {

class Boxes {
 public:
  explicit Boxes(unsigned seed) : random_(seed) {}
  Extent box(const Vec3& low, const Vec3& high, double size) {
    Extent box;
    const Vec3 corner = low + Vec3(share(), share(), share()).cwiseProduct(high - low);
    box.add(corner);
    box.add(corner + size * Vec3(share(), share(), share()));
    return box;
  }

 private:
  double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::mt19937_64 random_;
};

TEST(CellMarks, FindEveryBoxThatComesNearToAMarkedOneAndFewOthers) {
  for (const double cell : {0.05, 0.3, 4.0}) {
    Boxes random(7);
    const double distance = 0.1;
    std::vector<Extent> marked, asked;
    Extent region;
    for (int i = 0; i < 60; ++i) marked.push_back(random.box({-3, -3, -3}, {3, 3, 3}, 0.4));
    for (int i = 0; i < 12000; ++i) {
      asked.push_back(random.box({-1, -2, -3}, {2, 2, 1}, 0.2));
      region.add(asked.back().lower);
      region.add(asked.back().upper);
    }
    CellMarks marks(region, cell);
    for (const Extent& box : marked) marks.mark(box, distance);
    const auto near_any = [&](const Extent& box, double reach) {
      return std::any_of(marked.begin(), marked.end(), [&](const Extent& m) { return box.near(m, reach); });
    };
    std::size_t near = 0, far = 0;
    for (const Extent& box : asked) {
      if (near_any(box, distance)) {
        ++near;
        EXPECT_TRUE(marks.any(box)) << "cell " << cell;
      }
      if (!near_any(box, distance + 2 * cell)) {
        ++far;
        EXPECT_FALSE(marks.any(box)) << "cell " << cell;
      }
    }
    EXPECT_GT(near, 200u);
    EXPECT_TRUE(far > 300 || cell > 1) << far;
  }
}

TEST(CellMarks, OfARegionWithoutVolumeOrOnePointAreThere) {
  Extent point;
  point.add({1, 2, 3});
  CellMarks marks(point, 1);
  EXPECT_FALSE(marks.any(point));
  marks.mark(point, 0);
  EXPECT_TRUE(marks.any(point));
}

TEST(CellMarks, CountEverythingAsMarkedWhereThereIsNoRegion) {
  CellMarks marks(Extent{}, 1);
  Extent box;
  box.add({0, 0, 0});
  marks.mark(box, 1);
  EXPECT_TRUE(marks.any(box));
}

}  // namespace
}  // namespace breccia::cell_marks_test
