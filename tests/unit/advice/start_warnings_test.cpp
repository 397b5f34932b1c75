#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/raster_case.hpp"
#include "unit/advice/advice_of.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::start_warnings_test {
namespace {

using test::as_list;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two cubes of 10 mm, one above the other.
const std::string kCubes =
    test::raster_case({.group = "rock", .boxes = {1, 1, 2}, .gap = 1e-3, .contact_penalty = 1e9});

std::string advice_on(const std::string& more, const std::vector<std::string>& overrides = {}) {
  const case_::Case input = case_::read_text(kCubes + more, overrides);
  return as_list(start_warnings(input, build_bare_model(input)));
}
const std::string kFlying = "[[initial_velocity]]\ngroup = \"rock\"\nvelocity = [\"10 m/s\", 0, 0]\n";
const std::string kHeld = "[[stage.constraint]]\ngroup = \"rock\"\n";

TEST(Unmeant, AreElementsInNoPhysicalVolume) {
  const case_::Case input = case_::read_text(kCubes, {});
  Model model = build_bare_model(input);
  EXPECT_THAT(as_list(start_warnings(input, model)), Not(HasSubstr("left out")));
  model.mesh_report.ungrouped_elements = 7;
  EXPECT_THAT(as_list(start_warnings(input, model)), HasSubstr("Of " + std::to_string(model.mesh.num_elements() + 7) +
                                                               " tetrahedra of the mesh 7 are in no "));
}

TEST(Unmeant, IsALawOfAnInterfaceThatIsNotThere) {
  EXPECT_THAT(advice_on("[[joint]]\nbetween = [\"rock\", \"*\"]\n", {"mesh.glue=true"}),
              HasSubstr("joint[0] (line 17) is the law of no joint"));
}

TEST(Unmeant, IsASphereAroundNothing) {
  const auto sphere = [](const std::string& radius) {
    return advice_on("[sphere]\nradius = \"" + radius + "\"\npenalty = 1e9\n");
  };
  EXPECT_THAT(sphere("1 mm"), AllOf(HasSubstr("The sphere encloses nothing"), HasSubstr("more than 0.02532 m")));
  EXPECT_EQ(sphere("20 mm"), "") << "it holds a part: small_sphere reports it";
}

TEST(Unmeant, IsContactWithoutContactPoints) {
  EXPECT_THAT(advice_on("[contact_points]\nsurfaces = []\n"), HasSubstr("leaves no face with contact points"));
  EXPECT_EQ(advice_on("[contact_points]\nsurfaces = [\"rock.z1\"]\n"), "");
  EXPECT_EQ(advice_on(""), "");
}

TEST(Unmeant, IsAPenaltyThatIsLoweredForItsPlateau) {
  EXPECT_THAT(advice_on("", {"contact[0].plateau=1 MPa", "contact[0].unloading_exponent=2"}),
              AllOf(HasSubstr("between \"*\" and \"*\" (line "), HasSubstr("acts as 200 MPa, not 1 GPa"),
                    HasSubstr("plateau of 1 MPa begins at an overlap of 0.005 H")));
  EXPECT_EQ(
      advice_on("", {"contact[0].plateau=1 MPa", "contact[0].penalty=200 MPa", "contact[0].unloading_exponent=2"}), "");
  EXPECT_EQ(advice_on("", {"contact[0].unloading_exponent=2"}), "") << "no plateau";
}

TEST(Unmeant, IsAPenaltyTooSoftToStopWhatComesWithinAnElement) {
  EXPECT_THAT(advice_on(kFlying, {"contact[0].penalty=1 kPa"}),
              AllOf(HasSubstr("penalty of 1 kPa between \"rock\" and \"rock\" is too low for 10 m/s"),
                    HasSubstr("more than an element")));
  EXPECT_EQ(advice_on(kFlying), "");
  EXPECT_EQ(advice_on("", {"contact[0].penalty=1 kPa"}), "") << "nothing moves";
}

TEST(Unmeant, IsAPairOfWhichTwoContactsNameOneGroupEach) {
  const auto of_two = [](const std::string& contacts) {
    const std::string lid =
        "[[material]]\ngroup = \"lid\"\nyoung = 1e9\npoisson = 0.2\ndensity = 1000\njoints = \"none\"\n";
    Model model = build_bare_model(case_::read_text(kCubes, {}));
    model.mesh.volume_groups.emplace_back("lid");
    return as_list(start_warnings(case_::read_text(kCubes + lid + contacts, {}), model));
  };
  const auto contact = [](const std::string& between) {
    return "[[contact]]\nbetween = [" + between + "]\npenalty = 1e9\n";
  };
  const std::string tied = contact("\"rock\", \"*\"") + contact("\"lid\", \"*\"");
  EXPECT_THAT(of_two(tied), AllOf(HasSubstr("between \"rock\" and \"lid\" follows contact[2] (line 26), the later one; "
                                            "contact[1] (line 23)"),
                                  testing::Not(HasSubstr("between \"rock\" and \"rock\""))));
  EXPECT_EQ(of_two(tied + contact("\"rock\", \"lid\"")), "") << "the pair by name goes before";
  EXPECT_EQ(of_two(contact("\"rock\", \"*\"")), "");
}

TEST(Unmeant, IsPressingWithoutFriction) {
  const std::string driven = "[[stage.constraint]]\ngroup = \"rock.z1\"\nvelocity = { z = -1 }\n";
  const std::string pressed = "[[stage.constraint]]\ngroup = \"rock.z0\"\nfixed = \"z\"\n" + driven;
  const std::string three = "mesh.raster.boxes=[1, 1, 3]";
  EXPECT_THAT(advice_on(pressed, {three}), AllOf(HasSubstr("has no friction"), HasSubstr("(line ")));
  EXPECT_EQ(advice_on(pressed, {three, "contact[0].friction=0.05"}), "");
  EXPECT_EQ(advice_on(driven, {three}), "") << "nothing is held";
  EXPECT_EQ(advice_on(pressed), "") << "nothing is between the two";
}

/// Three boxes one above the other, the lowest held, the highest driven.
std::string stacked(const std::string& glue, const std::string& more = "",
                    const std::vector<std::string>& overrides = {}) {
  const case_::CaseFolder folder;
  folder.write("boxes.geo",
               "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nBox(2) = {0, 0, 1, 1, 1, 1};\n"
               "Box(3) = {0, 0, 2, 1, 1, 1};\nCoherence;\nPhysical Volume(\"rock\") = Volume{:};\ne = 0.01;\n"
               "Physical Surface(\"top\") = Surface In BoundingBox {-e, -e, 3 - e, 1 + e, 1 + e, 3 + e};\n"
               "Physical Surface(\"bottom\") = Surface In BoundingBox {-e, -e, -e, 1 + e, 1 + e, e};\n"
               "Physical Surface(\"bonds\") = Surface In BoundingBox {-e, -e, 1 - e, 1 + e, 1 + e, 2 + e};\n"
               "MeshSize{:} = 2;\n");
  std::string without_mesh = kCubes.substr(kCubes.find("[[material]]"));
  const std::string none = "\"none\"";  // elements that share nodes have nothing to break
  without_mesh.replace(without_mesh.find(none), none.size(), "\"unbreakable\"");
  const case_::Case input = case_::read_case(
      folder.write("case.toml", "[mesh]\nfile = \"boxes.geo\"\nglue = " + glue + "\n" + without_mesh +
                                    "[[stage.constraint]]\ngroup = \"bottom\"\nfixed = \"z\"\n[[stage.constraint]]\n"
                                    "group = \"top\"\nvelocity = { z = -1 }\n" +
                                    more),
      overrides);
  return as_list(start_warnings(input, build_bare_model(input)));
}

TEST(Unmeant, IsPressingWithoutFrictionOfPartsOfOneSolidOnlyWhereTheyAreBroken) {
  EXPECT_THAT(stacked("false"), HasSubstr("has no friction"));
  EXPECT_EQ(stacked("true"), "") << "the bond holds them sideways";
  EXPECT_THAT(stacked("true", "[joints]\nbroken = [\"bonds\"]\n"), HasSubstr("has no friction"));
  EXPECT_THAT(stacked("true", "[[stage]]\nend = 1\n", {"stage[1].broken=[\"bonds\"]"}), HasSubstr("has no friction"));
}

TEST(Unmeant, IsAnInitialVelocityAlongAxesThatAreHeld) {
  EXPECT_THAT(
      advice_on(kHeld + "fixed = \"xy\"\n" + kFlying),
      AllOf(HasSubstr("The initial velocity of \"rock\""), HasSubstr("is lost along x: stage[0].constraint[0]")));
  EXPECT_THAT(advice_on(kHeld + "velocity = { x = 3 }\n" + kFlying), HasSubstr("is lost along x"));
  EXPECT_EQ(advice_on(kHeld + "velocity = { x = 10 }\n" + kFlying), "") << "it goes on at that velocity";
  EXPECT_EQ(advice_on(kHeld + "fixed = \"yz\"\n" + kFlying), "");
  EXPECT_EQ(advice_on("[[stage.constraint]]\ngroup = \"rock.z0\"\nfixed = \"xyz\"\n" + kFlying), "") << "a part is";
}

TEST(Unmeant, IsAPressureOnABodyThatIsWhollyHeld) {
  const std::string pressure = "[[stage.pressure]]\nsurface = \"rock.z1\"\nvalue = 1e6\n";
  EXPECT_THAT(advice_on(kHeld + "fixed = \"xyz\"\n" + pressure), HasSubstr("stage[0].pressure[0] (line "));
  EXPECT_EQ(advice_on(kHeld + "fixed = \"xy\"\n" + pressure), "");
  EXPECT_EQ(advice_on("[[stage.constraint]]\ngroup = \"rock.z0\"\nfixed = \"xyz\"\n" + pressure), "");
}

TEST(Unmeant, IsAnAbsorbingBoundaryThatIsHeld) {
  const std::string absorbing = "absorbing = [\"rock.z1\"]\n", held = "[[stage.constraint]]\ngroup = \"rock.z1\"\n";
  EXPECT_THAT(advice_on(absorbing + held + "fixed = \"xyz\"\n"), HasSubstr("stage[0].absorbing (line "));
  EXPECT_EQ(advice_on(absorbing + held + "fixed = \"xy\"\n"), "");
  const std::string sides = "[[stage.constraint]]\ngroup = \"rock\"\nfixed = \"xy\"\n";
  EXPECT_THAT(advice_on(absorbing + held + "fixed = \"z\"\n" + sides), HasSubstr("stage[0].absorbing (line "));
}

/// Two cubes side by side that share the nodes of the surface "middle".
const std::string kTwins = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 1, 1, 1};
v() = BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("left") = {1};
Physical Volume("right") = {2};
Physical Surface("middle") = Surface In BoundingBox{0.9, -1, -1, 1.1, 2, 2};
Physical Surface("end") = Surface In BoundingBox{1.9, -1, -1, 2.1, 2, 2};
MeshSize{:} = 1;
)";
std::string twins(const case_::CaseFolder& folder, const std::string& stage) {
  folder.write("twins.geo", kTwins);
  std::string text = "[mesh]\nfile = \"twins.geo\"\nglue = true\n";
  for (const char* group : {"left", "right"})
    text += std::string("[[material]]\ngroup = \"") + group +
            "\"\nyoung = \"1 GPa\"\npoisson = 0.2\ndensity = 1000\njoints = \"none\"\n";
  const case_::Case input = case_::read_case(folder.write("case.toml", text + "[[stage]]\nend = 1\n" + stage));
  return as_list(start_warnings(input, build_bare_model(input)));
}

