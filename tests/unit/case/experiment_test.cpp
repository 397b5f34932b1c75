#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/stage_times.hpp"
#include "case/validate.hpp"
#include "case/writer.hpp"
#include "unit/case/case_files.hpp"

/// Gauges, triggers and conditions of a case.
namespace breccia::case_::experiment_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kGauges =
    "\n[[gauge]]\nname = \"mouth\"\nkind = \"extensometer\"\nfrom = [0, 0, 0]\nto = [\"2 mm\", 0, 0]\n"
    "[[gauge]]\nname = \"tip\"\nkind = \"point\"\nat = [0, \"1 mm\", 0]\n"
    "[[gauge]]\nname = \"cut\"\nkind = \"line\"\nfrom = [0, 0, 0]\nto = [\"1 mm\", 0, 0]\npoints = 3\n"
    "[[gauge]]\nname = \"edge\"\nkind = \"cracks\"\ngroup = \"slit\"\n"
    "[[trigger]]\nwhen = \"mouth.elongation > 2 um\"\naction = \"frame\"\nonce = false\n";

/// What the complete case with these lines at its end is refused for, in one message.
std::string refusal(const std::string& lines, const std::vector<std::string>& overrides = {}) {
  const std::string message = message_of(std::string(complete) + lines, overrides);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  return message;
}

TEST(Experiment, ReadsGaugesAndTriggers) {
  const Case c = read_text(std::string(complete) + kGauges);
  ASSERT_EQ(c.gauges.size(), 4U);
  EXPECT_EQ(c.gauges[0].kind, GaugeKind::extensometer);
  EXPECT_EQ(c.gauges[0].to, Vec3(2e-3, 0, 0));
  EXPECT_EQ(c.gauges[1].at, Vec3(0, 1e-3, 0));
  EXPECT_EQ(c.gauges[2].points, 3);
  EXPECT_EQ(c.gauges[3].group, "slit");
  ASSERT_EQ(c.triggers.size(), 1U);
  EXPECT_EQ(c.triggers[0].when, "mouth.elongation > 2 um");
  EXPECT_EQ(c.triggers[0].action, TriggerAction::frame);
  EXPECT_FALSE(c.triggers[0].once);
  EXPECT_TRUE(c.time.stop_when.empty());
}

TEST(Experiment, TheWrittenCaseReadsBack) {
  const Case c = read_text(std::string(complete) + kGauges, {"time.stop_when=\"broken_joints > 5\""});
  const Case back = read_text(write_case(c));
  EXPECT_EQ(back.gauges, c.gauges);
  EXPECT_EQ(back.triggers, c.triggers);
  EXPECT_EQ(back.time.stop_when, "broken_joints > 5");
}

TEST(Experiment, EachKindHasItsKeys) {
  const std::string gauge = "\n[[gauge]]\nname = \"g\"\n";
  EXPECT_THAT(refusal(gauge + "kind = \"point\"\n"), HasSubstr("gauge[0].at: is missing"));
  EXPECT_THAT(refusal(gauge + "kind = \"extensometer\"\nfrom = [0, 0, 0]\n"), HasSubstr("gauge[0].to: is missing"));
  EXPECT_THAT(refusal(gauge + "kind = \"cracks\"\n"), HasSubstr("gauge[0].group: is missing"));
  EXPECT_THAT(refusal(gauge + "kind = \"point\"\nat = [0, 0, 0]\npoints = 4\n"),
              HasSubstr("gauge[0].points: has no effect beside kind = \"point\""));
  EXPECT_THAT(refusal(gauge + "kind = \"points\"\nat = [0, 0, 0]\n"), HasSubstr("did you mean \"point\"?"));
  EXPECT_THAT(refusal(gauge + "kind = \"line\"\nfrom = [0, 0, 0]\nto = [0, 0, 1]\npoints = 1\n"),
              HasSubstr("gauge[0].points: is out of range"));
  EXPECT_THAT(refusal(gauge + "kind = \"extensometer\"\nfrom = [0, 0, 1]\nto = [0, 0, 1]\n"),
              HasSubstr("gauge[0].to: is the point from"));
}

