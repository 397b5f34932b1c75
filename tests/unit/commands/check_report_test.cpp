#include "commands/check_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "commands/commands.hpp"
#include "mesh/quality.hpp"
#include "mesh/raster.hpp"
#include "model/model.hpp"
#include "model/time_step.hpp"
#include "support/raster_case.hpp"
#include "unit/case/case_files.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::check_report_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kCubes = test::raster_case({.title = "cubes",
                                              .group = "cubes",
                                              .cells = {2, 2, 2},
                                              .young = 40e9,
                                              .density = 2400,
                                              .penalty_factor = 10,
                                              .tensile_strength = 5e6,
                                              .shear_strength = 15e6,
                                              .energy_mode_1 = 100,
                                              .end = 1e-6});

/// What `check` says, with all advice.
std::string whole_report(const case_::Case& input) {
  const Model model = build_model(input);
  const CheckReport report = full_report(Subject(input, model));
  return report.text + advice_list(report.advice, report.advice.size());
}

std::string report_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const case_::Case input = case_::read_text(text, overrides);
  return whole_report(input);
}

/// The number that stands after some words.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) throw std::runtime_error("no \"" + words + "\" in\n" + text);
  return std::stod(text.substr(at + words.size()));
}

TEST(CheckReport, NamesTheProcessZoneOfTheMoreCautiousEstimate) {
  const Model model = build_model(case_::read_text(kCubes));
  const JointLawParams& law = model.joint_laws.front();
  const double zone = std::numbers::pi * 40e9 * law.width_normal / (32 * law.tensile_strength);
  constexpr double kFourDigits = 1e-3;  // as many as are told
  EXPECT_NEAR(number_after(report_of(kCubes), "process zone at least ") / zone, 1.0, kFourDigits);
}

TEST(CheckReport, WarnsOfJointsThatSoftenWithinFewSteps) {
  const std::string words = "The joints of cubes soften within ", energy = "joint[0].energy_mode_1=2 J/m2",
                    shear = "joint[0].energy_mode_2=100 J/m2";
  const double steps = number_after(report_of(kCubes, {energy, shear}), words);
  EXPECT_LT(steps, 10);
  EXPECT_NEAR(number_after(report_of(kCubes, {energy, shear}), "With a time.safety ") * steps, 10, 1);
  const std::string safety = "time.safety=" + std::to_string(0.8 * steps / 11);
  EXPECT_THAT(report_of(kCubes, {energy, shear, safety}), Not(HasSubstr(words)));
  EXPECT_THAT(report_of(kCubes), Not(HasSubstr(words)));
}

TEST(CheckReport, AdvisesOnElementsFromAThirdOfTheProcessZoneOn) {
  const std::string report = report_of(kCubes);
  const double ratio = number_after(report, "mean joint edge ") / number_after(report, "process zone at least ");
  const auto at_ratio = [&](double wanted) {
    return report_of(kCubes, {"joint[0].energy_mode_1=" + std::to_string(100 * ratio / wanted) + " J/m2"});
  };
  EXPECT_THAT(at_ratio(1.2), AllOf(HasSubstr("are larger than its fracture process zone"), HasSubstr("crack paths")));
  EXPECT_THAT(at_ratio(1.05), HasSubstr("are as large as its fracture process zone"));
  EXPECT_THAT(at_ratio(0.4), AllOf(HasSubstr("are 0.4 of its fracture process zone"), HasSubstr("branching")));
  EXPECT_THAT(at_ratio(0.3), Not(HasSubstr("of its fracture process zone (")));
}

TEST(CheckReport, AimsAtAThirdOfTheProcessZoneFromTheStart) {
  constexpr double kTwoDigits = 0.05;  // as many as are told
  for (const char* energy : {"6 J/m2", "10 J/m2", "20 J/m2", "40 J/m2"}) {
    const std::string report = report_of(kCubes, {std::string("joint[0].energy_mode_1=") + energy});
    const double ratio = number_after(report, "mean joint edge ") / number_after(report, "process zone at least ");
    EXPECT_NEAR(number_after(report, "Refine by ") / (3 * ratio), 1.0, kTwoDigits) << ratio;
    EXPECT_THAT(report, HasSubstr(", to a third of that zone,")) << ratio;
  }
}

