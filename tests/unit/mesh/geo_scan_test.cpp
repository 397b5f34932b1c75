#include "mesh/geo_scan.hpp"

#include <gtest/gtest.h>

#include "sample_meshes.hpp"

namespace breccia {
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

TEST(GeoScan, PassesOverIncludedFoldersAndPipes) {
  EXPECT_TRUE(scan_text("Include \"\"; Merge \"/\"; Include \"..\";").problems.empty());
}

TEST(GeoScan, RefusesStatementsThatRunProgramsOrEndTheProcess) {
  const GeoScan scan = scan_text("Point(1) = {0, 0, 0};\n/* two\nlines */ SystemCall \"ls\";\n\nExit;\n");
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
}  // namespace breccia
