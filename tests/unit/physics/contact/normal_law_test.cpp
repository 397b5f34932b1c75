#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/contact/law/normal.hpp"

namespace breccia::normal_law_test {
namespace {

constexpr double kPenalty = 90e6;
constexpr double kRoundOff = 1e-14;    // relative, a handful of operations
constexpr double kQuadrature = 1e-10;  // Gauss rule on smooth pieces of d^b with integer b: exact but for round-off

ContactLaw law(double exponent, double plateau = std::numeric_limits<double>::infinity()) {
  return {kPenalty, plateau, exponent, 0, 1};
}

/// Integral of the stress along a path of overlaps between `from` and `to`, with the state carried along.
double work(const ContactLaw& l, double from, double to, double& d_max) {
  constexpr int pieces = 2000;
  const double h = (to - from) / pieces, x = std::sqrt(0.6);
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const double middle = from + (i + 0.5) * h;
    const auto stress = [&](double d) {
      d_max = normal_law::largest(d, d_max);
      return normal_law::stress(l, d, d_max);
    };
    sum += h / 18 * (5 * stress(middle - 0.5 * h * x) + 8 * stress(middle) + 5 * stress(middle + 0.5 * h * x));
  }
  d_max = normal_law::largest(to, d_max);
  return sum;
}

TEST(NormalLaw, LoadsAlongThePenaltyUpToThePlateau) {
  const ContactLaw l = law(2, 60e6);
  for (const double d : {1e-6, 0.01, 0.3, 0.6})
    EXPECT_NEAR(normal_law::stress(l, d, d), 90e6 * d, kRoundOff * 90e6 * d);
  for (const double d : {0.67, 0.8, 1.0}) EXPECT_DOUBLE_EQ(normal_law::stress(l, d, d), 60e6);
}

TEST(NormalLaw, UnloadsAndReloadsAlongTheSamePowerCurve) {
  const ContactLaw l = law(2, 60e6);
  for (const double d : {0.1, 0.2, 0.35, 0.5})
    EXPECT_NEAR(normal_law::stress(l, d, 0.5), 45e6 * 4 * d * d, kRoundOff * 45e6);
  for (const double d : {0.1, 0.5, 0.8})
    EXPECT_NEAR(normal_law::stress(l, d, 0.8), 60e6 * d * d / 0.64, kRoundOff * 60e6);
}

TEST(NormalLaw, ForgetsEverythingWhenTheOverlapIsGone) {
  EXPECT_EQ(normal_law::largest(0.0, 0.7), 0.0);
  EXPECT_EQ(normal_law::largest(-0.1, 0.7), 0.0);
  EXPECT_EQ(normal_law::stress(law(2), -0.1, 0.0), 0.0);
}

TEST(NormalLaw, ReturnsTwoOverBPlusOneOfTheEnergyBelowThePlateau) {
  for (const double b : {1.0, 2.0, 4.0, 6.0}) {
    const ContactLaw l = law(b);
    const double peak = 0.37, put_in = 0.5 * kPenalty * peak * peak;
    EXPECT_NEAR(normal_law::stored(l, peak, peak) / put_in, 2 / (b + 1), kRoundOff) << "b = " << b;
    EXPECT_NEAR(normal_law::dissipated(l, peak) / put_in, 1 - 2 / (b + 1), kRoundOff) << "b = " << b;
  }
}

TEST(NormalLaw, ReturnsTheShareGOver2gMinus1OfThatBeyondThePlateau) {
  for (const double b : {1.0, 2.0, 6.0}) {
    const double g = 1.5, peak = 0.4;
    const ContactLaw l = law(b, kPenalty * peak / g);
    const double returned = normal_law::stored(l, peak, peak);
    EXPECT_NEAR(returned / (returned + normal_law::dissipated(l, peak)), 2 / (b + 1) * g / (2 * g - 1), kRoundOff);
  }
}

TEST(NormalLaw, StoredAndDissipatedEnergyAddUpToTheWorkAlongAnyPath) {
  for (const double b : {1.0, 2.0, 3.0}) {
    for (const double plateau : {std::numeric_limits<double>::infinity(), 30e6}) {
      const ContactLaw l = law(b, plateau);
      double d_max = 0, done = 0, d = 0;
      for (const double next : {1.0 / 3, 0.1, 0.25, 1.0 / 3, 0.6, 0.05, 0.6, 0.2}) {
        done += work(l, d, next, d_max);
        d = next;
        const double accounted = normal_law::stored(l, d, d_max) + normal_law::dissipated(l, d_max);
        EXPECT_NEAR(accounted, done, kQuadrature * kPenalty) << "b = " << b << ", d = " << d;
      }
    }
  }
}

TEST(NormalLaw, NeverGivesEnergyBackThatItHasDissipated) {
  const ContactLaw l = law(3, 40e6);
  double before = 0;
  for (double d_max = 0; d_max < 1; d_max += 0.01) {
    const double now = normal_law::dissipated(l, d_max);
    EXPECT_GE(now, before);
    before = now;
  }
}

TEST(NormalLaw, SurvivesATinyOverlapWithAHighExponent) {
  EXPECT_TRUE(std::isfinite(normal_law::stress(law(6), 1e-80, 1e-70)));
}

}  // namespace
}  // namespace breccia::normal_law_test