TEST(CheckReport, MeasuresTheJointsOfAPlaneModelInThePlane) {
  const auto edge = [](const std::string& thickness, const std::string& plane) {
    const std::string report = report_of(
        kCubes + plane, {"mesh.raster.cells=[2, 2, 1]", "mesh.raster.cell_size=[0.01, 0.01, " + thickness + "]"});
    EXPECT_EQ(report.find(" m in the plane, a tenth below ") != std::string::npos, !plane.empty()) << report;
    return number_after(report, "mean joint edge ");
  };
  const std::string plane = "[plane]\nkind = \"strain\"\n";
  EXPECT_EQ(edge("0.01", plane), edge("0.02", plane));
  EXPECT_LT(edge("0.01", plane), edge("0.02", ""));
}

/// Two boxes of one cell, glued at x = 10 mm. @param upper  joints inside of the second;  @param young  of both, GPa
std::string glued_report(const case_::CaseFolder& folder, const std::string& upper, double energy,
                         const std::array<double, 2>& young = {40, 40}) {
  folder.write(
      "two.geo",
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.01, 0.01, 0.01};\n"
      "Box(2) = {0.01, 0, 0, 0.01, 0.01, 0.01};\nCoherence;\nMeshSize{:} = 0.01;\nPhysical Volume(\"lower\") = {1};\n"
      "Physical Volume(\"upper\") = {2};\n");
  const auto material = [](const std::string& group, const std::string& joints, double modulus) {
    return "[[material]]\ngroup = \"" + group + "\"\nyoung = \"" + std::to_string(modulus) +
           " GPa\"\npoisson = 0.2\ndensity = 2400\njoints = \"" + joints + "\"\n";
  };
  const auto joint = [&](const std::string& of) {
    return "[[joint]]\n" + of +
           "\npenalty_factor = 10\ntensile_strength = \"5 MPa\"\nenergy_mode_1 = " + std::to_string(energy) + "\n";
  };
  std::string text = "[mesh]\nfile = \"two.geo\"\nglue = true\n" + material("lower", "none", young[0]) +
                     material("upper", upper, young[1]) + joint("between = [\"lower\", \"upper\"]");
  if (upper == "breakable") text += joint("group = \"upper\"");
  const case_::Case input = case_::read_case(folder.write("case.toml", text + "[[stage]]\nend = \"1 us\"\n"));
  return whole_report(input);
}

TEST(CheckReport, SpeaksOfLoadAndSpeedButOfNoPathWhereJointsLieOnAPlaneAlone) {
  const case_::CaseFolder folder;
  const std::string words = "The elements of lower-upper", zone = "process zone at least ", edge = "mean joint edge ";
  const std::string report = glued_report(folder, "none", 100);
  const double ratio = number_after(report, edge) / number_after(report, zone);
  for (const double wanted : {0.5, 2.0}) {
    const std::string plane = glued_report(folder, "none", 100 * ratio / wanted);
    EXPECT_THAT(plane, AllOf(HasSubstr(words), HasSubstr("speed of the crack depend")));
    EXPECT_THAT(plane, AllOf(Not(HasSubstr("paths")), Not(HasSubstr("branch"))));
    EXPECT_THAT(glued_report(folder, "breakable", 100 * ratio / wanted), AllOf(HasSubstr(words), HasSubstr("paths")));
  }
}

