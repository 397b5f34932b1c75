#include "commands/race_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace breccia::race_report_test {
namespace {

using testing::HasSubstr;
using enum case_::DetectionAlgorithm;

RaceEntry entry(case_::DetectionAlgorithm algorithm, double wall, bool as_in_case) {
  RaceEntry made{{algorithm, 0.001, as_in_case}, {}};
  made.least.wall = wall;
  made.least.searches = 1;
  made.least.used = 1;
  return made;
}

/// 1000 elements, 100 steps; a search of 0.8 s before one of 1 s.
RaceResult race(bool best_as_in_case) {
  RaceResult result;
  result.title = "a race";
  result.elements = 1000;
  result.steps = 100;
  result.rounds = 3;
  result.entries = {entry(ms, 0.8, best_as_in_case), entry(sorted_grid, 1.0, !best_as_in_case)};
  return result;
}

TEST(RaceReport, TellsHowMuchLessTimeAStepTakesThanAsInTheCase) {
  EXPECT_THAT(race_table(race(false)), HasSubstr("a step takes 20.0 % less time than as in the case"));
  EXPECT_THAT(race_table(race(true)), HasSubstr("best: ms, buffer 0.001 m, as in the case"));
}

TEST(RaceReport, CountsTheElementsOfAllStepsInASpeed) {
  EXPECT_THAT(race_table(race(false)), HasSubstr("125,000")) << "1000 x 100 / 0.8 s";
  EXPECT_THAT(race_csv(race(false)), HasSubstr(",125000,100,"));
  EXPECT_THAT(race_json(race(false)), HasSubstr("\"element_steps_per_s\":125000,"));
}

}  // namespace
}  // namespace breccia::race_report_test
