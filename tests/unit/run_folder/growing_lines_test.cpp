#include "run_folder/growing_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "unit/output/temporary_folder.hpp"

namespace breccia::run_folder::growing_lines_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Growing : public testing::Test {
 protected:
  void append(const std::string& text) const { std::ofstream(file_, std::ios::app) << text; }
  void remove() const { std::filesystem::remove(file_); }
  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "status.jsonl";
};

TEST_F(Growing, ALineThatIsHalfWrittenWaitsForItsEnd) {
  GrowingLines lines(file_);
  EXPECT_THAT(lines.news().lines, IsEmpty());
  append("fir");
  EXPECT_THAT(lines.news().lines, IsEmpty());
  append("st\nsec");
  EXPECT_THAT(lines.news().lines, ElementsAre("first"));
  EXPECT_THAT(lines.news().lines, IsEmpty());
  append("ond\n\n");
  EXPECT_THAT(lines.news().lines, ElementsAre("second", ""));
}

TEST_F(Growing, AFileThatBeganAnewIsReadFromItsStart) {
  GrowingLines lines(file_);
  append("step,time [s]\n1,2\n");
  EXPECT_EQ(lines.news().lines.size(), 2U);
  remove();
  append("a\n");
  const GrowingLines::News news = lines.news();
  EXPECT_THAT(news.lines, ElementsAre("a"));
  EXPECT_TRUE(news.is_restarted);
  EXPECT_FALSE(lines.news().is_restarted);
}

TEST_F(Growing, AFileThatIsAnotherOneIsReadFromItsStartThoughItIsLonger) {
  GrowingLines lines(file_);
  append("one\nstopped\n");
  EXPECT_EQ(lines.news().lines.size(), 2U);
  remove();
  append("one\ntwo\nthree\nfour\n");
  const GrowingLines::News news = lines.news();
  EXPECT_EQ(news.lines.size(), 4U);
  EXPECT_TRUE(news.is_restarted);
}

TEST_F(Growing, OfALongFileTheTailIsReadByWholeLines) {
  append("first line\nsecond\nthird\n");
  GrowingLines lines(file_, 15);  // the cut goes through the first line
  EXPECT_THAT(lines.news().lines, ElementsAre("second", "third"));
  append("fourth\n");
  EXPECT_THAT(lines.news().lines, ElementsAre("fourth"));
  EXPECT_THAT(GrowingLines(file_, 7).news().lines, ElementsAre("fourth")) << "the tail begins with a line";
  EXPECT_THAT(GrowingLines(file_, 0).news().lines, IsEmpty());
}

TEST_F(Growing, ALongFileIsReadPieceByPiece) {
  constexpr int kLines = 300000;
  std::string text;
  for (int i = 0; i < kLines; ++i) text += std::to_string(i) + "\n";
  append(text);
  GrowingLines lines(file_);
  int found = 0, calls = 0;
  do {
    for (const std::string& line : lines.news().lines) EXPECT_EQ(line, std::to_string(found++));
    ++calls;
  } while (lines.has_more());
  EXPECT_EQ(found, kLines);
  EXPECT_GT(calls, 1);
}

TEST_F(Growing, ALineLongerThanAPieceIsReadWhole) {
  append(std::string(3 << 20, 'x') + "\nnext\n");
  GrowingLines lines(file_);
  const GrowingLines::News news = lines.news();
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_EQ(news.lines[0].size(), std::size_t{3} << 20);
  EXPECT_TRUE(lines.has_more());
  EXPECT_THAT(lines.news().lines, ElementsAre("next"));
}

TEST_F(Growing, AFileWithoutLinesIsReadNoFurther) {
  append("x");
  std::filesystem::resize_file(file_, std::uintmax_t{1} << 40);  // sparse: it has no line
  GrowingLines lines(file_), tail(file_, kStatusTail);
  EXPECT_THAT(lines.news().lines, IsEmpty());
  EXPECT_THAT(tail.news().lines, IsEmpty());
  EXPECT_FALSE(lines.has_more() || tail.has_more());
}

TEST_F(Growing, NoLinkIsFollowedAndNoPipeWaitedFor) {
  std::ofstream(folder_ / "outside") << "secret\n";
  std::filesystem::create_symlink(folder_ / "outside", file_);
  EXPECT_THAT(GrowingLines(file_).news().lines, IsEmpty());
  remove();
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(GrowingLines(file_).news().lines, IsEmpty());
}

}  // namespace
}  // namespace breccia::run_folder::growing_lines_test
