#include "base/number_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace breccia::number_text_test {
namespace {

TEST(NumberText, HasNoMoreDigitsThanAskedForAndKeepsSmallAndLargeNumbers) {
  EXPECT_EQ(number_text(0.00015, 4), "0.00015");
  EXPECT_EQ(number_text(1.23456e-9, 3), "1.23e-09");
  EXPECT_EQ(number_text(12345.678, 2), "1.2e+04");
  EXPECT_EQ(number_text(0.0, 4), "0");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::max(), 17), "-1.7976931348623157e+308");
}

TEST(Rounded, KeepsTheDigitsAskedForOfEveryFiniteNumber) {
  EXPECT_EQ(rounded(1234.5, 3), 1230);
  EXPECT_EQ(rounded(-9996, 3), -10000);
  EXPECT_EQ(rounded(0.0, 3), 0);
  constexpr double kDenormal = 1e-320, kSmallest = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(rounded(kDenormal, 3), kDenormal);
  EXPECT_EQ(rounded(kSmallest, 3), kSmallest);
  EXPECT_EQ(rounded(-kDenormal, 1), -kDenormal);
}

}  // namespace
}  // namespace breccia::number_text_test
