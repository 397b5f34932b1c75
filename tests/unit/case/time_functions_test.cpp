#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_files.hpp"

namespace breccia::case_::time_functions_test {
namespace {

TimeFunction pressure(const std::string& value) {
  return read_text(minimal + "[[stage.pressure]]\nsurface = \"raster.x0\"\nvalue = " + value + "\n")
      .stages[0]
      .pressures[0]
      .value;
}

TEST(TimeFunctions, AQuantityIsConstant) {
  EXPECT_EQ(pressure("\"2 kPa\"")(0), 2000);
  EXPECT_EQ(pressure("\"2 kPa\"")(5), 2000);
  EXPECT_EQ(pressure("7")(5), 7);
}

TEST(TimeFunctions, ConstantAndLinearAddUp) { EXPECT_EQ(pressure("{constant = 1, linear = \"20 Pa/s\"}")(3), 61); }

TEST(TimeFunctions, SinesAddUp) {
  const TimeFunction f = pressure(
      "{sine = [{amplitude = \"1 kPa\", frequency = \"10 Hz\"}, {amplitude = 5, frequency = 0, phase = \"90 deg\"}]}");
  constexpr double round_off = 1e-10;  // of the sine of a multiple of pi times 1000
  EXPECT_NEAR(f(0), 5, round_off);
  EXPECT_NEAR(f(0.025), 1005, round_off);
}

TEST(TimeFunctions, ARampIsStraightBetweenItsEndsAndConstantOutside) {
  const TimeFunction f = pressure("{ramp = {from = 10, to = 30, start = 1, end = 3}}");
  EXPECT_EQ(f(0), 10);
  EXPECT_EQ(f(2), 20);
  EXPECT_EQ(f(9), 30);
}

TEST(TimeFunctions, ARampStartsFromZeroAtTimeZeroUnlessTold) {
  EXPECT_EQ(pressure("{ramp = {to = 8, end = 2}}")(1), 4);
}

TEST(TimeFunctions, TablesAndRampsOfDifferentTimesAddUp) {
  const TimeFunction f = pressure(
      "{constant = 100, table = [[0, 0], [4, 8]], ramp = [{to = 10, start = 1, end = 2}, "
      "{to = -10, start = 3, end = 5}]}");
  const auto by_hand = [](double t) {
    const double table = t < 4 ? 2 * t : 8;
    const double up = t < 1 ? 0 : t < 2 ? 10 * (t - 1) : 10;
    const double down = t < 3 ? 0 : t < 5 ? -5 * (t - 3) : -10;
    return 100 + table + up + down;
  };
  constexpr double round_off = 1e-12;  // a few roundings of values near 100
  for (double t = 0; t < 6; t += 0.125) EXPECT_NEAR(f(t), by_hand(t), round_off) << t;
}

TEST(TimeFunctions, GravityTakesThreeOfThem) {
  const Case c = read_text(minimal + "gravity = [0, \"1 m/s2\", {ramp = {to = \"-9.81 m/s2\", end = \"2.4 s\"}}]\n");
  EXPECT_TRUE(c.stages[0].gravity[0].is_zero());
  EXPECT_EQ(c.stages[0].gravity[1](3), 1);
  EXPECT_EQ(c.stages[0].gravity[2](2.4), -9.81);
  EXPECT_DOUBLE_EQ(c.stages[0].gravity[2](1.2), -9.81 / 2);
}

}  // namespace
}  // namespace breccia::case_::time_functions_test
