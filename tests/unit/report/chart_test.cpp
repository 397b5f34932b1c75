#include "report/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace breccia::report::chart_test {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Charts, TellInWordsWhatTheyShow) {
  const std::string svg =
      svg_of({"Speed", "time", "s", "speed", "m/s", false, false, false, {{"a<b", {0, 1}, {0, 4}}}});
  EXPECT_TRUE(has(svg, "<title>Speed</title>")) << svg;
  EXPECT_TRUE(has(svg, "speed from 0 m/s to 4 m/s, time from 0 s to 1 s. Shown: a&lt;b.")) << svg;
}

TEST(Charts, WithNothingToShowAreEmpty) {
  EXPECT_EQ(svg_of({"", "x", "", "y", "", false, false, false, {}}), "");
  EXPECT_EQ(svg_of({"", "x", "", "y", "", false, false, false, {{"a", {1}, {std::nan("")}}}}), "");
  EXPECT_EQ(svg_of({"", "x", "", "y", "", false, true, false, {{"a", {1}, {0}}}}), "");
}

TEST(Charts, LeaveGapsWhereThereAreNoNumbers) {
  const std::string svg =
      svg_of({"", "x", "", "y", "", false, false, false, {{"a", {0, 1, 2, 3, 4}, {1, 2, std::nan(""), 2, 1}}}});
  const std::size_t line = svg.find("stroke-width=\"1.7\"");
  const std::size_t start = svg.rfind("<path", line);
  EXPECT_EQ(count(svg.substr(start, line - start), "M"), 2U);
  EXPECT_FALSE(has(svg, "nan"));
}

TEST(Charts, ThinnedLinesKeepTheirExtremes) {
  Series series{"a", {}, {}};
  for (int i = 0; i < 100000; ++i) {
    series.x.push_back(i);
    series.y.push_back(i == 54321 ? 7.0 : i == 54322 ? -3.0 : 0.0);
  }
  const std::string svg = svg_of({"", "x", "", "y", "", false, false, false, {series}});
  EXPECT_LT(svg.size(), 40000U);
  // The axis goes from -4 to 8: 7 stands at 1/12 of the height of 230 below the top at 10, -3 at 11/12.
  EXPECT_TRUE(has(svg, " 29.2")) << svg.substr(0, 2000);
  EXPECT_TRUE(has(svg, " 220.8"));
}

TEST(Charts, StackTheirAreas) {
  const std::string svg = svg_of({"",
                                  "x",
                                  "",
                                  "y",
                                  "",
                                  false,
                                  false,
                                  true,
                                  {{"a", {0, 1}, {1, 1}}, {"b", {0, 1}, {1, 3}}, {"r", {0, 1}, {2, 4}, false, true}}});
  // Areas end where the reference line stands: at 2 and 4 of an axis up to 4.
  EXPECT_EQ(count(svg, "fill-opacity"), 2U);
  EXPECT_TRUE(has(svg, "M62.0 150.0L846.0 10.0L846.0 220.0L62.0 220.0Z")) << svg;
  EXPECT_TRUE(has(svg, "M62.0 150.0L846.0 10.0\""));
}

TEST(Bars, AreAsLongAsTheirShare) {
  EXPECT_TRUE(has(bar(0.5), "width=\"60.0\""));
  EXPECT_TRUE(has(bar(7), "width=\"120.0\""));
  EXPECT_TRUE(has(bar(std::nan("")), "width=\"0.0\""));
}

}  // namespace
}  // namespace breccia::report::chart_test
