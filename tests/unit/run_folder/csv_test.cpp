#include "run_folder/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <sstream>

namespace breccia::run_folder::csv_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Csv, FieldsInQuotesMayHoldCommasAndQuotes) {
  EXPECT_THAT(fields_of("step,time [s],\"a, \"\"b\"\" [J]\""), ElementsAre("step", "time [s]", "a, \"b\" [J]"));
  EXPECT_THAT(fields_of(""), ElementsAre(""));
  EXPECT_THAT(fields_of(","), ElementsAre("", ""));
  EXPECT_THAT(fields_of("a,b\r"), ElementsAre("a", "b"));
  EXPECT_THAT(fields_of("\"open, a"), ElementsAre("open, a"));
}

TEST(Csv, AFieldThatIsWrittenReadsBack) {
  for (const std::string name : {"plain", "a, b", "\"", "a \"b\", c", ""}) {
    EXPECT_THAT(fields_of(csv_field(name) + ",next"), ElementsAre(name, "next"));
  }
  EXPECT_EQ(csv_field("two\nlines"), "\"two lines\"");
}

TEST(Csv, ANumberIsTheWholeField) {
  EXPECT_EQ(number_of("0.10000000000000001"), 0.1);
  EXPECT_EQ(number_of("-12"), -12);
  EXPECT_EQ(number_of("4.9406564584124654e-324"), 4.9406564584124654e-324);
  EXPECT_TRUE(std::isnan(number_of("nan").value_or(0)));
  EXPECT_EQ(number_of("-inf"), -INFINITY);
  for (const char* text : {"", "1.5x", "x", " ", "1e-", "1 2", "0x10"}) EXPECT_FALSE(number_of(text)) << text;
}

TEST(Csv, ANumberHasAPointInEveryLocale) {
  if (std::setlocale(LC_NUMERIC, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no locale with a decimal comma";
  EXPECT_EQ(number_of("1.5"), 1.5);
  std::setlocale(LC_NUMERIC, "C");
}

TEST(Csv, RowsBeforeAStepStay) {
  const std::string table = "step,x\n0,1\n10,2\nrubbish\n20,3\n30,4\n4";
  EXPECT_EQ(rows_before(table, "step,x", 20), "0,1\n10,2\n");
  EXPECT_EQ(rows_before(table, "step,x", 100), "0,1\n10,2\n20,3\n30,4\n") << "the last row has no end";
  EXPECT_EQ(rows_before(table, "step,y", 100), "");
  EXPECT_EQ(rows_before("step,x", "step,x", 100), "") << "a header that is being written";
  EXPECT_EQ(rows_before("", "", 100), "");
  EXPECT_EQ(step_of_row("12\r"), 12);
  EXPECT_EQ(step_of_row("1e+06,0.5"), 1000000) << "a double in its shortest form";
  EXPECT_FALSE(step_of_row("12.5,1"));
  EXPECT_FALSE(step_of_row("99999999999999999999,1"));
}

TEST(Csv, LinesWithoutTheirEndAreLeftOut) {
  const WholeLines lines = whole_lines("a\n\nb");
  EXPECT_THAT(lines.lines, ElementsAre("a", ""));
  EXPECT_TRUE(lines.is_cut);
  EXPECT_FALSE(whole_lines("a\n").is_cut);
  EXPECT_THAT(whole_lines("").lines, IsEmpty());
  std::istringstream stream("a\nb");
  std::string line;
  EXPECT_TRUE(next_whole_line(stream, line));
  EXPECT_EQ(line, "a");
  EXPECT_FALSE(next_whole_line(stream, line));
}

}  // namespace
}  // namespace breccia::run_folder::csv_test
