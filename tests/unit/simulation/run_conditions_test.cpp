#include "simulation/run_conditions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/history_columns.hpp"
#include "simulation/run_stages.hpp"

namespace breccia::run_conditions_test {
namespace {

using Action = RunConditions::Action;

case_::Case with_stages(int stages) {
  case_::Case input;
  input.stages.resize(static_cast<std::size_t>(stages));
  for (std::size_t s = 0; s < input.stages.size(); ++s) {
    input.stages[s].end = static_cast<double>(s + 1);
    input.stages[s].gravity[0].table = {{static_cast<double>(s), 0}, {static_cast<double>(s + 1), 5}};
  }
  return input;
}

/// A line of the history in which so many joints are broken.
std::vector<double> line(double time, double broken) {
  const std::vector<case_::HistoryColumn> columns = case_::history_columns({}, {});
  std::vector<double> row(columns.size(), 0);
  row[0] = 100 * time;
  row[case_::kTimeColumn] = time;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].word() == "broken_joints") row[i] = broken;
  return row;
}

std::size_t fired(RunConditions& conditions, double time, double broken, std::size_t stage = 0) {
  return conditions.take(line(time, broken), stage).size();
}

case_::Case triggered(bool once) {
  case_::Case input = with_stages(1);
  input.triggers.push_back({"broken_joints > 5", case_::TriggerAction::frame, once, {}});
  return input;
}

TEST(RunConditions, FireWhenTheyBecomeTrue) {
  RunConditions conditions(triggered(false));
  EXPECT_EQ(fired(conditions, 0, 5), 0U);
  EXPECT_EQ(fired(conditions, 1, 6), 1U);
  EXPECT_EQ(fired(conditions, 2, 7), 0U) << "it is still true";
  EXPECT_EQ(fired(conditions, 3, 1), 0U);
  EXPECT_EQ(fired(conditions, 4, 9), 1U);
}

TEST(RunConditions, FireOnceWhereThatIsAsked) {
  RunConditions conditions(triggered(true));
  EXPECT_EQ(fired(conditions, 0, 6), 1U);
  EXPECT_EQ(fired(conditions, 1, 0), 0U);
  EXPECT_EQ(fired(conditions, 2, 6), 0U);
}

TEST(RunConditions, SayWhichWhenAndWithWhatValues) {
  RunConditions conditions(triggered(false));
  (void)fired(conditions, 1, 6);
  (void)fired(conditions, 2, 0);
  const std::vector<RunConditions::Fired> second = conditions.take(line(3, 8), 0);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].action, Action::frame);
  EXPECT_EQ(second[0].text, "trigger[0].when = \"broken_joints > 5\" is true at 3 s (broken_joints = 8): frame");
  const std::vector<ConditionReport> reports = conditions.reports();
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0].times, 2);
  EXPECT_EQ(reports[0].first_step, 100);
  EXPECT_EQ(reports[0].first_time, 1);
  EXPECT_EQ(reports[0].last_step, 300);
  EXPECT_EQ(reports[0].last_time, 3);
  EXPECT_EQ(reports[0].values, (std::vector<std::pair<std::string, double>>{{"broken_joints", 8}}));
}

TEST(RunConditions, OfAStageCountInItAlone) {
  case_::Case input = with_stages(2);
  input.stages[0].stop_when = input.stages[1].stop_when = "peak(broken_joints) > 5";
  RunConditions conditions(input);
  const auto first = conditions.take(line(0, 6), 0);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].action, Action::end_stage);
  EXPECT_EQ(fired(conditions, 1, 4, 1), 0U) << "its peak begins with the stage";
  const auto second = conditions.take(line(2, 7), 1);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].action, Action::stop) << "of the last stage";
}

TEST(RunConditions, ContinueFromTheirMemory) {
  case_::Case input = triggered(true);
  input.time.stop_when = "broken_joints < 0.5 * peak(broken_joints) for 1 s";
  RunConditions whole(input), part(input), continued(input);
  for (const auto& [time, broken] : {std::pair{0.0, 10.0}, {1.0, 4.0}}) {
    (void)fired(whole, time, broken);
    (void)fired(part, time, broken);
  }
  ASSERT_TRUE(continued.restore(part.memory()));
  EXPECT_EQ(fired(whole, 2, 4), 1U);
  EXPECT_EQ(fired(continued, 2, 4), 1U);
  EXPECT_EQ(continued.memory(), whole.memory());
  EXPECT_EQ(continued.reports().size(), 2U);
}

TEST(RunConditions, RefuseAMemoryThatIsNotTheirs) {
  RunConditions conditions(triggered(true));
  std::vector<double> memory = conditions.memory();
  EXPECT_FALSE(conditions.restore({}));
  memory[1] = 1e300;
  EXPECT_FALSE(conditions.restore(memory));
}

TEST(RunStages, LaterStagesComeForwardByWhatOneSaved) {
  const case_::Case given = with_stages(3);
  RunStages stages(given, nullptr);
  EXPECT_EQ(stages.now(), given);
  stages.begin(0);
  stages.end_at(0.25);
  EXPECT_EQ(stages.now().stages[0].end, 0.25);
  EXPECT_EQ(stages.now().stages[0].gravity, given.stages[0].gravity);
  EXPECT_EQ(stages.now().stages[1].end, 1.25);
  EXPECT_EQ(stages.now().stages[1].gravity[0](0.75), given.stages[1].gravity[0](1.5));
  stages.begin(1);
  stages.end_at(1.5);
  EXPECT_EQ(stages.now().stages[1].end, 1.25) << "it ends before";
  stages.end_at(0.5);
  EXPECT_EQ(stages.now().stages[2].end, 1.5);
  EXPECT_EQ(stages.now().stages[2].gravity[0](0.75), given.stages[2].gravity[0](2.25));
}

TEST(RunStages, ContinueFromAPosition) {
  const case_::Case given = with_stages(3);
  RunStages stages(given, nullptr);
  stages.begin(0);
  stages.end_at(0.3);
  stages.begin(1);
  stages.end_at(0.7);
  RunPosition position;
  position.stage = 1;
  stages.note(position);
  EXPECT_EQ(RunStages(given, &position).now().stages[1], stages.now().stages[1]);
  EXPECT_EQ(RunStages(given, &position).now().stages[2], stages.now().stages[2]);
}

}  // namespace
}  // namespace breccia::run_conditions_test
