#include "case/explain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "case/schema.hpp"
#include "case/topics.hpp"

namespace breccia::case_ {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string message_of_key(const std::string& key) {
  try {
    return "no error but: " + explain(key);
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(Explain, TheOverviewHasALineForEveryKeyAndSection) {
  const std::string text = explain();
  for (const Key& key : schema()) {
    if (key.is_section()) continue;
    EXPECT_THAT(text, HasSubstr("\n  " + std::string(key.name()) + " ")) << key.path;
  }
  for (const char* header :
       {"\n[mesh]\n", "\n[[material]]\n", "\n[[stage.constraint]]\n", "\nfunction\n", "\nfunction.ramp\n"})
    EXPECT_THAT(text, HasSubstr(header));
}

TEST(Explain, AKeyIsFoundByThePathThatSetTakes) {
  EXPECT_EQ(explain("material.glass.joints"), explain("material[].joints"));
  EXPECT_EQ(explain("material[2].joints"), explain("material[].joints"));
}

TEST(Explain, AKeyIsExplainedWithUnitDefaultRangeAndExample) {
  EXPECT_THAT(explain("material[].density"), AllOf(HasSubstr("required"), HasSubstr("kg/m3"), HasSubstr(">= 1e-06"),
                                                   HasSubstr("density = \"2456 kg/m3\"")));
  EXPECT_THAT(explain("time.safety"), AllOf(HasSubstr("0.8"), HasSubstr("> 0 and <= 1"), HasSubstr("safety = 0.5")));
  EXPECT_THAT(explain("joint[].shear_strength"), HasSubstr("as tensile_strength"));
}

TEST(Explain, AChoiceListsItsWords) {
  EXPECT_THAT(explain("detection.algorithm"), HasSubstr("ms, ms_slices, sorted_grid, packed_tree, brute_force"));
}

TEST(Explain, IndicesAndBracketsMayBeLeftOutOrGiven) {
  const std::string text = explain("material[].young");
  EXPECT_EQ(explain("material.young"), text);
  EXPECT_EQ(explain("material[0].young"), text);
  EXPECT_EQ(explain("young"), text);
  EXPECT_EQ(explain("function.ramp.to"), explain("<function>.ramp[].to"));
}

TEST(Explain, ANameOfSeveralKeysExplainsAllOfThem) {
  EXPECT_THAT(explain("penalty"), AllOf(HasSubstr("joint.penalty"), HasSubstr("contact.penalty"),
                                        HasSubstr("sphere.penalty"), Not(HasSubstr("penalty_factor\n"))));
}

TEST(Explain, ASectionListsItsKeys) {
  EXPECT_THAT(explain("sphere"), AllOf(HasSubstr("[sphere]"), HasSubstr("radius"), Not(HasSubstr("young"))));
}

TEST(Explain, AWordOfTheFieldIsAnsweredWithTheKeysThatItStandsFor) {
  for (const auto& [word, key] :
       {std::pair{"process zone", "joint.tensile_strength"}, std::pair{"notch", "joints.broken"},
        std::pair{"symmetry", "stage.constraint.fixed"}, std::pair{"reaction", "output.gauges"},
        std::pair{"cohesive", "joint.softening"}, std::pair{"crack", "joints.broken"},
        std::pair{"fracture energy", "joint.energy_mode_1"}, std::pair{"time step", "time.safety"},
        std::pair{"mass scaling", "material.density"}, std::pair{"rebound", "contact.unloading_exponent"},
        std::pair{"roller", "stage.constraint"}, std::pair{"clamp", "stage.constraint"},
        std::pair{"prescribed velocity", "stage.constraint.velocity"}})
    EXPECT_THAT(message_of_key(word), AllOf(HasSubstr("no error but: " + std::string(word) + "\n"),
                                            testing::ContainsRegex("\n  keys +[^\n]*" + std::string(key))))
        << word;
  const auto answer = [](const std::string& word) { return explain(word).substr(word.size()); };
  EXPECT_EQ(answer("Process_Zones"), answer("process zone"));
  EXPECT_EQ(answer("NOTCHES"), answer("notch"));
  EXPECT_EQ(explain("pressure"), explain("stage.pressure")) << "what is a key is explained as one";
}

TEST(Topics, HaveASentenceAndKeysThatThereAreAndWordsThatAreNoKeys) {
  const auto parts = [](std::string_view list) {
    std::vector<std::string> out;
    std::istringstream in{std::string(list)};
    for (std::string part; std::getline(in, part, '|');) out.push_back(part);
    return out;
  };
  const auto is_path = [](const std::string& path) {
    return std::any_of(schema().begin(), schema().end(), [&](const Key& row) { return plain_path(row.path) == path; });
  };
  for (const Topic& topic : topics()) {
    EXPECT_TRUE(topic.answer.ends_with('.')) << topic.words;
    for (const std::string& key : parts(topic.keys)) EXPECT_TRUE(is_path(key)) << key;
    for (const std::string& word : parts(topic.words)) {
      EXPECT_EQ(topic_of(word), &topic) << word << " is of two";
      EXPECT_TRUE(std::none_of(schema().begin(), schema().end(), [&](const Key& row) { return row.name() == word; }))
          << word;
    }
  }
}

TEST(Explain, AnUnknownKeyNamesTheNearest) {
  EXPECT_THAT(message_of_key("material.yung"), HasSubstr("did you mean material.young"));
  EXPECT_THAT(message_of_key("densty"), HasSubstr("did you mean material.density"));
  EXPECT_THAT(message_of_key("tension"),
              HasSubstr("the word stands in material.tension_cutoff, joint.tensile_strength"));
  EXPECT_THAT(message_of_key("weight"), HasSubstr("the word stands in output.gauges"));
  EXPECT_THAT(message_of_key("energy"), testing::ContainsRegex("stands in joint.energy_mode_1, .*, and [0-9]+ more"));
  EXPECT_THAT(message_of_key("xyzzy"), AllOf(HasSubstr("unknown key"), HasSubstr("mesh, plane, material, joint")));
  EXPECT_THAT(message_of_key(""), HasSubstr("unknown key"));
}

}  // namespace
}  // namespace breccia::case_
