#include "output/peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "output/folder/energy_terms.hpp"
#include "output/folder/summary_gauges.hpp"

namespace breccia::peaks_test {
namespace {

const std::vector<case_::HistoryColumn> kColumns{{"", "step"}, {"", "time", "s"}, {"bar", "reaction x", "N"}};

/// Values at 0, 1, 2, ... s.
Peaks of(const std::vector<double>& values) {
  Peaks peaks(kColumns);
  for (std::size_t i = 0; i < values.size(); ++i) peaks.add({0, static_cast<double>(i), values[i]});
  return peaks;
}

TEST(Peaks, FindsTheExtremesAndTheirTimes) {
  const std::vector<PeakReport> reports = of({0, 5, -3, 4}).reports();
  ASSERT_EQ(reports.size(), 1U) << "columns of the model have none";
  EXPECT_EQ(reports[0].gauge, "bar");
  EXPECT_EQ(reports[0].largest, 5);
  EXPECT_EQ(reports[0].largest_at, 1);
  EXPECT_EQ(reports[0].smallest, -3);
  EXPECT_EQ(reports[0].smallest_at, 2);
}

TEST(Peaks, TheFirstPeakIsFollowedByADropOfATenth) {
  EXPECT_FALSE(of({0, 100, 91}).reports()[0].first_peak);
  const PeakReport peak = of({0, 100, 95, 100, 89, 120, 50}).reports()[0];
  ASSERT_TRUE(peak.first_peak);
  EXPECT_EQ(*peak.first_peak, 100);
  EXPECT_EQ(peak.first_peak_at, 1);
  EXPECT_EQ(peak.largest, 120);
}

TEST(Peaks, AForceThatPullsHasAPeakAsWell) {
  const PeakReport peak = of({0, -50, -100, -80, -10}).reports()[0];
  ASSERT_TRUE(peak.first_peak);
  EXPECT_EQ(*peak.first_peak, -100);
  EXPECT_EQ(*of({0, 10, -12}).reports()[0].first_peak, 10) << "a change of sign is a drop";
}

TEST(Peaks, NoiseBeforeTheLoadIsNoPeak) {
  const PeakReport peak = of({0, 5, 1, 40, 100, 60}).reports()[0];
  ASSERT_TRUE(peak.first_peak);
  EXPECT_EQ(*peak.first_peak, 100);
  EXPECT_FALSE(of({0, 5, 1, 60}).reports()[0].first_peak);
}

TEST(Peaks, NotANumberDoesNotCount) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(of({kNan}).reports().empty());
  EXPECT_EQ(of({kNan, 2, kNan, 1}).reports()[0].largest, 2);
}

TEST(Peaks, ContinueFromTheirMemory) {
  Peaks whole = of({0, 100, 85, 3, -2}), part = of({0, 100});
  Peaks continued(kColumns);
  ASSERT_TRUE(continued.restore(part.memory()));
  continued.add({0, 2, 85});
  continued.add({0, 3, 3});
  continued.add({0, 4, -2});
  EXPECT_EQ(continued.memory(), whole.memory());
  EXPECT_FALSE(continued.restore({1, 2, 3}));
}

TEST(Peaks, TheTextLeavesOutComponentsThatDoNotMatter) {
  const std::string text = peaks_text({{"bar", "reaction x", "N", 1300, 7e-5, -10, 1e-5, 1300, 7e-5},
                                       {"bar", "reaction y", "N", 2, 7e-5, -10, 1e-5},
                                       {"bar", "velocity x", "m/s", 2, 7e-5, -10, 1e-5},
                                       {"mouth", "strain", "", 0.5, 7e-5, 0, 0}});
  EXPECT_EQ(
      text,
      "  gauges\n    bar reaction x: largest 1.3 kN at 70 us, smallest -10 N at 10 us, first peak 1.3 kN at 70 us\n"
      "    mouth strain: largest 0.5 at 70 us, smallest 0 at 0 s\n");
  EXPECT_TRUE(peaks_text({}).empty());
}

TEST(Peaks, TheTextSaysHowManyLinesItLeavesOut) {
  const std::vector<PeakReport> many(50, PeakReport{"bar", "strain", "", 1, 0, 0, 0, {}, 0});
  EXPECT_NE(peaks_text(many).find("    and 10 more in summary.json\n"), std::string::npos);
}

TEST(HistoryColumns, EnergiesStandInTheOrderOfTheTerms) {
  const std::vector<case_::HistoryColumn> columns = case_::history_columns({}, {});
  for (std::size_t i = 0; i < kEnergyTerms.size(); ++i) EXPECT_EQ(columns[3 + i].word(), kEnergyTerms[i].name);
}

}  // namespace
}  // namespace breccia::peaks_test
