#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/raster_case.hpp"
#include "unit/advice/advice_of.hpp"
#include "unit/case/case_files.hpp"

namespace breccia::model_rules_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kContact = "[[contact]]\nbetween = [\"*\", \"*\"]\npenalty = \"40 GPa\"\n";

std::string raster(const std::array<int, 3>& boxes, const std::array<int, 3>& cells = {1, 1, 1}) {
  return test::raster_case(
      {.group = "rock", .cells = cells, .boxes = boxes, .gap = 1e-3, .young = 40e9, .density = 2400});
}

std::string advice_on(const std::string& text) {
  const case_::Case input = case_::read_text(text);
  const Model model = build_model(input);
  return test::advice_of({"unit_of_lengths", "bodies_without_contact", "fragments_without_contact", "slender_layer",
                          "raster_planes", "slice_without_plane", "small_sphere"},
                         Subject(input, model));
}

TEST(ModelAdvice, NamesBodiesThatMeetWithoutContact) {
  EXPECT_THAT(advice_on(raster({2, 1, 1})), HasSubstr("There is no [[contact]]"));
}

TEST(ModelAdvice, IsSilentWhereThereIsContactOrOneBodyOrAllAreHeld) {
  EXPECT_EQ(advice_on(raster({2, 1, 1}) + kContact), "");
  EXPECT_EQ(advice_on(raster({1, 1, 1})), "");
  const std::string held = "[[stage.constraint]]\ngroup = \"rock\"\nfixed = \"xyz\"\n";
  EXPECT_EQ(advice_on(raster({2, 1, 1}) + held), "");
}

TEST(ModelAdvice, NamesWhatCanBreakWhereThereIsNoContact) {
  const std::string breakable = "[[joint]]\ngroup = \"rock\"\ntensile_strength = 1e6\nenergy_mode_1 = 10\n";
  std::string text = raster({1, 1, 1}) + breakable;
  text.replace(text.find("\"none\""), 6, "\"breakable\"");
  EXPECT_THAT(advice_on(text), HasSubstr("no [[contact]], and rock can break"));
  EXPECT_EQ(advice_on(text + kContact), "");
}

TEST(ModelAdvice, SaysOfASolidOfARasterThatCanBreakHowItsJointsLie) {
  const std::string joint = "[[joint]]\ngroup = \"rock\"\ntensile_strength = 1e6\nenergy_mode_1 = 10\n";
  const auto breakable = [&](const std::array<int, 3>& cells) {
    std::string text = raster({1, 1, 1}, cells);
    text.replace(text.find("\"none\""), 6, "\"breakable\"");
    return advice_on(text + joint + kContact);
  };
  EXPECT_THAT(breakable({3, 4, 3}), HasSubstr("planes of few directions"));
  EXPECT_EQ(breakable({9, 1, 3}), "") << "a bar or a plate";
  EXPECT_EQ(advice_on(raster({1, 1, 1}, {3, 4, 3}) + kContact), "") << "nothing can break";
}

TEST(ModelAdvice, NamesTheThicknessThatFitsTheElementsOfAPlaneModel) {
  const auto layer = [](const std::string& thickness) {
    std::string text = raster({1, 1, 1}) + "[plane]\nkind = \"strain\"\n";
    const std::string size = "cell_size = 0.01";
    return advice_on(text.replace(text.find(size), size.size(), "cell_size = [0.01, 0.01, " + thickness + "]"));
  };
  EXPECT_EQ(layer("0.01"), "");
  EXPECT_THAT(layer("0.03"), AllOf(HasSubstr("30 mm thick"), HasSubstr("about 7.07 mm is best")));
  EXPECT_THAT(layer("0.002"), HasSubstr("2 mm thick"));
}

TEST(ModelAdvice, TellsOfPlaneModelsWhereTheMeshIsOneThinLayerWhoseSidesAreFree) {
  const auto layer = [](const std::array<int, 3>& cells, const std::string& more) {
    return advice_on(raster({1, 1, 1}, cells) + more);
  };
  const std::string words = "one layer of elements across ";
  EXPECT_THAT(layer({6, 6, 1}, ""), AllOf(HasSubstr(words + "z"), HasSubstr("[plane] kind = \"stress\" excludes")));
  EXPECT_THAT(layer({6, 1, 6}, ""), AllOf(HasSubstr(words + "y"), HasSubstr("axis = \"y\"")));
  for (const std::array<int, 3>& cells : {std::array{12, 12, 2}, {4, 4, 1}, {6, 1, 1}})
    EXPECT_EQ(layer(cells, ""), "") << testing::PrintToString(cells);
  for (const char* more : {"[plane]\nkind = \"strain\"\n", "gravity = [0, 0, -9.81]\n",
                           "[[stage.constraint]]\ngroup = \"rock\"\nfixed = \"z\"\n",
                           "[[stage.constraint]]\ngroup = \"rock.x1\"\nvelocity = { z = 1 }\n",
                           "[[stage.pressure]]\nsurface = \"rock.z1\"\nvalue = 1e6\n",
                           "[[stage.traction]]\nsurface = \"rock.x1\"\nvalue = [0, 0, 1e6]\n",
                           "[[initial_velocity]]\ngroup = \"rock\"\nvelocity = [0, 0, 1]\n"})
    EXPECT_EQ(layer({6, 6, 1}, more), "") << more;
  EXPECT_THAT(layer({6, 6, 1}, "[[stage.pressure]]\nsurface = \"rock.x1\"\nvalue = 1e6\n"), HasSubstr(words));
}

TEST(ModelAdvice, NamesASphereThatDoesNotHoldTheModelAndTheRadiusThatWould) {
  const auto sphere = [](const std::string& radius) {
    return "[sphere]\ncentre = [\"5 mm\", \"5 mm\", \"5 mm\"]\nradius = \"" + radius + "\"\npenalty = \"40 GPa\"\n";
  };
  EXPECT_THAT(advice_on(raster({1, 1, 1}) + sphere("8 mm")),
              AllOf(HasSubstr("sphere does not enclose the model"), HasSubstr("0.00866 m")));
  EXPECT_EQ(advice_on(raster({1, 1, 1}) + sphere("9 mm")), "");
}

}  // namespace
}  // namespace breccia::model_rules_test