TEST(Experiment, NamesOfColumnsAreDifferent) {
  const std::string point = "kind = \"point\"\nat = [0, 0, 0]\n";
  const auto named = [&](const std::string& name) { return "\n[[gauge]]\nname = \"" + name + "\"\n" + point; };
  EXPECT_THAT(refusal(named("a") + named("a")), HasSubstr("gauge[1].name: another gauge has a column of this name"));
  EXPECT_THAT(refusal(named("support")), HasSubstr("output.gauges records a group of this name"));
  EXPECT_THAT(refusal(named("a'b")), HasSubstr("has other signs than names of columns"));
  EXPECT_THAT(refusal("\n[[gauge]]\nname = \"l\"\nkind = \"line\"\nfrom = [0, 0, 0]\nto = [0, 0, 1]\n" + named("l 2")),
              HasSubstr("gauge[1].name: another gauge has a column of this name"));
}

TEST(Experiment, AConditionIsRefusedWithFileLineKeyAndTheNearestNames) {
  EXPECT_THAT(refusal("\n[[trigger]]\nwhen = \"broken_jonts > 5\"\naction = \"frame\"\n"),
              AllOf(HasSubstr("case.toml:"), HasSubstr("trigger[0].when: "), HasSubstr("broken_joints"),
                    HasSubstr("given: broken_jonts > 5")));
  EXPECT_THAT(refusal("", {"time.stop_when=\"broken_joints >\""}), HasSubstr("time.stop_when: is not a condition"));
  EXPECT_THAT(refusal("", {"stage[0].stop_when=\"support.reaction_w > 1\""}),
              AllOf(HasSubstr("stage[0].stop_when: "), HasSubstr("support.reaction_x")));
}

TEST(Experiment, AnActionNeedsWhatItActsOn) {
  const std::string when = "\n[[trigger]]\nwhen = \"broken_joints > 5\"\n";
  EXPECT_THAT(refusal(when), HasSubstr("trigger[0].action: is missing"));
  EXPECT_THAT(refusal(when + "action = \"extract\"\n", {"insitu={}"}),
              HasSubstr("trigger[0].action: the case has no pipelines"));
  EXPECT_THAT(refusal(when + "action = \"checkpoint\"\n", {"checkpoint.keep=0"}),
              HasSubstr("trigger[0].action: the run writes no checkpoints"));
}

TEST(Experiment, CracksReachASurfaceNotAVolume) {
  const Case c = read_text(std::string(complete) + "\n[[gauge]]\nname = \"g\"\nkind = \"cracks\"\ngroup = \"glass\"\n");
  const std::vector<std::string> volumes{"glass"}, surfaces{"slit"};
  const std::vector<Problem> problems = check_groups(c, {volumes, surfaces});
  EXPECT_TRUE(std::any_of(problems.begin(), problems.end(),
                          [](const Problem& p) { return p.key == "gauge[0].group" && p.allowed == "slit"; }));
}

TEST(StageTimes, FunctionsDoTheSameEarlier) {
  Stage stage;
  stage.end = 10;
  stage.gravity[2].linear = 3;
  stage.gravity[2].sines = {{2, 0.7, 0.1}};
  stage.pressures.resize(1);
  stage.pressures[0].value.table = {{4, 0}, {6, 8}};
  const Stage earlier = brought_forward(stage, 3, 4);
  EXPECT_EQ(earlier.end, 6);
  for (const double t : {0.0, 1.5, 2.9, 7.0}) {
    EXPECT_NEAR(earlier.gravity[2](t), stage.gravity[2](t + 3), 1e-13) << t;
    EXPECT_NEAR(earlier.pressures[0].value(t), stage.pressures[0].value(t + 3), 1e-14) << t;
  }
  EXPECT_EQ(brought_forward(stage, 0, 0), stage);
}

}  // namespace
}  // namespace breccia::case_::experiment_test
