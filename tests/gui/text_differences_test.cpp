#include "core/text_differences.hpp"

#include <gtest/gtest.h>

namespace breccia::gui::text_differences_test {
namespace {

TEST(TextDifferences, LinesThatOneTextHasAndTheOtherHasNotAreToldInTheirOrder) {
  EXPECT_EQ(line_differences("a\nb\nc\nd", "a\nB\nc\nnew\nd"), QStringList({"- b", "+ B", "+ new"}));
  EXPECT_EQ(line_differences("a\nb", "a\nb"), QStringList());
  EXPECT_EQ(line_differences("a", ""), QStringList({"- a", "+ "}));
  EXPECT_EQ(line_differences("one\ntwo\nthree", "two\nthree\nfour"), QStringList({"- one", "+ four"}));
}

TEST(TextDifferences, OfAVeryLongDifferenceAllLinesAreTold) {
  QStringList before, after;
  for (int i = 0; i < 4000; ++i) {
    before << QString("b%1").arg(i);
    after << QString("a%1").arg(i);
  }
  EXPECT_EQ(line_differences(before.join('\n'), after.join('\n')).size(), 8000);
}

}  // namespace
}  // namespace breccia::gui::text_differences_test