TEST(CheckReport, TellsOfTheWorstOfTheJointsThatFollowOneEntry) {
  const auto boxes = [](const std::string& joints) {
    std::string text = test::kTwoBoxesCase;
    const std::size_t at = text.find("[[joint]]"), end = text.find("[[joint]]\nbetween");
    text.replace(at, end - at, joints);
    const case_::Case input = test::two_boxes_case({}, text);
    return whole_report(input);
  };
  const std::string law = "\npenalty_factor = 10\ntensile_strength = \"5 MPa\"\nenergy_mode_1 = \"20 J/m2\"\n";
  const auto count = [](const std::string& text, const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
    return found;
  };
  const std::string own = boxes("[[joint]]\ngroup = \"left\"" + law + "[[joint]]\ngroup = \"right\"" + law);
  const std::string alike = boxes("[[joint]]\ngroup = [\"left\", \"right\"]" + law);
  for (const char* words : {"are far larger than its fracture process zone", "For 5 % raise joint.penalty"}) {
    EXPECT_EQ(count(own, words), 2u) << words << "\n" << own;
    EXPECT_EQ(count(alike, words), 1u) << words << "\n" << alike;
  }
  EXPECT_THAT(alike,
              AllOf(HasSubstr("(the worst of 2 that follow joint[0]) (edge"), HasSubstr("joints of right: k = p/h")));
}

TEST(CheckReport, MeasuresAnInterfaceByItsSofterSideAndItsProcessZoneByBoth) {
  const case_::CaseFolder folder;
  constexpr double kEnergy = 1e5;  // J/m2: beside it what the rise to the strength takes, a few J/m2, is nothing
  const auto numbers = [&](const std::array<double, 2>& young) {
    const std::string report = glued_report(folder, "none", kEnergy, young);
    return std::array{number_after(report, "they make the body "), number_after(report, "process zone at least ")};
  };
  const auto softer_below = numbers({4, 40}), softer_above = numbers({40, 4}), alike = numbers({40, 40});
  EXPECT_EQ(softer_below, softer_above) << "whichever comes first";
  // k goes with the smaller modulus, the softness with that modulus over k; 2 / (1/4 + 1/40) over 40 is 2/11.
  constexpr double kFourDigits = 1e-3;  // as many as are told; of the softness two, the same
  EXPECT_EQ(softer_below[0], alike[0]);
  EXPECT_NEAR(softer_below[1] / alike[1] / (2.0 / 11), 1.0, kFourDigits);
}

TEST(CheckReport, TellsOfAnInterfaceWithoutStrengthsThatItCannotBreak) {
  std::string glue = test::kTwoBoxesCase;
  const std::size_t at = glue.find("between = [\"left\", \"right\"]\n") + 28;
  glue.erase(at, glue.find("[[contact]]") - at);
  glue.replace(glue.find("[[material]]", glue.find("[[material]]") + 1), 12, "[[material]]\njoints = \"unbreakable\"");
  const auto report = [](const std::string& text) {
    const case_::Case input = test::two_boxes_case({}, text);
    return whole_report(input);
  };
  EXPECT_THAT(report(glue), HasSubstr("  they cannot break: their [[joint]] has no tensile_strength"));
  EXPECT_THAT(report(test::kTwoBoxesCase), Not(HasSubstr("they cannot break")));
}

TEST(CheckReport, AdvisesNoRefinementOrStepBeyondWhatCanBeComputed) {
  // As a core that is made soft for an excavation.
  const std::string report =
      report_of(kCubes, {"material[0].young=4 MPa", "joint[0].penalty_factor=1000", "joint[0].shear_strength=5 MPa"});
  EXPECT_THAT(report, AllOf(HasSubstr("which no practicable mesh resolves"), HasSubstr("excavation")));
  EXPECT_THAT(report, AllOf(Not(HasSubstr("Refine by")), Not(HasSubstr("soften within"))));
}

