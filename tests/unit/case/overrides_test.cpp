#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_files.hpp"

namespace breccia::case_::overrides_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Overrides, AKeyOfAListIsReachedByItsIndex) {
  EXPECT_EQ(read_text(complete, {"material[1].young=70e9"}).materials[1].young, 70e9);
}

TEST(Overrides, AKeyOfAListIsReachedByGroupNameAndSurface) {
  const Case c =
      read_text(complete, {"material.glass.young=70 GPa", "stage.impact.end=50 us",
                           "stage.impact.constraint.grip.velocity.y=-2 mm/s", "stage.impact.pressure.slit.value=5"});
  EXPECT_EQ(c.materials[0].young, 70e9);
  EXPECT_EQ(c.stages[0].end, 50e-6);
  EXPECT_EQ(c.stages[0].constraints[1].value[1].constant, -0.002);
  EXPECT_EQ(c.stages[0].pressures[0].value.constant, 5);
}

TEST(Overrides, AnOverrideReplacesTheWholeValue) {
  const Case c = read_text(complete, {"stage[0].pressure[0].value=5"});
  EXPECT_EQ(c.stages[0].pressures[0].value, (TimeFunction{.constant = 5, .linear = 0, .sines = {}, .table = {}}));
}

TEST(Overrides, BareWordsAreTexts) {
  EXPECT_EQ(read_text(minimal, {"detection.algorithm=ms"}).detection.algorithm, DetectionAlgorithm::ms);
  EXPECT_EQ(read_text(minimal, {"title=A plate of glass"}).title, "A plate of glass");
  EXPECT_EQ(read_text(minimal, {"title=\"12\""}).title, "12");
}

TEST(Overrides, ValuesMayBeListsAndTables) {
  EXPECT_EQ(read_text(minimal, {"mesh.raster.cells=[1, 2, 3]"}).mesh.raster->cells, (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(read_text(complete, {"joint[0].softening={kind = \"linear\"}"}).joints[0].softening, Softening::linear);
  EXPECT_TRUE(read_text(minimal, {"detection.verify=true"}).detection.verify);
}

TEST(Overrides, SpacesAroundTheEqualsSignDoNotMatter) {
  EXPECT_EQ(read_text(minimal, {"time.max_steps = 12"}).time.max_steps, 12);
}

TEST(Overrides, SectionsThatTheFileLacksAreMade) {
  const Case c = read_text(minimal, {"sphere.radius=1 m", "sphere.penalty=1 GPa"});
  ASSERT_TRUE(c.sphere.has_value());
  EXPECT_EQ(c.sphere->radius, 1);
}

TEST(Overrides, ParametersOfTheGeometryAndElementsOfAVectorAreReached) {
  EXPECT_EQ(read_text(complete, {"mesh.parameters.h=1 mm"}).mesh.parameters.at("h"), 1) << "scale = 0.001";
  EXPECT_EQ(read_text(complete, {"mesh.parameters.h=1 mm", "mesh.scale=1"}).mesh.parameters.at("h"), 0.001);
  EXPECT_EQ(read_text(complete, {"mesh.parameters.fresh=4"}).mesh.parameters.at("fresh"), 4);
  EXPECT_EQ(read_text(complete, {"stage[0].gravity[1]=3"}).stages[0].gravity[1].constant, 3);
  EXPECT_EQ(read_text(complete, {"stage[0].gravity[2].ramp.to=-1"}).stages[0].gravity[2](1), -1);
}

TEST(Overrides, TheLastOfTwoWins) {
  EXPECT_EQ(read_text(minimal, {"time.max_steps=1", "time.max_steps=2"}).time.max_steps, 2);
}

TEST(Overrides, AnUnknownPathNamesTheNearestKey) {
  EXPECT_THAT(message_of(minimal, {"material[0].yung=3"}),
              AllOf(HasSubstr("--set: material[0].yung: unknown key; did you mean material[].young"),
                    HasSubstr("keys of material[]: group, law, young")));
  EXPECT_THAT(message_of(minimal, {"tim.step=3"}), HasSubstr("did you mean time"));
  EXPECT_THAT(message_of(minimal, {"<function>.constant=3"}), HasSubstr("is no key"));
  EXPECT_THAT(message_of(minimal, {"=3"}), HasSubstr("is no key"));
  EXPECT_THAT(message_of(minimal, {"material..young=3"}), HasSubstr("no entry of the list has this name"));
}

TEST(Overrides, ANameThatFitsNoEntryListsTheNames) {
  EXPECT_THAT(message_of(complete, {"material.glas.young=3"}),
              AllOf(HasSubstr("no entry of the list has this name"), HasSubstr("glass, projectile, frame")));
  EXPECT_THAT(message_of(replaced(complete, "group = \"grip\"", "group = \"support\""),
                         {"stage[0].constraint.support.fixed=x"}),
              HasSubstr("several entries of the list have this name"));
}

TEST(Overrides, OfTwoNamesThatFitTheLongerIsMeant) {
  const std::string text = replaced(complete, "name = \"rest\"", "name = \"impact.rest\"");
  const Case c = read_text(text, {"stage.impact.rest.end=3 ms", "stage.impact.end=50 us"});
  EXPECT_EQ(c.stages[0].end, 50e-6);
  EXPECT_EQ(c.stages[1].end, 3e-3);
}

TEST(Overrides, AnIndexPastTheEndSaysHowManyThereAre) {
  EXPECT_THAT(message_of(minimal, {"material[3].young=3"}),
              AllOf(HasSubstr("index 3 is past the end"), HasSubstr("0 to 0")));
  EXPECT_THAT(message_of(minimal, {"contact[0].penalty=3"}), HasSubstr("the list has no entries"));
  EXPECT_THAT(message_of(minimal, {"material[x].young=3"}), HasSubstr("no whole number in its brackets"));
  EXPECT_THAT(message_of(minimal, {"material[0"}), HasSubstr("no \"=\""));
  EXPECT_THAT(message_of(minimal, {"material[0=1"}), HasSubstr("no whole number in its brackets"));
  EXPECT_THAT(message_of(minimal, {"material[0]young=3"}), HasSubstr("cannot be read at \"young\""));
}

TEST(Overrides, AValueIsCheckedAsInTheFile) {
  EXPECT_THAT(message_of(minimal, {"material[0].density=-1"}),
              HasSubstr("--set: material[0].density: is out of range"));
  EXPECT_THAT(message_of(minimal, {"material[0].density=3 m"}), HasSubstr("length, not density"));
  EXPECT_THAT(message_of(minimal, {"time.step.size=3"}), HasSubstr("has no keys below it"));
  EXPECT_THAT(message_of(minimal, {"mesh.raster.cells=[1, 2"}), HasSubstr("not a TOML value"));
  EXPECT_THAT(message_of(minimal, {"time.max_steps=1\nother=2"}), HasSubstr("more than one value"));
}

TEST(Overrides, AFailingOverrideLeavesNoHalfMadeSectionBehind) {
  const std::string message = message_of(minimal, {"sphere.radis=1"});
  EXPECT_THAT(message, HasSubstr("did you mean sphere.radius"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
}

}  // namespace
}  // namespace breccia::case_::overrides_test
