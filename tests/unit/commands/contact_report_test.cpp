#include "commands/contact_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/case/case_files.hpp"

namespace breccia::contact_report_test {
namespace {

using testing::HasSubstr;

constexpr const char* kRest = R"(
[[contact]]
between = ["*", "*"]
penalty = "40 GPa"
[[stage]]
end = "1 ms"
)";

std::string material(const std::string& group, const std::string& young) {
  return "[[material]]\ngroup = \"" + group + "\"\nyoung = \"" + young +
         "\"\npoisson = 0.2\ndensity = 2000\njoints = \"none\"\n";
}

/// Model of a geometry. @param more  lines of the case before the materials
Model model_of(const std::string& geometry, const std::string& groups, const std::string& more = "") {
  const case_::CaseFolder folder;
  folder.write("geometry.geo", "SetFactory(\"OpenCASCADE\");\n" + geometry);
  return build_model(
      case_::read_case(folder.write("case.toml", "[mesh]\nfile = \"geometry.geo\"\n" + more + groups + kRest)));
}

constexpr const char* kCylinder =
    "Cylinder(1) = {0, 0, 0, 0, 0, 0.004, 0.01};\nPhysical Volume(\"roller\") = {1};\nMeshSize{:} = 0.004;\n";

TEST(LateContact, NamesCurvedSurfacesAndHowFarBehindTheirCornersPointsLie) {
  const Advice advice = late_contact_advice(model_of(kCylinder, material("roller", "1 GPa")));
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_THAT(advice[0], HasSubstr("The surface of roller is curved"));
  EXPECT_THAT(advice[0], HasSubstr(" um behind"));
}

TEST(LateContact, IsNoneWherePointsLieOnCorners) {
  EXPECT_TRUE(late_contact_advice(model_of(kCylinder, material("roller", "1 GPa"), "[contact_points]\nper_face = 4\n"))
                  .empty());
}

TEST(LateContact, IsNoneForBoxes) {
  EXPECT_TRUE(late_contact_advice(model_of("Box(1) = {0, 0, 0, 1, 1, 1};\nPhysical Volume(\"box\") = {1};\n"
                                           "MeshSize{:} = 0.5;\n",
                                           material("box", "1 GPa")))
                  .empty());
}

TEST(CoarsePoints, AreThoseOfFacesMuchLargerThanTheOthers) {
  const auto advice = [](const std::string& floor_size, const std::string& more = "") {
    return as_list(coarse_points_advice(
        model_of("Box(1) = {0, 0, 0, 3, 3, 1};\nBox(2) = {1, 1, 1.1, 1, 1, 1};\nPhysical Volume(\"floor\") = {1};\n"
                 "Physical Volume(\"cube\") = {2};\nMeshSize{:} = 0.5;\nMeshSize{PointsOf{Volume{1};}} = " +
                     floor_size + ";\n",
                 material("floor", "1 GPa") + material("cube", "1 GPa"), more)));
  };
  EXPECT_EQ(advice("0.5"), "");
  EXPECT_THAT(advice("1.5"), HasSubstr("The faces of floor are "));
  EXPECT_THAT(advice("1.5"), HasSubstr("\"first\" with cube named first"));
  EXPECT_EQ(advice("1.5", "[contact_points]\nper_face = 4\n"), "");
}

TEST(StiffnessReport, HasALineForEachGroupWithItsOwnModulus) {
  const std::string text = stiffness_report(
      model_of("Box(1) = {0, 0, 0, 1, 1, 1};\nBox(2) = {2, 0, 0, 1, 1, 1};\nPhysical Volume(\"soft\") = {1};\n"
               "Physical Volume(\"hard\") = {2};\nMeshSize{:} = 0.5;\n",
               material("soft", "1 GPa") + material("hard", "200 GPa")));
  EXPECT_THAT(text, HasSubstr("contact of soft: stiffness penalty/H = "));
  EXPECT_THAT(text, HasSubstr("recommended penalty 1 GPa"));
  EXPECT_THAT(text, HasSubstr("contact of hard: stiffness penalty/H = "));
  EXPECT_THAT(text, HasSubstr("recommended penalty 200 GPa"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(StiffnessReport, NamesTheLongestDelayOfFrictionByTheSmallerBody) {
  const std::string boxes =
      "Box(1) = {0, 0, 0, 0.06, 0.08, 1e-4};\nBox(2) = {2, 0, 0, 1, 1, 1};\nPhysical Volume(\"small\") = {1};\n"
      "Physical Volume(\"large\") = {2};\nMeshSize{:} = 0.5;\n";
  const std::string text = stiffness_report(
      model_of(boxes, material("small", "1 GPa") + material("large", "1 GPa"),
               "[[contact]]\nbetween = [\"small\", \"large\"]\npenalty = \"40 GPa\"\nfriction = 0.3\n"));
  // Six crossings of 0.1 m with sqrt(1 GPa / 1000 kg/m3), the density of both together.
  const std::string line = "friction follows the normal force with a delay of up to 600 us\n";
  EXPECT_NE(text.find(line), text.rfind(line)) << "for both groups:\n" << text;
}

}  // namespace
}  // namespace breccia::contact_report_test