TEST(CheckReport, TellsThatTheFinestPartAloneOfAGradedMeshIsFineEnoughAndHowSoftJointsMakeIt) {
  const case_::CaseFolder folder;
  folder.write("graded.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.08, 0.02, 0.02};\nMeshSize{:} = 0.02;\n"
               "MeshSize{ PointsOf{ Surface{1}; } } = 0.002;\nPhysical Volume(\"cubes\") = {1};\n");
  const auto graded = [&](const std::string& energy) {
    const std::string text = kCubes.substr(kCubes.find("[[material]]"));
    const std::vector<std::string> overrides{"joint[0].energy_mode_1=" + energy};
    const auto file = folder.write("case.toml", "[mesh]\nfile = \"graded.geo\"\n" + text);
    const case_::Case input = case_::read_case(file, overrides);
    return whole_report(input);
  };
  const std::string report = graded("100 J/m2");
  const double zone = number_after(report, "process zone at least ") / 100,
               fine = number_after(report, "a tenth below ");
  const double softness = number_after(report, "they make the body "), edge = number_after(report, "mean joint edge ");
  constexpr double kTwoDigits = 0.05;  // as many as are told
  EXPECT_NEAR(number_after(report, " % softer, ") / (softness * edge / fine), 1.0, kTwoDigits);
  EXPECT_THAT(report, HasSubstr("where it is meshed finest"));
  EXPECT_THAT(graded(std::to_string(3.1 * fine / zone) + " J/m2"), HasSubstr("trust fracture in that part alone"));
  EXPECT_THAT(graded(std::to_string(2.5 * fine / zone) + " J/m2"), HasSubstr("in the finest tenth 0.4"));
}

TEST(CheckReport, CountsBodiesThatGravityMakesMeet) {
  const std::string fall =
      test::raster_case({.group = "rock", .boxes = {1, 1, 2}, .gap = 0.02, .contact_penalty = 10e9, .end = 0.1}) +
      "[[stage.constraint]]\ngroup = \"rock.z0\"\nfixed = \"xyz\"\n";
  const auto resting = case_::read_text(fall), falling = case_::read_text(fall, {"stage[0].gravity=[0, 0, -9.81]"});
  const auto estimate = [](const case_::Case& input) {
    const Model model = build_model(input);
    const Subject subject(input, model);
    return estimate_run(subject, step_report(input, model, subject.step()));
  };
  EXPECT_FALSE(estimate(resting).meets);
  EXPECT_TRUE(estimate(falling).meets);
  EXPECT_THAT(report_of(fall, {"stage[0].gravity=[0, 0, -9.81]"}),
              AllOf(HasSubstr("once bodies meet that are on their way"), HasSubstr("while no bodies meet")));
}

TEST(CheckReport, SaysThatContactOfManyBodiesIsNotInTheEstimate) {
  std::string whole = kCubes + "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"40 GPa\"\n";
  whole.erase(whole.find("tensile_strength"), whole.find("[[stage]]") - whole.find("tensile_strength"));
  const auto with_boxes = [&](const char* boxes) {
    return report_of(whole, {boxes, "mesh.raster.gap=1 mm", "material.cubes.joints=unbreakable"});
  };
  EXPECT_THAT(with_boxes("mesh.raster.boxes=[3, 1, 1]"), HasSubstr("(not counted: contact among many bodies"));
  EXPECT_THAT(with_boxes("mesh.raster.boxes=[2, 1, 1]"), Not(HasSubstr("not counted")));
}

TEST(CheckReport, WarnsOfATimeStepBeyondTheStableOneAndOfNoOther) {
  const Model model = build_model(case_::read_text(kCubes));
  const double limit = TimeStep(model).limit(model.local.reference);
  EXPECT_THAT(report_of(kCubes, {"time.step=" + std::to_string(1e9 * limit * 1.1) + " ns"}), HasSubstr("blow up"));
  EXPECT_THAT(report_of(kCubes, {"time.step=" + std::to_string(1e9 * limit * 0.9) + " ns"}), Not(HasSubstr("blow up")));
}

