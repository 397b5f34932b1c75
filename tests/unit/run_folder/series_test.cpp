#include "run_folder/series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace breccia::run_folder::series_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FrameSeries, ListsFramesWithTheirTimes) {
  const Series series = parse_series(
      R"({"file-series-version": "1.0", "files": [{"name": "e_0.vtkhdf", "time": 0.5},
      {"name": "e_1.vtkhdf", "time": 1}]})");
  ASSERT_EQ(series.frames.size(), 2U);
  EXPECT_EQ(series.frames[0].name, "e_0.vtkhdf");
  EXPECT_EQ(series.frames[0].time, 0.5);
  EXPECT_EQ(series.frames[1].time, 1);
  EXPECT_THAT(series.refused, IsEmpty());
}

TEST(FrameSeries, RefusesFilesOutsideItsFolderAndEntriesThatAreNotWhole) {
  const Series series = parse_series(
      R"({"files": [{"name": "../a", "time": 1}, {"name": "/b", "time": 1}, {"name": "..", "time": 1}, {"time": 1},
      {"name": "c"}, {"name": "d", "time": "1"}, {"name": 5, "time": 1}, 7, null, {"name": "e", "time": 2}]})");
  ASSERT_EQ(series.frames.size(), 1U);
  EXPECT_EQ(series.frames[0].name, "e");
  EXPECT_THAT(series.refused, ElementsAre("../a", "/b", "..", "", "c", "d", "", "", ""));
}

TEST(FrameSeries, OfWhatIsNoIndexIsEmpty) {
  for (const std::string& text :
       {std::string(), std::string("{\"files\": [{\"name\": \"a\", \"ti"), std::string("[1, 2]"),
        std::string("{\"files\": 3}"), std::string("{}"), std::string("\xff\xfe"), std::string(100000, '[')}) {
    const Series series = parse_series(text);
    EXPECT_TRUE(series.frames.empty() && series.refused.empty()) << text.substr(0, 40);
  }
}

}  // namespace
}  // namespace breccia::run_folder::series_test
