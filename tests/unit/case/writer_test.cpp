#include "case/writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "case/reader_toml.hpp"
#include "case/schema.hpp"
#include "case_files.hpp"

namespace breccia::case_::writer_test {
namespace {

using testing::HasSubstr;

class Resolved : public testing::TestWithParam<std::string> {};

// Reads a text, then what was written of it, both in the folder of the test.
void expect_round_trip(const std::string& text) {
  const CaseFolder folder;
  folder.write("geometry.geo", "");
  const Case first = read_case(folder.write("case.toml", text));
  Case second = read_case(folder.write("resolved.toml", first.resolved));
  EXPECT_EQ(second.resolved, first.resolved);
  second.file = first.file;
  EXPECT_TRUE(second == first) << first.resolved;
}

TEST_P(Resolved, ReadsBackAsAnEqualCase) { expect_round_trip(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Writer, Resolved,
    testing::Values(minimal, complete,
                    replaced(minimal, "cell_size = \"10 mm\"", "cell_size = 0.1\nkind = \"tetrahedra\""),
                    replaced(minimal, "cell_size = \"10 mm\"",
                             "cell_size = 0.1\nslit = {lower = [0, 0.1, 0], upper = [0.3, 0.1, 0.7]}"),
                    replaced(minimal, "joints = \"none\"", "joints = \"unbreakable\""),
                    minimal + "[plane]\nkind = \"stress\"\naxis = \"y\"\n",
                    "title = \"a \\\"quoted\\\" \\\\ \\u0001 \\n \u00fc\"\n" + minimal));

TEST(Writer, KeysOfAJointAreThoseOfItsSectionToo) {
  Joint joint;
  joint.groups = {"glass", "glass"};
  joint.energy_mode_1 = 12.5;
  const std::vector<WrittenKey> keys = written_keys(joint);
  const auto written = [&](std::string_view path) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const WrittenKey& k) { return k.key->path == path; });
    return found == keys.end() ? WrittenKey{} : *found;
  };
  EXPECT_EQ(written("joint[].group").value, "\"glass\"");
  EXPECT_EQ(written("joint[].energy_mode_1").number, 12.5);
  EXPECT_EQ(written("joint[].energy_mode_1").value, "12.5");
  EXPECT_EQ(written("joint[].points_to_fail").number, 3);
  EXPECT_EQ(written("joint[].weibull_modulus").number, std::nullopt) << "none";
  EXPECT_EQ(keys.back().key->path, "joint[].softening.exponent");
}

TEST(Writer, EveryDefaultIsWrittenOut) {
  const std::string text = write_case(read_text(minimal));
  for (const Key& key : schema()) {
    const bool single = key.path.find("[]") == std::string_view::npos && !key.path.starts_with('<') &&
                        !key.path.starts_with("sphere") && !key.path.starts_with("start.") &&
                        !key.path.starts_with("plane.") && !key.path.starts_with("insitu.live") && !key.is_section();
    if (!single || key.fallback.empty()) continue;
    EXPECT_THAT(text, HasSubstr("\n" + std::string(key.name()) + " = ")) << key.path;
  }
  EXPECT_THAT(text, HasSubstr("\nsafety = 0.8\n"));
  EXPECT_THAT(text, HasSubstr("\nviscosity = 0.0  # Pa s\n"));
  EXPECT_THAT(text, HasSubstr("\nhistory_interval = \"auto\"  # s\n"));
}

TEST(Writer, KeysOfALawAreWrittenForMaterialsThatHaveIt) {
  EXPECT_THAT(write_case(read_text(minimal)), testing::Not(HasSubstr("cohesion")));
  const std::string text =
      write_case(read_text(replaced(minimal, "joints =", "law = \"drucker_prager\"\ncohesion = 1e6\njoints =")));
  EXPECT_THAT(text, HasSubstr("\ncohesion = 1e+06  # Pa\n"));
  EXPECT_THAT(text, HasSubstr("\ntension_cutoff = \"apex\"  # Pa\ncap_pressure = \"none\"  # Pa\n"));
}

TEST(Writer, QuantitiesAreInSi) { EXPECT_THAT(write_case(read_text(minimal)), HasSubstr("\nyoung = 7.5e+10  # Pa\n")); }

TEST(Writer, ADifferenceInAnyPartMakesCasesUnequal) {
  const Case c = read_text(complete);
  Case other = c;
  EXPECT_TRUE(other == c);
  other.stages[0].pressures[0].value.sines[0].phase += 1;
  EXPECT_FALSE(other == c);
}

TEST(Writer, TheResolvedCaseOfOverridesHoldsTheirValues) {
  EXPECT_THAT(read_text(minimal, {"time.max_steps=12"}).resolved, HasSubstr("\nmax_steps = 12\n"));
}

TEST(Writer, TextsOfAnyCharacterAreEscaped) {
  for (const std::string text : {"plain", "\"", "\\", "a\nb\tc", "\x1f", "\x7f", "\u00e9"})
    EXPECT_EQ(parse_toml_value(toml_text(text), "test").text, text);
}

}  // namespace
}  // namespace breccia::case_::writer_test
