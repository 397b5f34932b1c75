#include "base/box_cover.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace breccia {
namespace {

Extent box(const Vec3& lower, double size) { return {lower, lower + Vec3::Constant(size)}; }

double volume(std::span<const Extent> boxes) {
  double sum = 0;
  for (const Extent& each : boxes) sum += (each.upper - each.lower).prod();
  return sum;
}

TEST(BoxCover, HoldsEveryBox) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(0.0, 10.0), size(0.0, 1.0);
  std::vector<Extent> boxes;
  for (int i = 0; i < 2000; ++i) boxes.push_back(box({place(random), place(random), place(random)}, size(random)));
  const std::vector<Extent> covers = cover(boxes);
  EXPECT_LE(covers.size(), kMostBoxes);
  for (const Extent& each : boxes) {
    const bool held = std::any_of(covers.begin(), covers.end(), [&](const Extent& c) {
      return (c.lower.array() <= each.lower.array()).all() && (c.upper.array() >= each.upper.array()).all();
    });
    ASSERT_TRUE(held) << each.lower.transpose();
  }
}

TEST(BoxCover, LeavesOutWhatLiesBetweenTheParts) {
  std::vector<Extent> boxes;  // a ring of unit boxes, 32 m across
  for (int i = 0; i < 200; ++i) {
    const double angle = 2 * 3.14159265 * i / 200;
    boxes.push_back(box({16 * std::cos(angle), 16 * std::sin(angle), 0}, 1));
  }
  const std::vector<Extent> covers = cover(boxes);
  Extent one;
  for (const Extent& each : boxes) one.add(each);
  EXPECT_LT(volume(covers), 0.3 * volume(std::span(&one, 1)));
  EXPECT_FALSE(near_any(box({0, 0, 0}, 1), covers, 8));
  EXPECT_TRUE(near_any(box({0, 0, 0}, 1), covers, 15));
}

TEST(BoxCover, IsOneBoxOfOneAndNoneOfNone) {
  const std::vector<Extent> same(5, box({1, 2, 3}, 1));
  EXPECT_EQ(cover(same).size(), 1U);
  EXPECT_TRUE(cover(std::vector<Extent>(3)).empty());
  EXPECT_FALSE(near_any(same[0], cover({}), std::numeric_limits<double>::infinity()));
}

TEST(BoxCover, TakesWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Extent> boxes(3, box({1, 2, 3}, 1));
  boxes[1].upper[0] = infinity;
  EXPECT_TRUE(near_any(boxes[0], cover(boxes), 0));
}

}  // namespace
}  // namespace breccia
