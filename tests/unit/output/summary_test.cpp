#include "output/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.hpp"
#include "unit/output/temporary_folder.hpp"
#include "unit/output/thrown_message.hpp"

namespace breccia {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

Summary some_summary() {
  Summary s;
  s.title = "glass plate";
  s.version = "0.1.0";
  s.host = "anvil";
  s.status = "complete";
  s.ranks = 3;
  s.steps = 9007199254740993;
  s.simulated_time = 1.0 / 3;
  s.time_step = 2.5e-9;
  s.elements = 66980;
  s.joints = 120001;
  s.broken_joints = 4321;
  s.fragments = 87;
  s.searches = 19;
  s.inverted_elements = 2;
  s.wall_s = 125.25;
  s.element_steps_per_s = 7.5e6;
  s.phases = {{"joints", 25.0}, {"sweep", 75.0}};
  s.energy.kinetic = 2;
  s.energy.joint_mode_1 = 1.5e-3;
  s.energy.external_work = 8;
  s.energy.residual = -4e-6;
  s.energy.residual_relative = -5e-7;
  s.max_rss_bytes = 123456789;
  s.simd = "avx2";
  s.state_hash = "0123456789abcdef";
  return s;
}

TEST(SummaryFile, HoldsEveryFieldUnderItsNameAndNothingElse) {
  const test::TemporaryFolder folder;
  SummarySink(folder / "summary.json").finish(some_summary());
  const auto json = nlohmann::json::parse(test::content_of(folder / "summary.json"));
  const auto expected = nlohmann::json::parse(R"({
    "title": "glass plate", "status": "complete", "version": "0.1.0", "host": "anvil", "simd": "avx2", "ranks": 3,
    "steps": 9007199254740993, "simulated_time": 0.33333333333333331, "time_step": 2.5e-9, "elements": 66980,
    "joints": 120001, "broken_joints": 4321, "fragments": 87, "searches": 19, "inverted_elements": 2, "wall_s": 125.25,
    "element_steps_per_s": 7500000.0, "phases": {"joints": 25.0, "sweep": 75.0},
    "energy": {"kinetic": 2.0, "elastic": 0.0, "joint_elastic": 0.0, "contact_stored": 0.0, "joint_mode_1": 0.0015,
               "joint_mode_2": 0.0, "joint_friction": 0.0, "contact_dissipated": 0.0, "contact_friction": 0.0,
               "viscous": 0.0, "damping": 0.0, "external_work": 8.0, "residual": -4e-6},
    "energy_residual_relative": -5e-7, "max_rss_bytes": 123456789, "state_hash": "0123456789abcdef"})");
  EXPECT_EQ(json, expected) << nlohmann::json::diff(expected, json);
}

TEST(SummaryFile, WritesNullForWhatIsNotFiniteAndReplacesBrokenText) {
  Summary summary = some_summary();
  summary.energy.kinetic = std::numeric_limits<double>::quiet_NaN();
  summary.title = "broken \xff text";
  const auto json = nlohmann::json::parse(summary_json(summary));
  EXPECT_TRUE(json["energy"]["kinetic"].is_null());
  EXPECT_THAT(json["title"].get<std::string>(), HasSubstr("broken "));
}

TEST(SummaryFile, ThrowsOutputErrorWithTheFilesName) {
  const std::string message =
      test::message_of<OutputError>([] { SummarySink("/missing_folder/summary.json").finish(some_summary()); });
  EXPECT_THAT(message, HasSubstr("/missing_folder/summary.json"));
}

TEST(SummaryText, SaysWhatWasDoneInUnitsPeopleUse) {
  const std::string text = summary_text(some_summary());
  EXPECT_THAT(text, HasSubstr("glass plate: complete"));
  EXPECT_THAT(text, HasSubstr("steps of 2.5 ns"));
  EXPECT_THAT(text, ContainsRegex("joints +120,001, 4,321 broken"));
  EXPECT_THAT(text, ContainsRegex("wall time +2 min 5 s"));
  EXPECT_THAT(text, HasSubstr("7.5 M element-steps/s"));
  EXPECT_THAT(text, ContainsRegex("memory +123 MB"));
  EXPECT_THAT(text, ContainsRegex("sweep +1 min 15 s +75.00 %"));
}

TEST(SummaryText, ShowsWhereEveryJouleWent) {
  const std::string text = summary_text(some_summary());
  EXPECT_THAT(text, ContainsRegex("kinetic +2 J +25.00 %"));   // 2 of 8
  EXPECT_THAT(text, ContainsRegex("mode I +1.5 mJ +0.02 %"));  // 1.5e-3 of 8
  EXPECT_THAT(text, ContainsRegex("external work +8 J +100.00 %"));
  EXPECT_THAT(text, ContainsRegex("residual.* -4 uJ +-0.00 %"));
  EXPECT_THAT(text, Not(HasSubstr("damping"))) << "a term that is zero is not worth a line";
}

TEST(ResidentMemory, IsAtLeastWhatThisProcessHolds) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const std::vector<char> used(kBytes, 1);
  EXPECT_GE(max_resident_bytes(), kBytes);
  EXPECT_LT(max_resident_bytes(), std::uint64_t{16} << 30);
  EXPECT_EQ(used.back(), 1);
}

}  // namespace
}  // namespace breccia
