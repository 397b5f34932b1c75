#include "report/axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace breccia::report::axis_test {
namespace {

using testing::ElementsAre;

TEST(LinearAxis, HasRoundMarksInUnitsWithAPrefix) {
  const Axis axis = linear_axis(0, 1e-4, "time", "s");
  EXPECT_EQ(axis.title, "time [µs]");
  EXPECT_THAT(axis.labels, ElementsAre("0", "20", "40", "60", "80", "100"));
  EXPECT_DOUBLE_EQ(axis.place(5e-5), 0.5);
}

TEST(LinearAxis, BeginsAtZeroUnlessThatTakesHalfOfIt) {
  EXPECT_EQ(linear_axis(1, 10, "x", "m").low, 0);
  EXPECT_EQ(linear_axis(9, 10, "x", "m").low, 9);
  EXPECT_LE(linear_axis(-3, 10, "x", "m").low, -3);
}

TEST(LinearAxis, OfPureNumbersTellsTheirPowerOfTen) {
  EXPECT_EQ(linear_axis(0, 1.07e-4, "residual", "").title, "residual [10⁻⁶]");
  const Axis counts = linear_axis(0, 1138, "joints", "");
  EXPECT_EQ(counts.title, "joints");
  EXPECT_EQ(counts.labels.back(), "1,500");
}

TEST(LinearAxis, OfOneValueHasRoom) {
  for (const double value : {0.0, 3.0, -3.0, std::nan("")}) {
    const Axis axis = linear_axis(value, value, "x", "");
    EXPECT_LT(axis.low, axis.high) << value;
    EXPECT_FALSE(value < axis.low || value > axis.high) << value;
  }
}

TEST(LogarithmicAxis, HoldsItsValuesBetweenMarks) {
  const Axis narrow = logarithmic_axis(1.49e-3, 0.0467, "size", "m");
  EXPECT_EQ(narrow.title, "size [mm]");
  EXPECT_THAT(narrow.labels, ElementsAre("1", "2", "5", "10", "20", "50"));
  const Axis wide = logarithmic_axis(1, 1e5, "events", "");
  EXPECT_THAT(wide.labels, ElementsAre("1", "10", "100", "1,000", "10,000", "100,000"));
  EXPECT_NEAR(wide.place(10), 0.2, 1e-12);
  const Axis one = logarithmic_axis(10, 10, "x", "");
  EXPECT_LT(one.low, one.high);
}

}  // namespace
}  // namespace breccia::report::axis_test
