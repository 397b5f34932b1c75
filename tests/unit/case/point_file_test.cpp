#include "case/point_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "case_files.hpp"

namespace breccia::case_::point_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Times in s, values in Pa, columns 1 and 2.
PointFile source(const std::filesystem::path& file) {
  PointFile source;
  source.file = file;
  source.time.number = 1;
  source.value.number = 2;
  source.si_unit = "Pa";
  return source;
}

std::vector<std::pair<double, double>> pairs(const std::vector<TimeFunction::Point>& points) {
  std::vector<std::pair<double, double>> pairs;
  for (const TimeFunction::Point& p : points) pairs.emplace_back(p.time, p.value);
  return pairs;
}

std::vector<std::pair<double, double>> points_of(const std::string& text) {
  const CaseFolder folder;
  return pairs(read_points(source(folder.write("points.csv", text))));
}

std::string refusal(const PointFile& source) {
  try {
    (void)read_points(source);
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().size(), 1u);
    return e.what();
  }
  return "nothing refused";
}

std::string refusal(const std::string& text) {
  const CaseFolder folder;
  return refusal(source(folder.write("points.csv", text)));
}

const auto kTwo = ElementsAre(std::pair(0.0, 1.0), std::pair(0.5, -2.0));

TEST(PointFile, IsReadWithWhateverSeparatesItsColumns) {
  for (const std::string text :
       {"0,1\n0.5,-2\n", "0;1\n0.5;-2\n", "0\t1\n0.5\t-2\n", "0 1\n0.5   -2\n", "  0  1  \n\t.5 -2.",
        "0 , 1\n0.5 , -2\n", "sep=|\n0|1\n0.5|-2\n", "0;1;\n0.5;-2;\n", "0,1\r\n0.5,-2\r\n", "0,1\r0.5,-2\r",
        "\n\n0,1\n\n0.5,-2\n\n",
        "\xef\xbb\xbf"
        "0,1\n0.5,-2\n",
        "# t, p\n0,1\n% half\n! way\n5e-1,-2E0\n", "\"0\",\"1\"\n'0.5','-2'\n", "+0,+1\n+.5,-2\n", "0,1,9\n0.5,-2\n"})
    EXPECT_THAT(points_of(text), kTwo) << text;
}

TEST(PointFile, HasAHeaderOrNone) {
  for (const std::string text : {"time,p\n0,1\n0.5,-2\n", "\"time\";\"p\"\n0;1\n0.5;-2\n", "time p\n0 1\n0.5 -2\n",
                                 "time [s]\tp [Pa]\n0\t1\n0.5\t-2\n", "t (ms), p (kPa)\n0,0.001\n500,-0.002\n",
                                 "t [ms] p [kPa]\n0 0.001\n500 -0.002\n", "t,\"p, of a face [Pa]\"\n0,1\n0.5,-2\n"})
    EXPECT_THAT(points_of(text), kTwo) << text;
}

TEST(PointFile, ColumnsAreNamedOrCounted) {
  const CaseFolder folder;
  PointFile file = source(folder.write("points.csv", "i;t [ms];a;p (kPa)\n1;0;7;0.001\n2;500;7;-0.002\n"));
  for (const auto& [time, value] : {std::pair("t", "p"), std::pair("t [ms]", "p (kPa)")}) {
    file.time.name = time;
    file.value.name = value;
    EXPECT_THAT(pairs(read_points(file)), kTwo);
  }
  file.time = {"", 2, "ms"};
  file.value = {"", 4, ""};
  EXPECT_THAT(pairs(read_points(file)), kTwo);
  file.value.name = "q";
  EXPECT_THAT(refusal(file), HasSubstr("points.csv:1: has no column of that name in its first line; allowed: "));
  file.value = {"", 5, ""};
  EXPECT_THAT(refusal(file), HasSubstr("points.csv:1: has no column 5; allowed: columns 1 to 4"));
  file = source(folder.write("twice.csv", "t,p,p\n0,1,2\n"));
  file.value.name = "p";
  EXPECT_THAT(refusal(file), HasSubstr("twice.csv:1: has two columns of one name"));
}

