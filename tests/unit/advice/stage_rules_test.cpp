#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "commands/refusals.hpp"
#include "unit/advice/advice_of.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::stage_rules_test {
namespace {

using test::as_list;
using testing::AllOf;
using testing::HasSubstr;

/// A wave crosses the cube of 10 mm in 3 us; gravity lasts 1 ms.
std::string cube(const std::string& stage, const std::string& constraint = "group = \"raster.z0\"\nfixed = \"xyz\"\n") {
  return case_::minimal + stage + (constraint.empty() ? "" : "[[stage.constraint]]\n" + constraint);
}
const std::string kGravity = "gravity = [0, 0, \"-9.81 m/s2\"]\n";

std::string stage_advice(const case_::Case& input) {
  const Model model = build_bare_model(input);
  return test::advice_of(
      {"sudden_load", "sudden_motion", "undamped_friction", "damped_sliding", "damped_reactions", "long_interval"},
      Subject(input, model));
}

std::string advice_on(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const case_::Case input = case_::read_text(text, overrides);
  return stage_advice(input);
}

TEST(SuddenLoads, OnAnUndampedBodyThatIsHeldAreWorthARamp) {
  EXPECT_THAT(advice_on(cube(kGravity)), AllOf(HasSubstr("Stage 0 begins with gravity (9.81 m/s2 at once)"),
                                               HasSubstr("ramp"), HasSubstr("viscosity")));
  EXPECT_THAT(advice_on(cube("[[stage.pressure]]\nsurface = \"raster.z1\"\nvalue = \"1 MPa\"\n")),
              HasSubstr("begins with the pressure on \"raster.z1\" (1 MPa at once)"));
}

TEST(SuddenLoads, OfTractionAreKnownAsWell) {
  const std::string traction = "[[stage.traction]]\nsurface = \"raster.z1\"\nvalue = [0, \"3 MPa\", \"4 MPa\"]\n";
  EXPECT_THAT(advice_on(cube(traction)), HasSubstr("begins with the traction on \"raster.z1\" (5 MPa at once)"));
}

TEST(SuddenLoads, ThatGrowOrAreDampedOrMeetAFreeOrARigidBodyOrAreAPulseAreNot) {
  EXPECT_EQ(advice_on(cube("gravity = [0, 0, { ramp = { to = -9.81, end = \"0.5 ms\" } }]\n")), "");
  EXPECT_EQ(advice_on(cube(kGravity + "local_damping = 0.3\n")), "");
  EXPECT_EQ(advice_on(cube(kGravity + "mass_damping = 100\n")), "");
  EXPECT_EQ(advice_on(cube(kGravity), {"material[0].viscosity=10 Pa s"}), "");
  EXPECT_EQ(advice_on(cube(kGravity, "")), "") << "it falls";
  EXPECT_EQ(advice_on(cube(kGravity, "group = \"raster\"\nfixed = \"xyz\"\n")), "");
  EXPECT_EQ(advice_on(cube(kGravity), {"stage[0].end=10 us"}), "");
}

TEST(SuddenLoads, ThatAStageGoesOnWithAreNot) {
  const std::string next = "[[stage]]\nend = \"2 ms\"\n" + kGravity;
  const std::string held = "[[stage.constraint]]\ngroup = \"raster.z0\"\nfixed = \"xyz\"\n";
  const std::string grown = "gravity = [0, 0, { ramp = { to = -9.81, end = \"0.5 ms\" } }]\n";
  EXPECT_EQ(advice_on(cube(grown) + next + held), "");
  EXPECT_THAT(advice_on(cube("") + next + held), HasSubstr("Stage 1 begins with gravity"));
}

TEST(SuddenLoads, OnWhatLiesOnAnotherBodyAre) {
  const std::string contact = "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"75 GPa\"\n";
  const auto boxes = [&](const std::string& gap) {
    return advice_on(cube(kGravity, "") + contact,
                     {"mesh.raster.boxes=[1, 1, 2]", "mesh.raster.gap=[0, 0, \"" + gap + "\"]"});
  };
  EXPECT_THAT(boxes("0 mm"), HasSubstr("begins with gravity"));
  EXPECT_EQ(boxes("1 mm"), "");
}

TEST(SuddenLoads, OfPressureOnABodyThatNothingSupportsAre) {
  const std::string pressure = "[[stage.pressure]]\nsurface = \"raster.z1\"\nvalue = ";
  EXPECT_THAT(advice_on(cube(pressure + "\"1 MPa\"\n", "")),
              HasSubstr("the pressure on \"raster.z1\" (1 MPa at once)"));
  EXPECT_EQ(advice_on(cube(pressure + "{ ramp = { to = 1e6, end = \"0.5 ms\" } }\n", "")), "");
}

const std::string kBreakable =
    "[[joint]]\ngroup = \"raster\"\ntensile_strength = \"1 MPa\"\nenergy_mode_1 = \"10 J/m2\"\n";

/// The cube with joints, held below and driven above. @param motion  velocity = ..., or displacement = ...
std::string driven(const std::string& motion, std::vector<std::string> overrides = {}) {
  overrides.emplace_back("material[0].joints=breakable");
  return advice_on(cube("") + "[[stage.constraint]]\ngroup = \"raster.z1\"\n" + motion + "\n" + kBreakable, overrides);
}

TEST(SuddenMotions, AreNamedWithTheirWaveBesideTheStrengthAndARamp) {
  // rho c v = 14.3 MPa s/m times 10 mm/s.
  const std::string advice = driven("velocity = { z = -0.01 }");
  EXPECT_THAT(advice, AllOf(HasSubstr("stage[0].constraint[1] (velocity, \"raster.z1\", line "),
                            HasSubstr("a jump in speed of 10 mm/s"), HasSubstr("rho c v of about 143 kPa is 14 % of"),
                            HasSubstr("joints of raster"), HasSubstr("ramp = { end = ..., to = -0.01 }")));
  EXPECT_THAT(driven("displacement = { z = { table = [[0, 0], [\"1 ms\", \"10 um\"]] } }"),
              AllOf(HasSubstr("(displacement, \"raster.z1\""), HasSubstr("of 10 mm/s")));
}

TEST(SuddenMotions, ThatGrowOrAreSlowOrAPulseOrMeetNoJointsAreNot) {
  EXPECT_EQ(driven("velocity = { z = { ramp = { to = -0.01, end = \"0.5 ms\" } } }"), "");
  EXPECT_EQ(driven("displacement = { z = { constant = 1e-5, sine = { amplitude = 1e-5, frequency = 250, phase = "
                   "\"-90 deg\" } } }"),
            "")
      << "a cosine";
  EXPECT_EQ(driven("velocity = { z = -0.005 }"), "") << "7 % of the strength";
  EXPECT_EQ(driven("velocity = { z = -0.01 }", {"stage[0].end=10 us"}), "");
  EXPECT_EQ(advice_on(cube("", "group = \"raster.z1\"\nvelocity = { z = -1 }\n")), "");
  EXPECT_EQ(
      advice_on(cube("", "group = \"raster\"\nvelocity = { z = -1 }\n") + kBreakable, {"material[0].joints=breakable"}),
      "")
      << "all of it moves";
}

TEST(SuddenMotions, AreMeasuredAgainstTheMotionBefore) {
  const std::string fast = "[[initial_velocity]]\ngroup = \"raster\"\nvelocity = [0, 0, -1]\n";
  EXPECT_EQ(driven("velocity = { z = -1 }\n" + fast), "");
  EXPECT_THAT(driven("velocity = { z = 1 }\n" + fast), HasSubstr("a jump in speed of 2 m/s"));
  const std::string next = "[[stage]]\nend = \"2 ms\"\n[[stage.constraint]]\ngroup = \"raster.z1\"\n";
  const std::string grown = "velocity = { z = { ramp = { to = -0.01, end = \"0.5 ms\" } } }\n";
  EXPECT_EQ(driven(grown + next + "velocity = { z = -0.01 }\n"), "");
  EXPECT_EQ(driven(grown + next + "displacement = { z = { table = [[\"1 ms\", 0], [\"2 ms\", \"-10 um\"]] } }\n"), "");
  EXPECT_THAT(driven(grown + next + "velocity = { z = 0.01 }\n"),
              AllOf(HasSubstr("stage[1].constraint[0]"), HasSubstr("of 20 mm/s"), HasSubstr("start = 0.001, end")));
  EXPECT_THAT(driven("fixed = \"z\"\n" + next + "velocity = { z = 0.01 }\n"), HasSubstr("of 10 mm/s"));
  const std::string loose = "[[stage]]\nend = \"2 ms\"\n[[stage.constraint]]\ngroup = \"raster.x1\"\n";
  EXPECT_EQ(driven(grown + loose + "velocity = { x = 0.01 }\n"), "") << "how it moved before is not known";
}

TEST(SuddenMotions, ComeToWhatLiesOnTheDrivenBody) {
  const case_::CaseFolder folder;
  folder.write("boxes.geo",
               "SetFactory(\"OpenCASCADE\");\nDefineConstant[ gap = 0 ];\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
               "Box(2) = {0, 0, 1 + gap, 1, 1, 1};\nPhysical Volume(\"raster\") = {1};\n"
               "Physical Volume(\"platen\") = {2};\nMeshSize{:} = 2;\n");
  const auto pressed = [&](const std::string& gap) {
    const std::string rock = case_::minimal.substr(case_::minimal.find("[[material]]"));
    std::string platen = rock.substr(0, rock.find("[[stage]]"));
    platen.replace(platen.find("raster"), 6, "platen");
    const std::string contact = "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"75 GPa\"\n";
    const std::string text = "[mesh]\nfile = \"boxes.geo\"\nparameters = { gap = " + gap + " }\n" + platen + rock +
                             "[[stage.constraint]]\ngroup = \"platen\"\nvelocity = { x = 0, y = 0, z = -0.01 }\n" +
                             kBreakable + contact;
    const std::vector<std::string> overrides{"material[1].joints=breakable", "stage[0].end=1 s"};
    const case_::Case input = case_::read_case(folder.write("case.toml", text), overrides);
    return stage_advice(input);
  };
  EXPECT_THAT(pressed("0"), AllOf(HasSubstr("(velocity, \"platen\""), HasSubstr("joints of raster")));
  EXPECT_EQ(pressed("0.1"), "");
}

TEST(Reactions, OfWhatIsDrivenUnderLocalDampingAreNamed) {
  const auto recorded = [](const std::string& damping, const std::string& motion, const std::string& gauge) {
    return advice_on(cube(damping) + "[[stage.constraint]]\ngroup = \"raster.z1\"\n" + motion,
                     {"output.gauges=[\"" + gauge + "\"]"});
  };
  const std::string damping = "local_damping = 0.3\n", motion = "velocity = { z = 0.01 }\n";
  EXPECT_THAT(recorded(damping, motion, "raster.z1"),
              AllOf(HasSubstr("Stage 0 has a local_damping of 0.3"), HasSubstr("requires 1.43 times the force")));
  EXPECT_THAT(recorded(damping, motion, "raster.z0"), HasSubstr("reactions"));
  EXPECT_EQ(recorded(damping, motion, "raster.x0"), "");
  EXPECT_EQ(recorded(damping, "fixed = \"z\"\n", "raster.z1"), "");
  EXPECT_EQ(recorded("", motion, "raster.z1"), "");
}

TEST(Friction, WhereNothingDampsWhatIsLoadedIsNamedWithAViscosity) {
  const std::string contact = "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"75 GPa\"\nfriction = 0.3\n";
  const std::string grown = "gravity = [0, 0, { ramp = { to = -9.81, end = \"0.5 ms\" } }]\n";
  const auto boxes = [&](const std::string& stage, const std::string& entry) {
    return advice_on(cube(stage) + contact, {"mesh.raster.boxes=[1, 1, 2]", "mesh.raster.gap=1 mm", entry});
  };
  const std::string rough = "contact[0].friction=0.9";
  EXPECT_THAT(boxes(grown, rough), AllOf(HasSubstr("Nothing damps stage 0"), HasSubstr("contact of * 0.9"),
                                         HasSubstr("material.viscosity of ")));
  EXPECT_EQ(boxes(grown, "contact[0].friction=0.25"), "");
  EXPECT_EQ(boxes("", rough), "") << "nothing is loaded";
  EXPECT_THAT(boxes(grown, "contact[0].friction_delay=0"), HasSubstr("* 0.3"));
  const auto at_once = [&](const std::string& entry) {
    return advice_on(cube(grown) + contact + "friction_delay = 0\n",
                     {"mesh.raster.boxes=[1, 1, 2]", "mesh.raster.gap=1 mm", entry});
  };
  EXPECT_EQ(at_once("contact[0].friction=0.2"), "");
  EXPECT_THAT(at_once("material[0].viscosity=10 Pa s"), HasSubstr("Viscosity damps little in stage 0"));
  EXPECT_EQ(at_once("material[0].viscosity=10 kPa s"), "");
  EXPECT_EQ(at_once("contact[0].damping_ratio=0.5"), "");
  EXPECT_EQ(advice_on(cube(grown) + contact, {rough}), "") << "one body that cannot break";
}

TEST(Friction, OfJointsThatCanBreakCountsAsWell) {
  const std::string joint =
      "[[joint]]\ngroup = \"raster\"\ntensile_strength = 1e6\nenergy_mode_1 = 10\nfriction = 0.6\n";
  const std::string drive = "[[stage.constraint]]\ngroup = \"raster.z1\"\nvelocity = { z = -0.01 }\n";
  EXPECT_THAT(advice_on(cube("") + drive + joint, {"material[0].joints=breakable"}), HasSubstr("joint of raster 0.6"));
  EXPECT_EQ(advice_on(cube("") + joint, {"material[0].joints=breakable"}), "");
}

TEST(Friction, InALastStageWithLocalDampingStopsWhatShouldSlide) {
  const std::string contact = "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"75 GPa\"\nfriction = 0.3\n";
  const std::vector<std::string> two{"mesh.raster.boxes=[1, 1, 2]", "mesh.raster.gap=[0, 0, \"1 mm\"]"};
  const std::string damped = cube("local_damping = 0.3\n") + contact;
  EXPECT_THAT(advice_on(damped, two), HasSubstr("has a local_damping of 0.3: with friction it slows down or stops"));
  EXPECT_EQ(advice_on(damped + "[[stage]]\nend = \"2 ms\"\n", two), "") << "before, it finds a state of rest";
  std::vector<std::string> smooth = two;
  smooth.push_back("contact[0].friction=0");
  EXPECT_EQ(advice_on(damped, smooth), "");
}

TEST(Constraints, ThatOverruleOthersInPartAreNamedWithTheNumberOfNodes) {
  const std::string top = "[[stage.constraint]]\ngroup = \"raster.x1\"\nvelocity = { z = 1 }\n";
  const case_::Case input = case_::read_text(cube("") + top);
  EXPECT_THAT(as_list(overruled_constraint(input, build_bare_model(input))),
              AllOf(HasSubstr("stage[0].constraint[1] (velocity, \"raster.x1\", line "),
                    HasSubstr("overrules stage[0].constraint[0] (fixed, \"raster.z0\", line "),
                    HasSubstr("along z on 2 of its 5 nodes")));
}

TEST(Constraints, ThatLeaveNothingOfOthersAreRefused) {
  const case_::Case input =
      case_::read_text(cube("") + "[[stage.constraint]]\ngroup = \"raster\"\nvelocity = { z = 1 }\n");
  const Model model = build_bare_model(input);
  EXPECT_EQ(as_list(overruled_constraint(input, model)), "");
  try {
    refuse_contradictions(input, model);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("stage[0].constraint[1]: contradicts stage[0].constraint[0]"),
                                    HasSubstr("all its 5 nodes"), HasSubstr("along z")));
  }
}

TEST(Intervals, LongerThanTheRunAreNamed) {
  const std::string text = cube("");
  EXPECT_THAT(advice_on(text, {"output.frame_interval=2 ms"}),
              HasSubstr("output.frame_interval = 2 ms is longer than"));
  EXPECT_THAT(advice_on(text, {"output.history_interval=2 ms"}), HasSubstr("output.history_interval"));
  EXPECT_THAT(advice_on(text, {"checkpoint.interval=2 ms"}), HasSubstr("checkpoint.interval"));
  EXPECT_EQ(advice_on(text, {"output.frame_interval=1 ms", "checkpoint.interval=1 ms"}), "");
}

}  // namespace
}  // namespace breccia::stage_rules_test
