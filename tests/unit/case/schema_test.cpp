#include "case/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"
#include "case/reader_toml.hpp"
#include "case/reader_values.hpp"
#include "case/units.hpp"

namespace breccia::case_::schema_test {
namespace {

using testing::ElementsAre;

// Reads a text as the value of a key and returns the complaints.
std::vector<Problem> problems_of(Key key, std::string_view written) {
  std::vector<Problem> problems;
  ValueReader reader(problems, "/folder");
  std::string unit(key.unit);
  if (unit.starts_with('*'))
    unit = "m/s2" + unit.substr(1);  // the value's unit in function keys; that of their examples
  if (key.path == "<function>.constant" || key.path == "<function>.sine[].amplitude") unit = "Pa";
  if (key.path == "<function>.linear") unit = "Pa/s";
  if (key.path == "<function>.table") unit = "m";
  key.unit = unit;
  const Node node = parse_toml_value(written, "example");
  const std::string path(key.path);
  const auto as = [&](auto out) { reader.read(key, node, path, out); };
  switch (key.type) {
    case ValueType::section:
    case ValueType::section_list:
    case ValueType::notation:
      break;
    case ValueType::number:
      as(double{});
      break;
    case ValueType::integer:
      as(std::int64_t{});
      break;
    case ValueType::boolean:
      as(bool{});
      break;
    case ValueType::text:
    case ValueType::text_or_list:
      as(std::string{});
      break;
    case ValueType::choice:
      (void)reader.read_choice(key, node, path);
      break;
    case ValueType::path:
      as(std::filesystem::path{});
      break;
    case ValueType::column:
      as(FileColumn{});
      break;
    case ValueType::axes:
      as(std::array<bool, 3>{});
      break;
    case ValueType::text_list:
      as(std::vector<std::string>{});
      break;
    case ValueType::text_pair:
      as(std::array<std::string, 2>{});
      break;
    case ValueType::number_pair:
      as(std::array<double, 2>{});
      break;
    case ValueType::vector:
    case ValueType::vector_or_number:
      as(Vec3(0, 0, 0));
      break;
    case ValueType::integers_or_one:
      as(std::array<int, 3>{});
      break;
    case ValueType::function:
      as(TimeFunction{});
      break;
    case ValueType::function_vector:
      as(std::array<TimeFunction, 3>{});
      break;
    case ValueType::axis_functions: {
      std::array<bool, 3> axes{};
      std::array<TimeFunction, 3> functions;
      reader.read_axes(key, node, path, axes, functions);
      break;
    }
    case ValueType::parameters:
      as(std::map<std::string, double>{});
      break;
    case ValueType::settings:
      as(std::map<std::string, Setting>{});
      break;
    case ValueType::points: {
      Node table;
      table.entries.emplace_back("table", node);
      TimeFunction f;
      reader.read(key, table, path, f);
      break;
    }
  }
  return problems;
}

std::string text_of(const std::vector<Problem>& problems) { return InputError(problems).what(); }

TEST(Schema, EveryDefaultIsAllowedByItsOwnRow) {
  for (const Key& key : schema()) {
    if (key.fallback.empty() || key.fallback.starts_with('=')) continue;
    const auto problems = problems_of(key, key.fallback);
    EXPECT_TRUE(problems.empty()) << text_of(problems);
  }
}

TEST(Schema, EveryKeyHasAnExampleThatItsOwnRowAllows) {
  for (const Key& key : schema()) {
    if (key.is_section()) continue;
    const auto problems = problems_of(key, key.example);
    EXPECT_TRUE(problems.empty() && !key.example.empty()) << key.path << "\n" << text_of(problems);
  }
}

TEST(Schema, EveryRowIsExplainedBySentences) {
  for (const Key& key : schema()) EXPECT_TRUE(key.help.ends_with('.')) << key.path;
}

TEST(Schema, EveryKeyStandsBelowTheRowOfItsSection) {
  for (const Key& key : schema()) EXPECT_TRUE(key.section().empty() || find_key(key.section()) != nullptr) << key.path;
}

TEST(Schema, NoKeyIsRequiredAndGivenADefaultAtOnce) {
  for (const Key& key : schema()) EXPECT_FALSE(key.required && !key.fallback.empty()) << key.path;
}

TEST(Schema, EveryChoiceHasAtLeastTwoWords) {
  for (const Key& key : schema())
    EXPECT_TRUE(key.type != ValueType::choice || key.choice_list().size() >= 2) << key.path;
}

TEST(Schema, NoPathStandsTwice) {
  std::set<std::string_view> seen;
  for (const Key& key : schema()) EXPECT_TRUE(seen.insert(key.path).second) << key.path;
}

TEST(Schema, EveryUnitCanBeRead) {
  for (const Key& key : schema())
    EXPECT_NO_THROW((void)dimension_of(key.unit.starts_with('*') ? "1" : key.unit)) << key.path;
}

TEST(Schema, ReferencesToOtherKeysNameARowOfTheirSection) {
  for (const Key& key : schema()) {
    if (!key.fallback.starts_with('=')) continue;
    EXPECT_NE(find_key(std::string(key.section()) + "." + std::string(key.fallback.substr(2))), nullptr) << key.path;
  }
}

TEST(Schema, IndicesDropOutOfAPattern) {
  EXPECT_EQ(pattern_of("stage[0].constraint[12].fixed"), "stage[].constraint[].fixed");
  EXPECT_EQ(pattern_of("title"), "title");
}

TEST(Schema, RangesIncludeTheirClosedEndsOnly) {
  const Range half_open{.lower = 0, .upper = 1, .lower_open = true};
  EXPECT_FALSE(half_open.contains(0));
  EXPECT_TRUE(half_open.contains(1));
  EXPECT_FALSE(half_open.contains(1.001));
  EXPECT_EQ(half_open.text(), "> 0 and <= 1");
  EXPECT_EQ(Range{}.text(), "");
}

TEST(Schema, SimilarKeysOfTheSameSectionComeFirst) {
  EXPECT_EQ(similar_keys("contact[].penalti", 1).front(), "contact[].penalty");
  EXPECT_EQ(similar_keys("sphere.penalti", 1).front(), "sphere.penalty");
  EXPECT_EQ(similar_keys("mesh.density", 1).front(), "material[].density");
  EXPECT_TRUE(similar_keys("mesh.colour", 3).empty());
}

TEST(Schema, NamesOfASectionLeaveOutOtherSections) {
  EXPECT_THAT(names_in("sphere"), ElementsAre("centre", "radius", "penalty"));
  EXPECT_THAT(names_in("stage[].pressure[]"), ElementsAre("surface", "value"));
}

}  // namespace
}  // namespace breccia::case_::schema_test