TEST(PointFile, UnitsAreExactAsInTheCaseAndFit) {
  const CaseFolder folder;
  PointFile file = source(folder.write("points.csv", "10,3\n20,4\n"));
  file.time.unit = "us";
  file.value.unit = "MPa";
  EXPECT_THAT(pairs(read_points(file)), ElementsAre(std::pair(1e-5, 3e6), std::pair(2e-5, 4e6)));
  file.scale = -2;
  file.start = 1;
  EXPECT_THAT(pairs(read_points(file)), ElementsAre(std::pair(1 + 1e-5, -6e6), std::pair(1 + 2e-5, -8e6)));
  file.value.unit = "mm";
  EXPECT_THAT(refusal(file), HasSubstr("the unit of column 2 is of dimension length, not pressure"));
  file.value.unit = "Mpa";
  EXPECT_THAT(refusal(file), HasSubstr("did you mean \"MPa\""));
  file = source(folder.write("stated.csv", "t [ms],p [msec]\n0,1\n"));
  EXPECT_THAT(refusal(file), HasSubstr("stated.csv:1: the unit of column 2 unknown unit \"msec\""));
  file.value.unit = "kPa";
  file.time.unit = "s";
  EXPECT_THAT(refusal(file), HasSubstr("the header states another unit of column 1 than the case"));
  file.time.unit = "ms";
  EXPECT_THAT(pairs(read_points(file)), ElementsAre(std::pair(0.0, 1e3)));
}

TEST(PointFile, NumbersTooSmallForFullPrecisionAreZero) {
  EXPECT_THAT(points_of("0,1e-320\n1,-4e-310\n2,1e-999\n"),
              ElementsAre(std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(2.0, 0.0)));
}

TEST(PointFile, WhatIsWrongIsRefusedWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"0;0,5\n1;0,7\n", "points.csv:1: column 2 has a decimal comma; allowed: decimal points: 1.5; given: 0,5"},
      {"0,0\t1,5\n0,1\t2\n", "points.csv:1: column 1 has a decimal comma"},
      {"0,1\n0,5,-2\n", "points.csv:2: has 3 columns, line 1 has 2"},
      {"0,0 1,5\n0,1 2,5\n", "points.csv:1: column 2 is no number"},
      {"0,1\n1\n", "points.csv:2: has no column 2"},
      {"0,1\n1,\n", "points.csv:2: has no column 2"},
      {"t,p\n0,1\n1,two\n", "points.csv:3: column 2 is no number; allowed: numbers with decimal points"},
      {"t,p\ns,Pa\n0,1\n", "points.csv:2: column 1 is no number"},
      {"0,1\n0,2\n", "points.csv:2: is not later than the line before; allowed: times increasing"},
      {"0,1\n1,2\n\n0.5,3\n", "points.csv:4: is not later"},
      {"0,nan\n", "points.csv:1: column 2 is not finite"},
      {"inf,1\n", "points.csv:1: column 1 is not finite"},
      {"0,1e999\n", "points.csv:1: column 2 is not finite"},
      {"0,0x10\n", "points.csv:1: column 2 is no number"},
      {"0,1.5D+00\n", "points.csv:1: column 2 is no number"},
      {"0,\"1,234.5\"\n", "points.csv:1: column 2 is no number"},
      {"2024-01-01,1\n", "points.csv:1: column 1 is no number"},
      {"", "points.csv: has no line of numbers"},
      {"t,p\n", "points.csv: has no line of numbers"},
      {"# nothing\n", "points.csv: has no line of numbers"},
      {"1\n2\n", "points.csv:1: has no column 2; allowed: columns 1 to 1"},
      {std::string("0,1\n") + '\0', "points.csv: is no text: it holds characters 0"},
      {"\xff\xfe"
       "0",
       "points.csv: is UTF-16 text"}};
  for (const auto& [text, message] : wrong) EXPECT_THAT(refusal(text), HasSubstr(message)) << text;
}

