#include "output/insitu/insitu_pace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace breccia::insitu_pace_test {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A run of 100 us, 2 us of which took 2 s of wall time: 100 s in all.
PaceState at_two_percent() {
  PaceState state{.now = 2e-6, .begin = 0, .end = 100e-6, .last = 2e-6, .elapsed = 2, .interval = 2e-6};
  state.share = 0.02;
  state.cost = 0.1;
  state.spent = 0.2;
  state.done = 2;
  return state;
}

TEST(InSituPace, SpendsWhatIsLeftOfTheBudgetAtEvenDistances) {
  const Spacing spacing = spaced_evenly(at_two_percent());
  EXPECT_EQ(spacing.times, 2 + 18);  // 2 s, of which 0.2 s are gone
  EXPECT_DOUBLE_EQ(spacing.distance, 98e-6 / 18);
  EXPECT_DOUBLE_EQ(spacing.next, 2e-6 + 98e-6 / 18);
  EXPECT_DOUBLE_EQ(spacing.share, 0.02);
}

TEST(InSituPace, ExecutesNoMoreOftenThanAskedFor) {
  PaceState state = at_two_percent();
  state.cost = 1e-3;
  EXPECT_EQ(spaced_evenly(state).times, 2 + 49);
  EXPECT_DOUBLE_EQ(spaced_evenly(state).distance, 2e-6);
}

TEST(InSituPace, KeepsToTheLeastWhateverItCosts) {
  PaceState state = at_two_percent();
  state.cost = 10;
  EXPECT_EQ(spaced_evenly(state).next, kInfinite);
  state.least = 20;
  EXPECT_EQ(spaced_evenly(state).times, 2 + 19);  // 98 us of the 100 us
  state.interval = 25e-6;
  EXPECT_EQ(spaced_evenly(state).times, 2 + 3) << "as often as it is asked for at most";
}

TEST(InSituPace, HasAWholeRunWithAllItsPausesOfAboutTheBudget) {
  constexpr double kSteps = 1000, kStep = 0.1, kCost = 0.25, kStart = 0.5;  // s
  double wall = 0, next = 0, spent = 0;
  int done = 0;
  double longest = 0, last = 0;
  for (double step = 0; step < kSteps; ++step) {
    wall += kStep * (step < 300 ? 1 : 3);  // cracks make steps dearer
    const double now = step / kSteps;
    if (now + 0.5 / kSteps >= next) {
      if (done > 1) longest = std::max(longest, now - last);
      last = now;
      const double cost = done == 0 ? kStart + kCost : kCost;
      wall += cost;
      spent += cost;
      next = now + 0.02;
      ++done;
    } else if (std::fmod(step, 20) != 0) {
      continue;
    }
    if (done < 2) continue;
    PaceState state{
        .now = now, .begin = 0, .end = 1, .last = last, .elapsed = wall, .starts = kStart, .interval = 0.02};
    state.share = 0.02;
    state.cost = kCost;
    state.spent = spent;
    state.done = done;
    next = spaced_evenly(state).next;
  }
  spent += kCost;  // the end
  EXPECT_NEAR(spent / wall, 0.02, 0.002);
  EXPECT_LT(longest, 0.25) << "no part of the run is left out";
}

TEST(InSituPace, CountsTheStartOnce) {
  PaceState state = at_two_percent();
  state.starts = 1;
  EXPECT_DOUBLE_EQ(expected_wall(state), 51);
}

TEST(InSituPace, PartsOfABudgetAreEvenButForThoseWhoNeedLess) {
  EXPECT_THAT(parts_of_budget(9, {kInfinite, 1, kInfinite, 2}), ElementsAre(3, 1, 3, 2));
  EXPECT_THAT(parts_of_budget(9, {1, 2}), ElementsAre(1, 2));
  EXPECT_THAT(parts_of_budget(9, {0, kInfinite}), ElementsAre(0, 9));
}

TEST(InSituPace, IsToldInOneLine) {
  PaceState state = at_two_percent();
  EXPECT_EQ(pace_text("stress", "picture", spaced_evenly(state), state),
            "stress: a picture every 5.44 us, 20 in all, for 2 % of the wall time; one every 2 us would take more than "
            "its part of insitu.max_overhead");
  state.cost = 1;
  state.least = 20;
  EXPECT_THAT(pace_text("stress", "picture", spaced_evenly(state), state),
              HasSubstr("21 in all, for 19 % of the wall time, more than its part of insitu.max_overhead, 2 %: "
                        "insitu.least_instants = 20"));
}

}  // namespace
}  // namespace breccia::insitu_pace_test
