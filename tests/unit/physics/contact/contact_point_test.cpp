#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "scene.hpp"

namespace breccia::contact_point_test {
namespace {

constexpr double kRoundOff = 1e-14;

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// Integral of L1^i L2^j L3^k over a triangle of area 1: 2 i! j! k! / (i + j + k + 2)!
double exact(int i, int j, int k) { return 2 * factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 2); }

TEST(FaceRule, IntegratesPolynomialsOfItsDegreeExactly) {
  for (const auto& [points, degree] : {std::pair{1, 1}, {3, 2}, {4, 2}, {6, 4}}) {
    const FaceRule& rule = face_rule(points);
    ASSERT_EQ(rule.num_points, points);
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; i + j <= degree; ++j) {
        for (int k = 0; i + j + k <= degree; ++k) {
          double sum = 0;
          for (std::size_t p = 0; p < static_cast<std::size_t>(points); ++p) {
            sum += rule.share[p] * std::pow(rule.shape[p][0], i) * std::pow(rule.shape[p][1], j) *
                   std::pow(rule.shape[p][2], k);
          }
          EXPECT_NEAR(sum, exact(i, j, k), kRoundOff) << points << " points, " << i << j << k;
        }
      }
    }
  }
}

TEST(FaceRule, PointsLieInsideTheTriangle) {
  for (const int points : {1, 3, 6}) {
    for (std::size_t p = 0; p < static_cast<std::size_t>(points); ++p) {
      const auto& n = face_rule(points).shape[p];
      EXPECT_NEAR(n[0] + n[1] + n[2], 1, kRoundOff);
      for (const double value : n) EXPECT_GT(value, 0.05);
    }
  }
}

TEST(FaceRule, RefusesOtherNumbersOfPoints) { EXPECT_THROW((void)face_rule(5), InternalError); }

TEST(ContactPoints, OfABoxCarryItsSurfaceAndKnowTheirElement) {
  for (const int points : {1, 3, 4, 6}) {
    const test::Scene scene(test::box({1, 1, 1}, 2.0), {}, points);
    ASSERT_EQ(scene.contact.points.size(), static_cast<std::size_t>(24 * points));
    double area = 0;
    Vec3 first_moment = Vec3::Zero();
    for (const ContactPoint& p : scene.contact.points) {
      const Vec3 x = at_point(face_rule(points), p, scene.state.position.data());
      area += p.weight;
      first_moment += p.weight * x;
      EXPECT_NEAR((x - Vec3(1, 1, 1)).cwiseAbs().maxCoeff(), 1, kRoundOff) << "not on the surface";
      EXPECT_EQ(p.id / 24, scene.local.element_of_slot[static_cast<std::size_t>(p.slot)]);
      EXPECT_EQ(p.id % 24, 6 * p.face + p.k);
    }
    EXPECT_NEAR(area, 24, 24 * kRoundOff);
    EXPECT_NEAR((first_moment / area - Vec3(1, 1, 1)).norm(), 0, 24 * kRoundOff);
  }
}

TEST(ContactPoints, AreOrderedByIdentityWheneverTheyCame) {
  test::Scene scene(test::box({2, 1, 1}, 1.0), {}, 3);
  std::reverse(scene.contact.points.begin(), scene.contact.points.end());
  scene.contact.order.clear();
  sort_points(scene.contact);
  for (std::size_t i = 1; i < scene.contact.order.size(); ++i) {
    EXPECT_LT(scene.contact.id(scene.contact.order[i - 1]), scene.contact.id(scene.contact.order[i]));
  }
}

}  // namespace
}  // namespace breccia::contact_point_test
