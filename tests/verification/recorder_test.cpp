#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "verification/recorder.hpp"

namespace breccia::test::recorder_test {
namespace {

TEST(Recording, WithAResidualThatIsNoNumberPassesNoLimit) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Recording recording;
  for (const double residual : {1e-6, kNan, 2e-6}) {
    recording.rows.emplace_back();
    recording.rows.back().energy.residual_relative = residual;
  }
  EXPECT_TRUE(std::isnan(recording.worst_residual()));
  EXPECT_FALSE(recording.worst_residual() < 1e-3);
  recording.rows.erase(recording.rows.begin() + 1);
  EXPECT_EQ(recording.worst_residual(), 2e-6);
}

TEST(Recording, HasTheSameStepInLinesAndFramesOfAnInstantAndALineOfTheLastStep) {
  const Recording run = run_case_file("joint_pair/case_smoke.toml", {"output.frame_interval=0"});
  const double interval = run.rows.at(1).time * 1.5;  // neither every step nor a whole number of them
  const std::string text = std::to_string(interval);
  const Recording both =
      run_case_file("joint_pair/case_smoke.toml", {"output.frame_interval=" + text, "output.history_interval=" + text});
  std::size_t found = 0;
  for (const Frame& frame : both.frames) {
    for (const HistoryRow& row : both.rows) {
      if (row.time != frame.time) continue;
      EXPECT_EQ(row.step, frame.step);
      ++found;
    }
  }
  EXPECT_EQ(found, both.frames.size() - 1) << "all but the frame after the last step";
  for (const Recording* one : {&run, &both}) {
    EXPECT_EQ(one->rows.back().step, one->summary.steps - 1);
    EXPECT_EQ(one->rows.back().energy.kinetic, one->summary.energy.kinetic);
    EXPECT_LT(one->rows.at(one->rows.size() - 2).step, one->rows.back().step) << "not twice";
  }
}

}  // namespace
}  // namespace breccia::test::recorder_test
