#include "base/quantity_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace breccia::quantity_text_test {
namespace {

TEST(QuantityText, HasThreeDigitsAndAPrefix) {
  EXPECT_EQ(quantity_text(1.2345e-5, "s"), "12.3 us");
  EXPECT_EQ(quantity_text(0, "J"), "0 J");
  EXPECT_EQ(quantity_text(1e-320, "J"), "1.00e-320 J");
  EXPECT_EQ(quantity_text(-0.5, "J"), "-500 mJ");
  EXPECT_EQ(quantity_text(1, "m"), "1 m");
  EXPECT_EQ(quantity_text(1000, "m"), "1 km");
  EXPECT_EQ(quantity_text(999.7, "Pa"), "1 kPa");
  EXPECT_EQ(quantity_text(9.996e6, "Pa"), "10 MPa");
  EXPECT_EQ(quantity_text(1.6e7, "element-steps/s"), "16 M element-steps/s");
  EXPECT_EQ(quantity_text(400, "element-steps/s"), "400 element-steps/s");
  EXPECT_EQ(quantity_text(1e-30, "J"), "1.00e-30 J");
  EXPECT_EQ(quantity_text(std::numeric_limits<double>::infinity(), "J"), "inf J");
}

TEST(DurationText, UsesTheTwoLargestUnits) {
  EXPECT_EQ(duration_text(0.421), "0.42 s");
  EXPECT_EQ(duration_text(37.2), "37 s");
  EXPECT_EQ(duration_text(59.7), "1 min 0 s");
  EXPECT_EQ(duration_text(725), "12 min 5 s");
  EXPECT_EQ(duration_text(3 * 3600 + 4 * 60 + 5), "3 h 4 min");
  EXPECT_EQ(duration_text(2 * 86400 + 5 * 3600), "2 d 5 h");
  EXPECT_EQ(duration_text(-1), "unknown");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::quiet_NaN()), "unknown");
}

TEST(CountText, GroupsThousands) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1000), "1,000");
  EXPECT_EQ(count_text(-1234567), "-1,234,567");
}

}  // namespace
}  // namespace breccia::quantity_text_test
