#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "detection/point_body/couple_test.hpp"
#include "unit/detection/scenes.hpp"

namespace breccia::detection::couple_test_test {
namespace {

using scenes::Random;

/// Corners at the origin and the unit vectors: faces x = 0, y = 0, z = 0 and x + y + z = 1.
const Corners corner_tetrahedron{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

using Vec3l = Eigen::Matrix<long double, 3, 1>;

/// Signed distance by which the definition's inequality with the smallest margin holds, m, in extended precision.
long double margin(const Corners& corners, double buffer, const Vec3& point) {
  const Vec3l p = point.cast<long double>();
  Vec3l x[4];
  for (std::size_t k = 0; k < 4; ++k) x[k] = corners[k].cast<long double>();
  long double least = std::numeric_limits<long double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    long double low = x[0][axis], high = x[0][axis];
    for (const Vec3l& corner : x) {
      low = std::min(low, corner[axis]);
      high = std::max(high, corner[axis]);
    }
    least = std::min({least, p[axis] - (low - buffer), high + buffer - p[axis]});
  }
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3l &f = x[(a + 1) % 4], &g = x[(a + 2) % 4], &h = x[(a + 3) % 4];
    Vec3l n = (g - f).cross(h - f).normalized();
    if (n.dot(x[a] - f) > 0) n = -n;
    least = std::min(least, buffer - n.dot(p - f));
  }
  return least;
}

TEST(CoupleTest, KeepsAPointAtBufferDistanceFromAFaceAndNoFarther) {
  const CoupleTest test(corner_tetrahedron, 0.125);
  EXPECT_TRUE(test.holds(Vec3(0.25, 0.25, -0.125)));
  EXPECT_FALSE(test.holds(Vec3(0.25, 0.25, -0.1250001)));
  // The oblique face x + y + z = 1: 0.125 along the normal (1, 1, 1) / sqrt(3) is 0.125 sqrt(3) in the sum.
  const double reach = (1 + 0.125 * std::sqrt(3.0)) / 3;
  EXPECT_TRUE(test.holds(Vec3::Constant(reach - 1e-9)));
  EXPECT_FALSE(test.holds(Vec3::Constant(reach + 1e-9)));
}

TEST(CoupleTest, KeepsAPointOnTheBorderOfTheEnlargedBox) {
  Corners flat = corner_tetrahedron;  // without volume only the box counts
  flat[3] = Vec3(0.5, 0.5, 0);
  const CoupleTest test(flat, 0.25);
  EXPECT_FALSE(test.has_planes());
  EXPECT_TRUE(test.holds(Vec3(1.25, 1.25, 0.25)));
  EXPECT_TRUE(test.holds(Vec3(-0.25, -0.25, -0.25)));
  EXPECT_FALSE(test.holds(Vec3(std::nextafter(1.25, 2.0), 1, 0)));
  EXPECT_FALSE(test.holds(Vec3(0, 0, std::nextafter(-0.25, -1.0))));
}

TEST(CoupleTest, CutsASharpEdgeAtTheEnlargedBox) {
  // Beyond the corner (1, 0, 0) the buffered planes leave room up to x = 1 + b (2 + sqrt(3)), the box only up to 1 + b.
  const CoupleTest test(corner_tetrahedron, 0.125);
  EXPECT_TRUE(test.holds(Vec3(1.12, -0.1, -0.1)));
  EXPECT_FALSE(test.holds(Vec3(1.13, -0.1, -0.1)));
}

TEST(CoupleTest, AgreesWithTheDefinitionInExtendedPrecision) {
  // Points closer to a border than the double arithmetic resolves are left out: 1e-9 of slivers of size 1.
  constexpr double undecided = 1e-9;
  Random random(11);
  int inside = 0, outside = 0;
  for (int k = 0; k < 2000; ++k) {
    const Corners corners = scenes::random_tetrahedron(random, scenes::uniform_vector(random, -5, 5), 1);
    const double buffer = k % 4 == 0 ? 0 : 0.05 * (k % 7);
    const CoupleTest test(corners, buffer);
    if (!test.has_planes()) continue;
    for (int j = 0; j < 50; ++j) {
      const Vec3 p = scenes::random_point_in(random, corners) + scenes::uniform_vector(random, -0.2, 0.2);
      const long double distance = margin(corners, buffer, p);
      if (std::abs(distance) < undecided) continue;
      ASSERT_EQ(test.holds(p), distance > 0) << "margin " << static_cast<double>(distance) << ", buffer " << buffer;
      ++(distance > 0 ? inside : outside);
    }
  }
  EXPECT_GT(inside, 10000);
  EXPECT_GT(outside, 10000);
}

TEST(CoupleTest, NeverLosesAPointToALargerBuffer) {
  Random random(12);
  for (int k = 0; k < 500; ++k) {
    const Corners corners = scenes::random_tetrahedron(random, Vec3(100, -3, 7), 0.01);
    const CoupleTest smaller(corners, 1e-3), larger(corners, std::nextafter(1e-3, 1.0));
    for (int j = 0; j < 50; ++j) {
      const Vec3 p = scenes::random_point_in(random, corners) + scenes::uniform_vector(random, -0.003, 0.003);
      ASSERT_LE(smaller.holds(p), larger.holds(p));
    }
  }
}

TEST(CoupleTest, KeepsCornersFaceCentresAndInnerPointsOfSliversWithoutAnyBuffer) {
  Random random(13);
  for (const double thickness : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-30, 1e-200}) {
    for (int k = 0; k < 200; ++k) {
      // Flat (one corner almost in the plane of the others) and needle (three corners almost on a line).
      const Vec3 x0 = scenes::uniform_vector(random, 0, 1), u = scenes::uniform_vector(random, -1, 1),
                 v = scenes::uniform_vector(random, -1, 1), w = thickness * scenes::uniform_vector(random, -1, 1);
      Corners flat{x0, x0 + u, x0 + v, x0 + 0.3 * u + 0.3 * v + w};
      Corners needle{x0, x0 + u, x0 + 0.5 * u + w, x0 + 0.7 * u + thickness * v};
      for (Corners& c : std::array{flat, needle}) {
        if ((c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) < 0) std::swap(c[2], c[3]);
        // 1e-15 of coordinates below 3: the round-off of the points themselves, which is not the test's to forgive.
        const CoupleTest test(c, 1e-15);
        for (const Vec3& corner : c) ASSERT_TRUE(test.holds(corner)) << "thickness " << thickness;
        for (std::size_t a = 0; a < 4; ++a) ASSERT_TRUE(test.holds(scenes::face_centre(c, a))) << thickness;
        for (int j = 0; j < 10; ++j) ASSERT_TRUE(test.holds(scenes::random_point_in(random, c))) << thickness;
      }
    }
  }
}

