#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "end_to_end/program.hpp"

/// Pipelines that a [[trigger]] executes.
namespace breccia::test::insitu_trigger_test {
namespace {

using nlohmann::json;

class InSituTrigger : public testing::TestWithParam<int> {};

TEST_P(InSituTrigger, ExecutesEveryPipelineWhenItsConditionBecomesTrue) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", kSmallCase);
  unsetenv("DISPLAY");
  const Outcome outcome =
      call_ranks(GetParam(), "run " + file + " --progress none -o '" + scratch.path("run").string() +
                                 "' --set 'insitu.pipeline=[{name=\"surface\", every_steps=1000000}]' "
                                 "--set 'trigger=[{when=\"broken_joints > 10\", action=\"extract\"}]'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json summary = json::parse(read_text(scratch.path("run") / "summary.json"));
  EXPECT_EQ(summary.at("insitu").at("pipelines").at(0).at("executed"), 3) << "at the start, then, and at the end";
  const json& condition = summary.at("conditions").at(0);
  EXPECT_EQ(condition.at("action"), "extract");
  const std::string step = std::to_string(condition.at("first").at("step").get<int>() + 1);
  EXPECT_NE(read_text(scratch.path("run") / "extracts.csv").find("\n" + step + ","), std::string::npos) << step;
}

INSTANTIATE_TEST_SUITE_P(Ranks, InSituTrigger, testing::Values(1, 2));

}  // namespace
}  // namespace breccia::test::insitu_trigger_test
