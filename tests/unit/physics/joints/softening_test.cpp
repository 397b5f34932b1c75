#include "physics/softening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace breccia::softening_test {
namespace {

constexpr double kRoundOff = 1e-13;      // some operations on numbers of order one
constexpr double kMidpointError = 1e-9;  // of a sum with 200,000 strips over these curves

/// The published curve, term by term.
double published(double a, double b, double c, double d) {
  const double k = (a + c * b) / ((a + b) * (1 - a - b));
  return (1 - (a + b - 1) / (a + b) * std::exp(d * k)) * (a * (1 - d) + b * std::pow(1 - d, c));
}

double area_by_strips(const SofteningCurve& z) {
  constexpr int strips = 200000;
  double sum = 0;
  for (int i = 0; i < strips; ++i) sum += z((i + 0.5) / strips);
  return sum / strips;
}

double slope(const SofteningCurve& z, double d, double h = 1e-6) { return (z(d + h) - z(d - h)) / (2 * h); }

TEST(Softening, ZCurveIsThePublishedOne) {
  const SofteningCurve z(Softening{});
  for (double d = 0; d <= 1; d += 0.01) EXPECT_NEAR(z(d), published(0.63, 1.8, 6, d), kRoundOff) << d;
}

TEST(Softening, ZCurveHasTheArea03863073AndNotThatOfA300StripSum) {
  EXPECT_NEAR(SofteningCurve(Softening{}).area(), 0.386307295, 5e-10);  // closed form worked by hand to nine digits
}

TEST(Softening, ZCurveLeavesThePeakWithoutAKinkAndFallsFastestAt0145) {
  const SofteningCurve z(Softening{});
  EXPECT_NEAR((z(1e-6) - z(0)) / 1e-6, 0.0, 1e-4);  // second-order term times the step
  EXPECT_NEAR((z(1) - z(1 - 1e-7)) / 1e-7, -0.616, 1e-3);
  double steepest = 0, where = 0;
  for (double d = 0.001; d < 0.999; d += 0.001) {
    if (-slope(z, d) > steepest) {
      steepest = -slope(z, d);
      where = d;
    }
  }
  EXPECT_NEAR(steepest, 2.04, 0.005);
  EXPECT_NEAR(where, 0.145, 0.002);
}

TEST(Softening, AreasAreThoseOfTheCurvesForWholeAndBrokenExponents) {
  for (const Softening& s :
       {Softening{SofteningShape::z_curve, 0.63, 1.8, 6.0, 0}, Softening{SofteningShape::z_curve, 0.63, 1.8, 5.5, 0},
        Softening{SofteningShape::z_curve, 0.63, 1.8, 30.0, 0}, Softening{SofteningShape::z_curve, 1.2, 10.0, 7.3, 0},
        Softening{SofteningShape::z_curve, 0.5, 0.501, 2.0, 0}, Softening{SofteningShape::z_curve, 20.0, 1.0, 10.0, 0},
        Softening{SofteningShape::linear, 0, 0, 0, 0}, Softening{SofteningShape::exponential, 0, 0, 0, 5.0},
        Softening{SofteningShape::exponential, 0, 0, 0, 1e-3}}) {
    const SofteningCurve z(s);
    EXPECT_NEAR(z.area(), area_by_strips(z), kMidpointError * std::fmax(1.0, s.c))
        << "a, b, c, s = " << s.a << ' ' << s.b << ' ' << s.c << ' ' << s.exponent;
  }
}

TEST(Softening, ExponentialAreaDoesNotJumpWhereItsSeriesTakesOver) {
  const auto area = [](double s) { return SofteningCurve(Softening{SofteningShape::exponential, 0, 0, 0, s}).area(); };
  // dA/ds = -1/12 there.
  EXPECT_NEAR(area(0.01 * (1 + 1e-9)) - area(0.01 * (1 - 1e-9)), -0.02e-9 / 12, 1e-12);
}

TEST(Softening, AcceptsCurvesThatFallFrom1To0) {
  EXPECT_EQ(softening_problem(Softening{}), "");
  EXPECT_EQ(softening_problem(Softening{SofteningShape::z_curve, 0.4, 0.6, 3.0, 0}),
            "");  // a + b = 1: the exponential's limit
  EXPECT_EQ(softening_problem(Softening{SofteningShape::linear, 0, 0, 0, 0}), "");
  EXPECT_EQ(softening_problem(Softening{SofteningShape::exponential, 0, 0, 0, 5.0}), "");
}

TEST(Softening, RefusesWhatIsNoSofteningCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(softening_problem(Softening{SofteningShape::z_curve, 0.63, 1.8, 0.0, 0}), "");   // does not end at 0
  EXPECT_NE(softening_problem(Softening{SofteningShape::z_curve, 3.0, -1.5, 6.0, 0}), "");   // falls below 0
  EXPECT_NE(softening_problem(Softening{SofteningShape::z_curve, 20.0, 1.0, 10.0, 0}), "");  // rises before it falls
  EXPECT_NE(softening_problem(Softening{SofteningShape::z_curve, nan, 1.8, 6.0, 0}), "");
  EXPECT_NE(softening_problem(Softening{SofteningShape::exponential, 0, 0, 0, 0.0}), "");  // 0/0
  EXPECT_NE(softening_problem(Softening{SofteningShape::z_curve, 0.0, 0.0, 6.0, 0}), "");
}

}  // namespace
}  // namespace breccia::softening_test
