#include "output/folder/race_progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace breccia::race_progress_test {
namespace {

using testing::HasSubstr;

TEST(RaceProgress, TellsTheTimeToGoFromTheTimeGone) {
  std::ostringstream json, log;
  RaceProgress(ProgressMode::json, json, 80).show({"repetitions", 0.25, 10.0});
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(json.str())["eta_s"].get<double>(), 30.0);
  RaceProgress(ProgressMode::log, log, 80).show({"repetitions", 0.25, 10.0});
  EXPECT_THAT(log.str(), HasSubstr("25.0 %  repetitions  30 s to go"));
}

TEST(RaceProgress, DoesNotKnowTheTimeToGoAtTheStart) {
  std::ostringstream json;
  RaceProgress(ProgressMode::json, json, 80).show({"repetitions", 0.0, 10.0});
  EXPECT_TRUE(nlohmann::json::parse(json.str())["eta_s"].is_null());
}

TEST(RaceProgress, ABarIsTakenAwayAtTheEnd) {
  std::ostringstream bar;
  RaceProgress progress(ProgressMode::bar, bar, 30);
  progress.show({"repetitions", 0.5, 10.0});
  EXPECT_LE(bar.str().size(), 4u + 29u) << "a line as long as the terminal would wrap";
  progress.finish();
  EXPECT_THAT(bar.str(), testing::EndsWith("\r\033[K"));
}

}  // namespace
}  // namespace breccia::race_progress_test
