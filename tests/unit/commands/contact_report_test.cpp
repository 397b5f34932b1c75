#include "commands/contact_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/advice/contact_model.hpp"

namespace breccia::contact_report_test {
namespace {

using test::material;
using test::model_of;
using testing::HasSubstr;

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