TEST(CheckReport, TellsOfAStepAMillionTimesTooLongWithoutTakingIt) {
  EXPECT_THAT(report_of(kCubes, {"time.step=1 s", "stage[0].end=10 s"}), HasSubstr("blow up"));
}

TEST(CheckReport, OfACaseThatStartsFromAStateCountsWhatIsLeftOfTheRun) {
  const case_::Case input = case_::read_text(kCubes);
  const Model model = build_model(input);
  const CheckReport all = full_report(Subject(input, model)),
                    rest = full_report(Subject(input, model, 0.75e-6), "step 3 of it");
  EXPECT_NEAR(rest.estimate.steps / all.estimate.steps, 0.25, 1.0 / all.estimate.steps);
  EXPECT_THAT(rest.text, HasSubstr("starts from step 3 of it"));
  EXPECT_THAT(all.text, Not(HasSubstr("starts from")));
}

TEST(CheckReport, ListsSoManyOfTheAdviceAndSaysHowManyMoreThereAre) {
  const Rule& rule = rules().front();
  const std::vector<Advice> advice{{&rule, "One."}, {&rule, "Two."}, {&rule, "Three."}};
  const std::string name = std::string(" [") + rule.name + "]\n";
  EXPECT_EQ(advice_list(advice, 3), "advice\n- One." + name + "- Two." + name + "- Three." + name);
  EXPECT_EQ(advice_list(advice, 1), "advice\n- One." + name + "2 more: check --all shows them\n");
  EXPECT_EQ(advice_list({}, 5), "nothing to advise\n");
}

TEST(MeshReport, GivesAnglesInDegrees) {
  const FinishedMesh made = make_raster({.cell_size = Vec3(1, 2, 3)});
  const QualityReport quality = assess_quality(made.mesh);
  const std::string text = mesh_report(made, assess_quality(made.mesh));
  constexpr double kDegree = std::numbers::pi / 180, kOneDecimal = 0.051;
  EXPECT_NEAR(number_after(text, "dihedral      "), quality.min_dihedral.min / kDegree, kOneDecimal);
  EXPECT_NEAR(number_after(text.substr(text.find("dihedral")), " to "), quality.max_dihedral.max / kDegree,
              kOneDecimal);
}

/// The columns of a line of the table of domains.
std::array<double, 8> columns_of(const std::string& table, const std::string& name) {
  std::istringstream line(table.substr(table.find("\n  " + name + " ") + 3 + name.size()));
  std::array<double, 8> values{};
  for (double& value : values) line >> value;
  EXPECT_TRUE(line) << table;
  return values;
}

TEST(DomainTable, OfManyDomainsTellsTheLeastTheMeanAndTheMostOfEachColumn) {
  const case_::Case input = case_::read_text(kCubes, {"mesh.raster.cells=[20, 1, 1]"});
  const std::string table = domain_table(input, build_bare_model(input), 20);
  const auto least = columns_of(table, "least"), mean = columns_of(table, "mean"), most = columns_of(table, "most");
  for (std::size_t c = 0; c < least.size(); ++c) {
    EXPECT_LE(least[c], mean[c]) << c << table;
    EXPECT_LE(mean[c], most[c]) << c << table;
  }
  constexpr std::size_t kMessages = 6;
  EXPECT_EQ(least[kMessages], 1) << "to the one neighbour of a domain at the end\n" << table;
  EXPECT_EQ(most[kMessages], 2) << table;
}

TEST(CheckCommand, CountsTheDomainsOfAGridAlongAllAxes) {
  const case_::CaseFolder folder;
  const auto file = folder.write("case.toml", kCubes + "[domains]\nkind = \"grid\"\nn = [1, 1, 2]\n");
  testing::internal::CaptureStdout();
  EXPECT_EQ(check_command({.case_file = file, .overrides = {}, .ranks = 0}, 1), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("2 domains, grid of 1 x 1 x 2"));
}

}  // namespace
}  // namespace breccia::check_report_test
