#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/raster_case.hpp"
#include "unit/advice/advice_of.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::plausibility_rules_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A brick of breakable joints, two stages.
const std::string kBrick = test::raster_case({.title = "Brick",
                                              .cells = {2, 2, 2},
                                              .young = 20e9,
                                              .density = 2400,
                                              .penalty_factor = 20,
                                              .tensile_strength = 3e6,
                                              .shear_strength = 9e6,
                                              .energy_mode_1 = 20,
                                              .joint_friction = 0.6,
                                              .contact_penalty = 20e9,
                                              .contact_friction = 0.5}) +
                           R"(gravity = [0, 0, -9.81]
[[stage.constraint]]
group = "raster.z0"
fixed = "xyz"
[[stage]]
end = "2 ms"
gravity = [0, 0, -9.81]
[[stage.constraint]]
group = "raster.z0"
fixed = "xyz"
)";

std::string advice_on(const std::vector<std::string>& overrides, const std::string& text = kBrick) {
  const case_::Case input = case_::read_text(text, overrides);
  const Model model;
  return test::advice_of({"implausible_material", "implausible_strength", "implausible_friction", "function_cut_off",
                          "not_repeated_in_stage", "absorbing_under_gravity"},
                         Subject(input, model));
}

std::string without(const std::string& part) {
  std::string text = kBrick;
  return text.replace(text.rfind(part), part.size(), "");
}

TEST(Plausibility, OfUsualNumbersIsNotDoubted) {
  EXPECT_EQ(advice_on({}), "");
  EXPECT_EQ(advice_on({"contact[0].friction=1.5", "material[0].density=7850", "joint[0].tensile_strength=1e9"}), "");
}

TEST(Plausibility, OfAnAngleOfFrictionIsDoubtedWithItsTangent) {
  EXPECT_THAT(advice_on({"contact[0].friction=30"}), AllOf(HasSubstr("contact[0].friction"), HasSubstr("write 0.577")));
  EXPECT_THAT(advice_on({"joint[0].friction=45"}), AllOf(HasSubstr("joint[0].friction"), HasSubstr("write 1,")));
}

TEST(Plausibility, OfOtherUnitsIsDoubted) {
  EXPECT_THAT(advice_on({"material[0].density=2.4"}), HasSubstr("material[0].density (line 5) is 2.4 kg/m3"));
  EXPECT_THAT(advice_on({"material[0].young=20"}), AllOf(HasSubstr("waves run at"), HasSubstr("young (20 Pa)")));
  EXPECT_THAT(advice_on({"joint[0].tensile_strength=\"5 GPa\""}), HasSubstr("would stretch by 25 % before it breaks"));
}

TEST(Plausibility, OfACourseThatLiesBeyondItsStageIsDoubted) {
  const std::string ramp = "stage[0].gravity=[0, 0, { ramp = { to = -9.81, end = ";
  EXPECT_THAT(advice_on({ramp + "1 } }]"}),
              AllOf(HasSubstr("stage[0] (line "), HasSubstr("continues to 1 s, the stage to 1 ms")));
  EXPECT_EQ(advice_on({ramp + "\"2 ms\" } }]"}), "") << "it continues in the next stage";
}

TEST(Plausibility, OfAStageThatDoesNotRepeatTheSupportsOrTheGravityIsDoubted) {
  EXPECT_THAT(advice_on({}, without("[[stage.constraint]]\ngroup = \"raster.z0\"\nfixed = \"xyz\"\n")),
              HasSubstr("Stage 1 lacks the [[stage.constraint]] of the previous stage"));
  EXPECT_THAT(advice_on({}, without("gravity = [0, 0, -9.81]\n")),
              HasSubstr("Stage 1 lacks the gravity of the previous stage"));
}

TEST(Plausibility, OfGravityOnABaseThatAbsorbsFromTheStartIsDoubted) {
  std::string text = kBrick.substr(0, kBrick.find("[[stage.constraint]]"));
  EXPECT_THAT(advice_on({}, text + "absorbing = [\"raster.z0\"]\n"), HasSubstr("sink at a steady speed"));
  EXPECT_EQ(advice_on({}, text), "");
  text += "absorbing = [\"raster.z0\"]\n[[stage.constraint]]\ngroup = \"raster\"\nfixed = ";
  EXPECT_THAT(advice_on({}, text + "\"xy\"\n"), HasSubstr("sink at a steady speed"));
  EXPECT_EQ(advice_on({}, text + "\"z\"\n"), "");
}

}  // namespace
}  // namespace breccia::plausibility_rules_test
