#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "case/validate_motion.hpp"
#include "case_files.hpp"

namespace breccia::case_::motion_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two stages, the second from 1 ms on. @param first, second  displacements along x
std::string pulled(const std::string& first, const std::string& second) {
  const auto constraint = [](const std::string& value) {
    return "[[stage.constraint]]\ngroup = \"raster.x1\"\ndisplacement = { x = " + value + " }\n";
  };
  return minimal + constraint(first) + "[[stage]]\nend = \"3 ms\"\n" + constraint(second);
}

TEST(Displacement, ThatIsNotZeroWhereItsStageStartsIsRefusedWithItsJump) {
  EXPECT_THAT(
      message_of(pulled("{ constant = \"2 mm\", linear = \"1 m/s\" }", "0")),
      AllOf(HasSubstr("case.toml:"), HasSubstr("stage[0].constraint[0].displacement.x: jumps in the first step"),
            HasSubstr("0 at 0 s"), HasSubstr("given: 0.002 m")));
}

TEST(Displacement, OfALaterStageCountsFromThereButItsTimeFromTheStartOfTheRun) {
  EXPECT_THAT(message_of(pulled("{ linear = \"1 m/s\" }", "{ linear = \"1 m/s\" }")),
              AllOf(HasSubstr("stage[1].constraint[0].displacement.x"), HasSubstr("given: 0.001 m")));
}

TEST(Displacement, ThatStartsAtZeroButForRoundOffIsFine) {
  EXPECT_EQ(message_of(pulled("{ linear = \"1 m/s\" }", "{ constant = \"-1 mm\", linear = \"1 m/s\" }")), "");
  EXPECT_EQ(message_of(pulled("{ sine = { amplitude = 1, frequency = 3, phase = \"180 deg\" } }",
                              "{ ramp = { start = \"1 ms\", end = \"2 ms\", to = 1 } }")),
            "");
}

TEST(Displacement, OfACaseThatStartsFromAStateIsJudgedAtTheTimeOfTheState) {
  Case c = read_text(pulled("{ linear = \"1 m/s\" }", "0"));
  c.start = Start{};
  EXPECT_THAT(validate_motion(c), IsEmpty());
  EXPECT_EQ(jumps_at(c, c.stages[0], 0.5e-3).size(), 1u);
  EXPECT_THAT(jumps_at(c, c.stages[0], 0), IsEmpty());
}

TEST(Displacement, ThatNoRunCanComputeIsRefused) {
  EXPECT_EQ(message_of(pulled("{ linear = \"1e12 m/s\" }", "0")), "") << "1e9 m at the end of the stage";
  for (const char* far : {"{ linear = \"1e200 m/s\" }", "{ table = [[0, 0], [\"1 ms\", -2e10]] }",
                          "{ sine = { amplitude = 2e10, frequency = 3 } }"}) {
    EXPECT_THAT(message_of(pulled(far, "0")),
                AllOf(HasSubstr("stage[0].constraint[0].displacement: is too large to be computed"),
                      HasSubstr("magnitudes up to 1e+10 m")));
  }
}

std::string plane(const std::string& kind, const std::string& more) {
  return minimal + more + "[plane]\nkind = \"" + kind + "\"\naxis = \"y\"\n";
}
std::string constraint(const std::string& keys) {
  return "[[stage.constraint]]\ngroup = \"raster.x0\"\n" + keys + "\n";
}

TEST(Plane, RefusesWhatActsAlongItsAxisAndNothingElse) {
  const std::string velocity = "[[initial_velocity]]\ngroup = \"raster\"\n";
  const std::string sphere = "[sphere]\nradius = 1\npenalty = \"1 GPa\"\n";
  for (const auto& [wrong, key] : {
           std::pair{std::string("gravity = [0, \"-9.81 m/s2\", 0]\n"), "stage[0].gravity: acts along y"},
           {constraint("velocity = { y = 1 }"), "stage[0].constraint[0].velocity: acts along y"},
           {constraint("displacement = { y = { linear = 1 } }"), "stage[0].constraint[0].displacement: acts along y"},
           {velocity + "velocity = [0, 1, 0]\n", "initial_velocity[0].velocity: acts along y"},
           {velocity + "random = [0, 1]\n", "initial_velocity[0].random: acts along y"},
           {velocity + "angular = [1, 0, 0]\n", "initial_velocity[0].angular: acts along y"},
           {velocity + "strain_rate = [1, 1, 0]\n", "initial_velocity[0].strain_rate: acts along y"},
           {sphere, "sphere: acts along y"},
       }) {
    EXPECT_THAT(message_of(plane("strain", wrong)), HasSubstr(key));
    EXPECT_THAT(message_of(plane("stress", wrong)), HasSubstr(key));
  }
  const std::string fine = "gravity = [1, 0, 2]\n" + constraint("velocity = { x = 1, z = 2 }") + velocity +
                           "velocity = [1, 0, 1]\nangular = [0, 1, 0]\n";
  EXPECT_EQ(message_of(plane("strain", fine)), "");
  EXPECT_EQ(message_of(plane("stress", fine)), "");
}

TEST(Plane, MayBeHeldAlongItsAxisUnderStrainAlone) {
  EXPECT_EQ(message_of(plane("strain", constraint("fixed = \"xyz\""))), "");
  EXPECT_EQ(message_of(plane("strain", constraint("velocity = { x = 1, y = 0 }"))), "");
  EXPECT_THAT(message_of(plane("stress", constraint("fixed = \"xyz\""))),
              HasSubstr("stage[0].constraint[0].fixed: acts along y"));
}

}  // namespace
}  // namespace breccia::case_::motion_test
