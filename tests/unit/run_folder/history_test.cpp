#include "run_folder/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>

#include "unit/output/temporary_folder.hpp"

namespace breccia::run_folder::history_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const kText = "step,time [s],\"a, \"\"b\"\" [J]\"\n0,0,1.5\n10,1e-6,nan\n";

TEST(RunHistory, IsReadByColumnsWithTheirUnits) {
  const HistoryText read = parse_history(kText);
  const History& history = read.history;
  EXPECT_THAT(history.names, ElementsAre("step", "time [s]", "a, \"b\" [J]"));
  EXPECT_THAT(history.column("time [s]"), ElementsAre(0, 1e-6));
  EXPECT_EQ(history.rows(), 2U);
  EXPECT_EQ(history.last("step"), 10);
  EXPECT_FALSE(read.is_cut);
  EXPECT_EQ(read.num_left_out, 0U);
}

TEST(RunHistory, HasNoValuesOfAColumnThatIsMissing) {
  const History history = parse_history(kText).history;
  EXPECT_THAT(history.column("time"), IsEmpty()) << "the unit belongs to the name";
  EXPECT_TRUE(std::isnan(history.last("time")));
  EXPECT_TRUE(std::isnan(parse_history("step\n").history.last("step")));
}

TEST(RunHistory, ARowThatIsBeingWrittenIsLeftOut) {
  const HistoryText read = parse_history(std::string(kText) + "20,2e-6,0.1");
  EXPECT_EQ(read.history.rows(), 2U) << "0.1 may be the beginning of 0.15";
  EXPECT_TRUE(read.is_cut);
  EXPECT_EQ(read.num_left_out, 0U);
}

TEST(RunHistory, ARowThatIsNotWholeIsLeftOutAsAWholeAndTheFirstIsReported) {
  const HistoryText read = parse_history(std::string(kText) + "20,2e-6\n30,x,1\n\n40,4e-6,2\n");
  EXPECT_THAT(read.history.column("step"), ElementsAre(0, 10, 40));
  for (const auto& column : read.history.columns) EXPECT_EQ(column.size(), 3U);
  EXPECT_EQ(read.num_left_out, 3U);
  EXPECT_EQ(read.first_left_out, 4U);
  EXPECT_THAT(read.problem, HasSubstr("2 numbers for 3 columns"));
  EXPECT_THAT(parse_history("a\n1x\n").problem, HasSubstr("'1x' is no number"));
}

TEST(RunHistory, AFieldThatIsNoNumberCanBeReadAsNan) {
  History history = parse_history("a,b\n").history;
  EXPECT_EQ(history.add_line("1,x", OddFields::read_as_nan), "");
  EXPECT_NE(history.add_line("1", OddFields::read_as_nan), "") << "no whole row";
  EXPECT_THAT(history.column("a"), ElementsAre(1));
  EXPECT_TRUE(std::isnan(history.last("b")));
}

TEST(RunHistory, OfAnEmptyFileHasNoColumns) {
  for (const char* text : {"", "step,time [s]"}) {
    const HistoryText read = parse_history(text);
    EXPECT_THAT(read.history.names, IsEmpty());
    EXPECT_EQ(read.history.rows(), 0U);
  }
  EXPECT_EQ(parse_history("step,time [s]\n").history.rows(), 0U);
}

class LastRow : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  [[nodiscard]] History last() const { return last_row_of(file_); }
  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "history.csv";
};

TEST_F(LastRow, IsTheLastThatIsWhole) {
  EXPECT_THAT(last().names, IsEmpty());
  write("step,x");
  EXPECT_THAT(last().names, IsEmpty());
  write("step,x\n");
  EXPECT_EQ(last().rows(), 0U);
  write("step,x\n0,1\n");
  EXPECT_THAT(last().column("x"), ElementsAre(1));
  write("step,x\n0,1\n1,2\n2,3.");
  EXPECT_THAT(last().column("x"), ElementsAre(2));
  write("step,x\n0,1\n1,2\nrubbish\n");
  EXPECT_THAT(last().column("x"), ElementsAre(2));
}

TEST_F(LastRow, OfALongFileIsFoundAtItsEnd) {
  std::string text = "step,x\n";
  for (int i = 0; i < 100000; ++i) text += std::to_string(i) + ",0.5\n";
  write(text);
  EXPECT_THAT(last().column("step"), ElementsAre(99999));
}

TEST_F(LastRow, OfManyColumnsIsFoundThoughItIsLong) {
  std::string header = "step", row = "7";
  for (int i = 0; i < 10000; ++i) {
    header += ",c";
    row += ",-1.2345678901234567e-100";
  }
  write(header + "\n" + row + "\n" + row + "\n");
  EXPECT_THAT(last().column("step"), ElementsAre(7));
}

TEST_F(LastRow, IsNotSoughtInAPipe) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(last().names, IsEmpty());
}

}  // namespace
}  // namespace breccia::run_folder::history_test
