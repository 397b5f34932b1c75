#include "output/insitu/trigger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace breccia::trigger_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kEnd = 1e-3;  // s, of a run of 1000 steps

/// Steps of the run at which a trigger is due. @param broken  joints in each step; none when empty
std::vector<std::int64_t> due_steps(const case_::Pipeline& pipeline, const std::vector<std::int64_t>& broken = {},
                                    std::int64_t steps = 1000) {
  Trigger trigger(pipeline, kEnd);
  std::vector<std::int64_t> due;
  for (std::int64_t step = 0; step < steps; ++step) {
    const std::int64_t count = broken.empty() ? 0 : broken[std::min(static_cast<std::size_t>(step), broken.size() - 1)];
    if (trigger.due({step, 1e-6 * static_cast<double>(step), 1e-6, count})) due.push_back(step);
  }
  return due;
}

TEST(Trigger, WithoutAnyRunsFiftyTimes) {
  const auto due = due_steps({});
  EXPECT_EQ(due.size(), 50u);
  EXPECT_EQ(due.front(), 0);
  EXPECT_EQ(due[1], 20);
}

TEST(Trigger, WithoutAnyRunsFiftyTimesOverARunThatStartsLate) {
  Trigger trigger({}, kEnd);
  trigger.start_from({900, 0.9 * kEnd, 1e-6, 0}, kEnd, 0);
  EXPECT_DOUBLE_EQ(trigger.distance(1e-6), 2e-6);
  int times = 0;
  for (std::int64_t step = 900; step < 1000; ++step)
    times += trigger.due({step, 1e-6 * static_cast<double>(step), 1e-6, 0}) ? 1 : 0;
  EXPECT_EQ(times, 50);
}

TEST(Trigger, BySteps) {
  case_::Pipeline pipeline;
  pipeline.every_steps = 400;
  EXPECT_THAT(due_steps(pipeline), ElementsAre(0, 400, 800));
}

TEST(Trigger, BySimulatedTime) {
  case_::Pipeline pipeline;
  pipeline.every_time = 2.5e-4;
  EXPECT_THAT(due_steps(pipeline), ElementsAre(0, 250, 500, 750));
}

TEST(Trigger, ByTheFirstBreakAlone) {
  case_::Pipeline pipeline;
  pipeline.first_break = true;
  EXPECT_THAT(due_steps(pipeline, {0, 0, 0, 2, 2, 9}), ElementsAre(3));
  EXPECT_THAT(due_steps(pipeline), IsEmpty());
}

TEST(Trigger, ByBrokenJointsCountsFromOneMultipleToTheNext) {
  case_::Pipeline pipeline;
  pipeline.every_broken = 10;
  EXPECT_THAT(due_steps(pipeline, {0, 9, 10, 11, 19, 45, 49, 50, 50}), ElementsAre(2, 5, 7));
}

TEST(Trigger, CountsBreaksFromTheStartOfTheRun) {
  case_::Pipeline pipeline;
  pipeline.first_break = true;
  const Moment first{100, 1e-4, 1e-6, 7};
  Trigger started(pipeline, kEnd), resumed(pipeline, kEnd);
  started.start_from(first, kEnd, 7);
  EXPECT_FALSE(started.due({101, 1.01e-4, 1e-6, 7})) << "broken before";
  EXPECT_TRUE(started.due({102, 1.02e-4, 1e-6, 8}));
  resumed.start_from(first, kEnd, 8);
  EXPECT_FALSE(resumed.due({103, 1.03e-4, 1e-6, 9})) << "not the first";
}

TEST(Trigger, ByBrokenJointsGoesOnFromTheOnesThatAreKnown) {
  case_::Pipeline pipeline;
  pipeline.every_broken = 10;
  Trigger trigger(pipeline, kEnd);
  trigger.start_from({100, 1e-4, 1e-6, 7}, kEnd, 23);
  EXPECT_FALSE(trigger.due({101, 1.01e-4, 1e-6, 29}));
  EXPECT_TRUE(trigger.due({102, 1.02e-4, 1e-6, 30}));
}

TEST(Trigger, ByWallTimeIsNobodysBusinessHere) {
  case_::Pipeline pipeline;
  pipeline.every_wall = 1;
  EXPECT_THAT(due_steps(pipeline), IsEmpty());
}

TEST(Trigger, KnowsTheDistanceOfItsInstants) {
  case_::Pipeline pipeline;
  EXPECT_DOUBLE_EQ(Trigger(pipeline, kEnd).distance(1e-6), 2e-5);
  pipeline.every_steps = 400;
  EXPECT_DOUBLE_EQ(Trigger(pipeline, kEnd).distance(1e-6), 4e-4);
  pipeline.every_time = 1e-4;
  EXPECT_DOUBLE_EQ(Trigger(pipeline, kEnd).distance(1e-6), 1e-4);
  EXPECT_TRUE(Trigger(pipeline, kEnd).is_regular());
  pipeline.first_break = true;
  EXPECT_FALSE(Trigger(pipeline, kEnd).is_regular());
}

TEST(Trigger, NeedsTheCountOnlyWhileItMatters) {
  case_::Pipeline pipeline;
  pipeline.first_break = true;
  Trigger trigger(pipeline, kEnd);
  EXPECT_TRUE(trigger.counts_broken());
  EXPECT_TRUE(trigger.due({5, 5e-6, 1e-6, 3}));
  EXPECT_FALSE(trigger.counts_broken());
}

TEST(Overhead, TakesForItsStartWhatTheFirstTimeTookBeyondTheSecond) {
  Overhead overhead(0.02);
  EXPECT_TRUE(overhead.allows(0));
  overhead.account(5);
  EXPECT_EQ(overhead.spent(), 0);
  EXPECT_EQ(overhead.start(), 5);
  EXPECT_EQ(overhead.cost(), 0) << "not known";
  overhead.account(0.5);
  EXPECT_EQ(overhead.spent(), 1);
  EXPECT_EQ(overhead.start(), 4.5);
  EXPECT_EQ(overhead.cost(), 0.5);
}

TEST(Overhead, CountsTimeInWhichItWasNotDone) {
  Overhead overhead(0.02);
  overhead.account_idle(0.25);
  EXPECT_EQ(overhead.spent(), 0.25);
  EXPECT_EQ(overhead.times(), 0);
}

TEST(Overhead, StaysBelowItsShare) {
  constexpr double kShare = 0.02, kCost = 0.3;
  Overhead overhead(kShare);
  overhead.account(4);
  std::int64_t times = 0;
  for (double wall = 0; wall < 100; wall += 0.1) {
    if (!overhead.allows(wall)) continue;
    overhead.account(kCost);
    ++times;
    EXPECT_LE(overhead.spent(), kShare * wall + 2 * kCost);  // what a time costs is known after two
  }
  EXPECT_EQ(times, 5);  // 2 % of 100 s are 2 s, of which the first time took as much as the others
}

}  // namespace
}  // namespace breccia::trigger_test
