#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/advice/advice_of.hpp"
#include "unit/advice/contact_model.hpp"

namespace breccia::contact_point_rules_test {
namespace {

using test::as_list;
using test::material;
using test::model_of;
using testing::HasSubstr;

constexpr const char* kCylinder =
    "Cylinder(1) = {0, 0, 0, 0, 0, 0.004, 0.01};\nPhysical Volume(\"roller\") = {1};\nMeshSize{:} = 0.004;\n";

constexpr const char* kInside = "[contact_points]\nper_face = 3\n";

TEST(LateContact, NamesCurvedSurfacesAndHowFarBehindTheirCornersPointsLie) {
  const Sentences advice = late_contact(model_of(kCylinder, material("roller", "1 GPa"), kInside));
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_THAT(advice[0], HasSubstr("The surface of roller is curved"));
  EXPECT_THAT(advice[0], HasSubstr(" um behind"));
}

TEST(LateContact, IsNoneWherePointsLieOnCorners) {
  EXPECT_TRUE(late_contact(model_of(kCylinder, material("roller", "1 GPa"))).empty());
}

TEST(LateContact, IsNoneForBoxes) {
  EXPECT_TRUE(late_contact(model_of("Box(1) = {0, 0, 0, 1, 1, 1};\nPhysical Volume(\"box\") = {1};\n"
                                    "MeshSize{:} = 0.5;\n",
                                    material("box", "1 GPa")))
                  .empty());
}

TEST(CoarsePoints, AreThoseOfFacesMuchLargerThanTheOthers) {
  const auto advice = [](const std::string& floor_size, const std::string& more = kInside) {
    return as_list(coarse_contact_points(
        model_of("Box(1) = {0, 0, 0, 3, 3, 1};\nBox(2) = {1, 1, 1.1, 1, 1, 1};\nPhysical Volume(\"floor\") = {1};\n"
                 "Physical Volume(\"cube\") = {2};\nMeshSize{:} = 0.5;\nMeshSize{PointsOf{Volume{1};}} = " +
                     floor_size + ";\n",
                 material("floor", "1 GPa") + material("cube", "1 GPa"), more)));
  };
  EXPECT_EQ(advice("0.5"), "");
  EXPECT_THAT(advice("1.5"), HasSubstr("The faces of floor are "));
  EXPECT_THAT(advice("1.5"), HasSubstr("\"first\" with cube named first"));
  EXPECT_EQ(advice("1.5", ""), "");
}

}  // namespace
}  // namespace breccia::contact_point_rules_test