TEST(PointFile, ThatIsNoFileOrTooLargeIsRefusedAtOnce) {
  const CaseFolder folder;
  EXPECT_THAT(refusal(source(folder.path() / "nowhere.csv")), HasSubstr("the file does not exist"));
  EXPECT_THAT(refusal(source(folder.path())), HasSubstr("is a folder"));
  const std::filesystem::path pipe = folder.path() / "pipe.csv", sparse = folder.write("sparse.csv", "");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal(source(pipe)), HasSubstr("is no ordinary file"));
  EXPECT_THAT(refusal(source("/dev/zero")), HasSubstr("is no ordinary file"));
  std::filesystem::resize_file(sparse, 1ULL << 40U);
  EXPECT_THAT(refusal(source(sparse)), HasSubstr("is too large; allowed: at most 64 MiB"));
  std::string many;
  for (std::size_t i = 0; i <= kMostPoints; ++i) many += std::to_string(i) + ",1\n";
  EXPECT_THAT(refusal(many), HasSubstr("points.csv:100001: the file has too many lines; allowed: at most 100000"));
}

const std::string kLoad = minimal + "[[stage.pressure]]\nsurface = \"raster.x0\"\nvalue = ";

TEST(PointFile, IsAPartOfAFunctionOfTimeAndStandsInTheResolvedCase) {
  const CaseFolder folder;
  folder.write("p.csv", "t [ms];p [kPa]\n0;1\n0.3;2\n0.7;0.1\n");
  const std::string text = kLoad + "{ constant = 5, csv = { file = \"p.csv\", scale = 3 } }\n";
  const Case c = read_case(folder.write("case.toml", text));
  const TimeFunction& f = c.stages[0].pressures[0].value;
  EXPECT_EQ(f(0), 3005);
  EXPECT_EQ(f(1), 3 * 100 + 5);
  ASSERT_EQ(c.data.files.size(), 1u);
  const DataFiles::One& one = c.data.files[0];
  EXPECT_EQ(one.file, folder.path() / "p.csv");
  EXPECT_EQ(one.key, "stage[0].pressure[0].value");
  EXPECT_EQ(one.num_points, 3u);
  EXPECT_EQ(one.largest, 6000);
  const Case again = read_text(c.resolved);  // in a folder without the file
  EXPECT_EQ(again.stages[0].pressures[0].value, f) << "the same bits";
}

TEST(PointFile, AddsUpWithOthersOfAList) {
  const CaseFolder folder;
  folder.write("a.csv", "0,1\n1,2\n");
  const Case c = read_case(folder.write(
      "case.toml", kLoad + "{ csv = [{ file = \"a.csv\" }, { file = \"a.csv\", time = 1, value = 1, start = 1 }] }\n"));
  EXPECT_EQ(c.stages[0].pressures[0].value(0.5), 1.5);
  EXPECT_EQ(c.stages[0].pressures[0].value(9), 3);
}

TEST(PointFile, MessagesNameTheKeyAndTheFile) {
  const CaseFolder folder;
  folder.write("bad.csv", "0,1\n1,x\n");
  const auto message = [&](const std::string& value) {
    try {
      (void)read_case(folder.write("case.toml", kLoad + value + "\n"));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("{ csv = { file = \"bad.csv\" } }"),
              HasSubstr("bad.csv:2: stage[0].pressure[0].value.csv: column 2 is no number"));
  EXPECT_THAT(message("{ csv = { file = \"gone.csv\" } }"),
              HasSubstr("case.toml:13: stage[0].pressure[0].value.csv.file: the file does not exist"));
  EXPECT_THAT(message("{ csv = { } }"), HasSubstr("stage[0].pressure[0].value.csv.file: is missing"));
  EXPECT_THAT(message("{ csv = \"bad.csv\" }"), HasSubstr("value.csv: is text; allowed: a table of file, time, value"));
  EXPECT_THAT(message("{ csv = { file = \"bad.csv\", column = 3 } }"), HasSubstr("value.csv.column: unknown key"));
  EXPECT_THAT(message("{ csv = { file = \"bad.csv\", value = 0 } }"), HasSubstr("value.csv.value: is out of range"));
  EXPECT_THAT(message("{ csv = { file = \"bad.csv\", value = \"\" } }"), HasSubstr("value.csv.value: is empty"));
  EXPECT_THAT(message("{ csv = { file = \"bad.csv\", value = 1.5 } }"), HasSubstr("value.csv.value: is a number"));
}

}  // namespace
}  // namespace breccia::case_::point_file_test
