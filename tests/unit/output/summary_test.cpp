#include "output/folder/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "unit/output/temporary_folder.hpp"

namespace breccia::summary_test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

Summary example_summary() {
  Summary summary;
  summary.title = "glass";
  summary.version = "0.1.0";
  summary.host = "node7";
  summary.status = "complete";
  summary.steps = 10000;
  summary.simulated_time = 1e-4;
  summary.time_step = 1e-8;
  summary.elements = 67597;
  summary.joints = 130000;
  summary.broken_joints = 2310;
  summary.fragments = 120;
  summary.searches = 17;
  summary.wall_s = summary.span_s = 125;
  summary.element_steps_per_s = 1.32e7;
  summary.phases = {{"sweep", 75.0}, {"contact", 25.0}};
  summary.energy.kinetic = 0.225;
  summary.energy.residual = -1e-6;
  summary.energy.residual_relative = 4.4e-6;
  summary.max_rss_bytes = 151'000'000;
  summary.simd = "avx2";
  summary.state_hash = "0123456789abcdef";
  return summary;
}

std::vector<std::string> names_of(const json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

TEST(SummaryJson, HasExactlyTheFieldsThatReadersKnow) {
  const json summary = json::parse(summary_json(example_summary()));
  EXPECT_THAT(names_of(summary),
              UnorderedElementsAre("title", "status", "version", "host", "simd", "ranks", "steps", "simulated_time",
                                   "time_step", "elements", "joints", "broken_joints", "fragments", "searches",
                                   "inverted_elements", "wall_s", "element_steps_per_s", "phases", "energy",
                                   "energy_residual_relative", "max_rss_bytes", "state_hash", "decompositions",
                                   "imbalance", "messages", "message_bytes", "checkpoints"));
  EXPECT_THAT(names_of(summary.at("energy")),
              UnorderedElementsAre("kinetic", "elastic", "joint_elastic", "contact_stored", "joint_mode_1",
                                   "joint_mode_2", "joint_friction", "contact_dissipated", "contact_friction",
                                   "plastic", "viscous", "damping", "external_work", "step_change", "residual"));
}

TEST(SummaryJson, HoldsTheValues) {
  const json summary = json::parse(summary_json(example_summary()));
  EXPECT_EQ(summary.at("phases"), json({{"sweep", 75.0}, {"contact", 25.0}}));
  EXPECT_EQ(summary.at("energy").at("kinetic"), 0.225);
  EXPECT_EQ(summary.at("energy").at("residual"), -1e-6);
  EXPECT_EQ(summary.at("energy_residual_relative"), 4.4e-6);
  EXPECT_EQ(summary.at("simulated_time"), 1e-4);
  EXPECT_EQ(summary.at("elements"), 67597);
  EXPECT_EQ(summary.at("searches"), 17);
  EXPECT_EQ(summary.at("state_hash"), "0123456789abcdef");
  EXPECT_EQ(summary.at("max_rss_bytes"), 151'000'000);
}

TEST(SummaryJson, TellsTheShareOfPipelinesAndOfTheirStarts) {
  Summary summary = example_summary();
  summary.wall_s = 1000;
  summary.span_s = 100;
  for (const char* name : {"surface", "stress"}) {
    PipelineReport pipeline;
    pipeline.name = name;
    pipeline.start_s = 30;
    pipeline.seconds = 1.5;
    summary.insitu.push_back(pipeline);
  }
  EXPECT_DOUBLE_EQ(json::parse(summary_json(summary)).at("insitu").at("share").get<double>(), 0.63);
  EXPECT_DOUBLE_EQ(json::parse(summary_json(summary)).at("insitu").at("start_share").get<double>(), 0.6);
  EXPECT_THAT(summary_text(summary), HasSubstr("63.00 % of the wall time, 60.00 % to start"));
}

TEST(SummaryJson, TellsApartWhatARunTookAndWhatItTookSinceItWentOn) {
  Summary summary = example_summary();
  EXPECT_THAT(summary_text(summary), HasSubstr("2 min 5 s\n"));
  summary.resumed_at = 9000;
  summary.span_s = 5;
  EXPECT_EQ(json::parse(summary_json(summary)).at("wall_s"), 125);
  EXPECT_EQ(json::parse(summary_json(summary)).at("since_resume"), json({{"step", 9000}, {"wall_s", 5.0}}));
  EXPECT_THAT(summary_text(summary), HasSubstr("2 min 5 s; 5.00 s since the resume at step 9,000"));
}

TEST(SummaryJson, IsValidWithNumbersThatJsonCannotHold) {
  Summary summary = example_summary();
  summary.energy.kinetic = std::numeric_limits<double>::infinity();
  summary.title = "\xff";
  EXPECT_TRUE(json::parse(summary_json(summary)).at("energy").at("kinetic").is_null());
}

/// Shares of round-off would look like a fault.
TEST(SummaryText, GivesSharesOfEnergiesThatAreMoreThanRoundOff) {
  Summary summary = example_summary();
  summary.energy.is_round_off = false;
  EXPECT_THAT(summary_text(summary), AllOf(HasSubstr("energy, share of the largest term\n"), HasSubstr("100.00 %\n")));
  summary.energy.kinetic = 1e-21;
  summary.energy.residual = -8.2e-22;
  summary.energy.is_round_off = true;
  const std::string text = summary_text(summary);
  EXPECT_THAT(text, HasSubstr("no more than round-off, 1.00e-21 J\n"));
  EXPECT_THAT(text, Not(HasSubstr("82.00 %")));
}

TEST(SummaryFile, IsWrittenAtTheEnd) {
  const test::TemporaryFolder folder;
  SummarySink(folder / "summary.json", folder / "summary.txt").finish(example_summary());
  EXPECT_EQ(json::parse(test::content_of(folder / "summary.json")).at("steps"), 10000);
  EXPECT_EQ(test::content_of(folder / "summary.txt"), summary_text(example_summary()));
  EXPECT_THROW(SummarySink(folder / "missing/a", folder / "summary.txt").finish(example_summary()), OutputError);
  EXPECT_THROW(SummarySink(folder / "summary.json", folder / "missing/a").finish(example_summary()), OutputError);
}

TEST(SummaryText, SpeaksInUnitsThatPeopleUse) {
  const std::string text = summary_text(example_summary());
  for (const char* part : {"glass: complete", "100 us in 10,000 steps of 10 ns", "67,597", "130,000, 2,310 broken",
                           "2 min 5 s", "13.2 M element-steps/s", "151 MB", "75.00 %", "225 mJ", "4.40e-06",
                           "node7, 1 rank, avx2", "0123456789abcdef"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(MaxResident, IsWhatThisProcessNeedsAtLeast) {
  const std::vector<char> used(64 << 20, 1);  // touched, so resident
  EXPECT_GE(max_resident_bytes(), used.size());
  std::ifstream status("/proc/self/status");
  double kib = 0;
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) kib = std::stod(line.substr(6));
  }
  constexpr double kPages = 0.01;  // the kernel counts some pages later
  EXPECT_NEAR(static_cast<double>(max_resident_bytes()) / (1024 * kib), 1.0, kPages);
}

}  // namespace
}  // namespace breccia::summary_test
