#include "base/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace breccia::time_function_test {
namespace {

// Sums of a few products of numbers of order one: some units in the last place.
constexpr double kRoundOff = 1e-14;

TEST(TimeFunction, IsZeroAtAllTimesUnlessToldOtherwise) {
  const TimeFunction f;
  EXPECT_EQ(f(-1.0), 0.0);
  EXPECT_EQ(f(0.0), 0.0);
  EXPECT_EQ(f(3.0), 0.0);
  EXPECT_TRUE(f.is_zero());
}

TEST(TimeFunction, AddsConstantLinearSineAndTable) {
  TimeFunction f;
  f.constant = 2.0;
  f.linear = -3.0;
  f.sines = {{0.5, 0.25, std::numbers::pi / 6}, {4.0, 1.0, 0.0}};
  f.table = {{0.0, 10.0}, {2.0, 20.0}};
  // At t = 1: 2 - 3 + 0.5 sin(pi/2 + pi/6) + 4 sin(2 pi) + 15 = 14 + 0.5 cos(pi/6)
  EXPECT_NEAR(f(1.0), 14.0 + 0.25 * std::sqrt(3.0), kRoundOff * 20);
}

TEST(TimeFunction, InterpolatesItsTableLinearlyBetweenUnevenPoints) {
  TimeFunction f;
  f.table = {{1.0, 5.0}, {2.0, 7.0}, {6.0, -1.0}};
  EXPECT_NEAR(f(1.5), 6.0, kRoundOff);
  EXPECT_NEAR(f(3.0), 5.0, kRoundOff);
  EXPECT_NEAR(f(5.0), 1.0, kRoundOff);
}

TEST(TimeFunction, MeetsEveryPointOfItsTableExactly) {
  TimeFunction f;
  f.table = {{1.0, 0.1}, {2.0, 0.7}, {6.0, -0.3}};
  for (const TimeFunction::Point& p : f.table) EXPECT_EQ(f(p.time), p.value) << "at t = " << p.time;
}

TEST(TimeFunction, HoldsTheFirstAndLastValueOutsideItsTable) {
  TimeFunction f;
  f.table = {{1.0, 5.0}, {2.0, 7.0}};
  EXPECT_EQ(f(-100.0), 5.0);
  EXPECT_EQ(f(0.999), 5.0);
  EXPECT_EQ(f(2.001), 7.0);
  EXPECT_EQ(f(1e9), 7.0);
}

TEST(TimeFunction, WithATableOfOnePointIsConstant) {
  TimeFunction f;
  f.table = {{3.0, 4.0}};
  EXPECT_EQ(f(0.0), 4.0);
  EXPECT_EQ(f(3.0), 4.0);
  EXPECT_EQ(f(9.0), 4.0);
}

TEST(TimeFunction, IsNotZeroWhenAnyOfItsTermsIsNot) {
  TimeFunction constant, linear, sine, table;
  constant.constant = 1.0;
  linear.linear = 1.0;
  sine.sines = {{1.0, 1.0, 0.0}};
  table.table = {{0.0, 0.0}, {1.0, 1.0}};
  EXPECT_FALSE(constant.is_zero());
  EXPECT_FALSE(linear.is_zero());
  EXPECT_FALSE(sine.is_zero());
  EXPECT_FALSE(table.is_zero());
}

TEST(TimeFunction, DoesTheSameEarlier) {
  TimeFunction f;
  f.constant = 2.0;
  f.linear = 3.0;
  f.sines = {{4.0, 0.7, 0.2}};
  f.table = {{1.0, 0.0}, {2.0, 5.0}};
  for (const double t : {-1.0, 0.0, 0.3, 1.4, 9.0}) EXPECT_NEAR(f.earlier(0.6)(t), f(t + 0.6), 1e-13) << t;
}

TEST(TimeFunction, IsZeroWhenAmplitudesAndTableValuesAreZero) {
  TimeFunction f;
  f.sines = {{0.0, 50.0, 1.0}};
  f.table = {{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_TRUE(f.is_zero());
}

}  // namespace
}  // namespace breccia::time_function_test