TEST(Unmeant, IsAPressureBetweenElementsThatShareTheirNodes) {
  const case_::CaseFolder folder;
  const auto pressed = [](const std::string& surface) {
    return "[[stage.pressure]]\nsurface = \"" + surface + "\"\nvalue = \"1 MPa\"\n";
  };
  EXPECT_THAT(twins(folder, pressed("middle")),
              AllOf(HasSubstr("does nothing on 4 of the 4 faces of \"middle\""), HasSubstr("cancel")));
  EXPECT_EQ(twins(folder, pressed("end")), "");
}

TEST(Unmeant, IsAnAbsorbingBoundaryWithinTheModel) {
  const case_::CaseFolder folder;
  EXPECT_THAT(twins(folder, "absorbing = [\"middle\"]\n"), HasSubstr("4 of the 4 faces of \"middle\""));
  EXPECT_EQ(twins(folder, "absorbing = [\"end\"]\n"), "");
}

TEST(Unmeant, IsAnEntryThatOverrulesAnotherInPart) {
  EXPECT_THAT(advice_on("[[stage.constraint]]\ngroup = \"rock.z0\"\nfixed = \"z\"\n"
                        "[[stage.constraint]]\ngroup = \"rock.x0\"\nvelocity = { z = 1 }\n"),
              HasSubstr("overrules stage[0].constraint[0]"));
}

}  // namespace
}  // namespace breccia::start_warnings_test
