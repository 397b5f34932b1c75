#include "mesh/geo_scan.hpp"

#include <gtest/gtest.h>

#include <array>

#include "sample_meshes.hpp"

namespace breccia::geo_scan_test {
namespace {

GeoScan scan_text(const std::string& text) {
  return scan_geo(test::write_file(test::scratch_folder("scan") / "script.geo", text));
}

using Names = std::set<std::string>;

TEST(GeoScan, FindsConstantsThatKeepAValueSetBefore) {
  EXPECT_EQ(
      scan_text("DefineConstant[ length = 1, h = {0.5, Name \"Parameters/h\", Choices{1, width}}, count ];").constants,
      (Names{"length", "h", "count"}));
  EXPECT_EQ(scan_text("DefineConstant ( a = (b + c) * 2, d = Sin[e] );").constants, (Names{"a", "d"}));
  EXPECT_EQ(scan_text("If (!Exists(radius))\n radius = 2;\nEndIf\nIf(Exists[gap]) x = gap; EndIf").constants,
            (Names{"radius", "gap"}));
  EXPECT_EQ(scan_text("length = 1; DefineFunction[x];").constants, Names{});
}

TEST(GeoScan, FindsOnelabNames) {
  EXPECT_EQ(scan_text("h = DefineNumber[ 0.5, Name \"Parameters/h\" ]; n = {1, Name 'Other/n'};").onelab_names,
            (Names{"Parameters/h", "Other/n"}));
}

/// Name, label, value and words of each.
using Row = std::array<std::string, 4>;
std::vector<Row> rows_of(const std::string& text) {
  std::vector<Row> rows;
  for (const GeoParameter& p : scan_text(text).parameters) rows.push_back({p.name, p.label, p.value, p.words});
  return rows;
}

TEST(GeoScan, TellsValuesAndCommentsOfParametersInTheirOrder) {
  const std::vector<Row> found = rows_of(
      "DefineConstant[\n  width = 0.050,   // of the plate\n  h = {1e-3, Name \"Mesh/h\", Min 0}, /* element size */\n"
      "  far = 4*h,\n  n,  // how many\n  a = 1, b = (2 + 3) / 2  // both last\n];\nm = DefineNumber[3, Name \"m\"];\n"
      "If (!Exists(gap))\n  gap = 1;\nEndIf\nDefineConstant[ width = 2 ];");
  EXPECT_EQ(found, (std::vector<Row>{{"width", "", "0.050", "of the plate"},
                                     {"h", "Mesh/h", "1e-3", "element size"},
                                     {"far", "", "4*h", ""},
                                     {"n", "", "", "how many"},
                                     {"a", "", "1", ""},
                                     {"b", "", "(2 + 3) / 2", "both last"},
                                     {"", "m", "", ""},
                                     {"gap", "", "", ""}}));
  EXPECT_EQ(rows_of("DefineConstant[ a = 1 ]; // of all"), (std::vector<Row>{{"a", "", "1", "of all"}}));
  EXPECT_EQ(rows_of("DefineConstant[ a = {2"), (std::vector<Row>{{"a", "", "2", ""}}));
  EXPECT_EQ(rows_of("DefineConstant[ a = "), (std::vector<Row>{{"a", "", "", ""}}));
}

TEST(GeoScan, SkipsCommentsAndTexts) {
  const GeoScan scan = scan_text(
      "// DefineConstant[ a = 1 ];\n/* Exists(b)\n Exit; */ Printf(\"Exists(c) /* Exit\");\nDefineConstant[ d = 1e-3 "
      "];");
  EXPECT_EQ(scan.constants, (Names{"d"}));
  EXPECT_TRUE(scan.problems.empty());
}

TEST(GeoScan, FollowsIncludedFilesOnce) {
  const auto folder = test::scratch_folder("scan_include");
  std::filesystem::create_directories(folder / "parts");
  test::write_file(folder / "parts" / "a.geo", "DefineConstant[ a = 1 ]; Include \"b.geo\";");
  test::write_file(folder / "parts" / "b.geo", "DefineConstant[ b = 1 ]; Include \"a.geo\";");
  const auto main = test::write_file(folder / "main.geo", "Include \"parts/a.geo\"; Include \"missing.geo\";");
  EXPECT_EQ(scan_geo(main).constants, (Names{"a", "b"}));
}

TEST(GeoScan, RefusesIncludedFoldersWithTheLineThatNamesThem) {
  const GeoScan scan = scan_text("Include \"\";\nMerge \"/\";\nInclude \"..\";\nMerge \"part.stl\";\n");
  ASSERT_EQ(scan.problems.size(), 3u);
  EXPECT_EQ(scan.problems[1].line, 2);
  EXPECT_EQ(scan.problems[1].key, "Merge");
  EXPECT_EQ(scan.problems[1].what, "/ is a folder");
}

TEST(GeoScan, RefusesMoreThanAScriptHolds) {
  const auto folder = test::scratch_folder("scan_large");
  const auto large = test::write_file(folder / "large.geo", "");
  std::filesystem::resize_file(large, 100'000'000'000);
  ASSERT_EQ(scan_geo(large).problems.size(), 1u);
  EXPECT_NE(scan_geo(large).problems[0].what.find("is larger (100 GB) than such a file may be"), std::string::npos);
  for (int i = 0; i < 1001; ++i)
    test::write_file(folder / (std::to_string(i) + ".geo"), "Include \"" + std::to_string(i + 1) + ".geo\";\n");
  const GeoScan chain = scan_geo(folder / "0.geo");
  ASSERT_EQ(chain.problems.size(), 1u);
  EXPECT_NE(chain.problems[0].what.find("more than 1000 files"), std::string::npos);
}

TEST(GeoScan, RefusesStatementsThatRunProgramsOrEndTheProcessSomewhere) {
  const GeoScan scan = scan_text("Point(1) = {0, 0, 0};\n/* two\nlines */ SystemCall \"ls\";\nIf (1)\nExit;\nEndIf\n");
  ASSERT_EQ(scan.problems.size(), 2u);
  EXPECT_EQ(scan.problems[0].line, 3);
  EXPECT_EQ(scan.problems[0].key, "SystemCall");
  EXPECT_EQ(scan.problems[1].line, 5);
}

TEST(GeoScan, EndsAtAnUnfinishedTextCommentOrBracket) {
  EXPECT_EQ(scan_text("DefineConstant[ a = 1, b = {2").constants, (Names{"a", "b"}));
  EXPECT_EQ(scan_text("DefineConstant[ a = 1 ]; /* never closed").constants, (Names{"a"}));
  EXPECT_EQ(scan_text("DefineConstant[ a = 1 ]; Printf(\"never closed").constants, (Names{"a"}));
  EXPECT_EQ(scan_text("Exists").constants, Names{});
  EXPECT_EQ(scan_text("").constants, Names{});
}

}  // namespace
}  // namespace breccia::geo_scan_test