TEST(CoupleTest, KeepsEverythingInTheBoxOfAnInvertedElement) {
  Corners inverted = corner_tetrahedron;
  std::swap(inverted[0], inverted[1]);
  const CoupleTest test(inverted, 0.1);
  EXPECT_FALSE(test.has_planes());
  EXPECT_TRUE(test.holds(Vec3(1, 1, 1)));
  EXPECT_TRUE(test.holds(Vec3(0.2, 0.2, 0.2)));
}

TEST(CoupleTest, LeavesOutWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const CoupleTest test(corner_tetrahedron, 0.1);
  for (const double bad : {nan, infinity, -infinity}) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Vec3 p(0.2, 0.2, 0.2);
      p[axis] = bad;
      EXPECT_FALSE(test.holds(p));
      for (std::size_t k = 0; k < 4; ++k) {
        Corners broken = corner_tetrahedron;
        broken[k][axis] = bad;
        EXPECT_TRUE(CoupleTest(broken, 0.1).skipped());
      }
    }
  }
  EXPECT_FALSE(test.skipped());
}

TEST(CoupleTest, KeepsTheInnerPointsOfHugeAndTinyElements) {
  Random random(14);
  for (const double size : {1e-300, 1e-160, 1e-100, 1e100, 1e160, 1e300}) {
    Corners c;
    for (std::size_t k = 0; k < 4; ++k) c[k] = size * corner_tetrahedron[k];
    const CoupleTest test(c, 1e-15 * size);  // round-off of the points
    for (int j = 0; j < 20; ++j) EXPECT_TRUE(test.holds(scenes::random_point_in(random, c))) << size;
    EXPECT_FALSE(test.holds(Vec3::Constant(1.5 * size))) << size;
  }
}

}  // namespace
}  // namespace breccia::detection::couple_test_test
