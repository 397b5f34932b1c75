#include "simulation/recent_pace.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace breccia::recent_pace_test {
namespace {

TEST(RecentPace, IsThatOfTheLastQuarterOfTheRun) {
  RecentPace pace;
  pace.begin({0, 0, 0});
  RecentPace::Pace now;
  // A thousandth a second and 10 steps, then a tenth of that.
  for (int s = 2; s <= 400; s += 2) now = pace.follow({1.0 * s, 1e-3 * s, 10 * s}, false);
  EXPECT_NEAR(now.share_per_s, 1e-3, 1e-12);
  EXPECT_NEAR(now.steps_per_s, 10, 1e-9);
  for (int s = 2; s <= 200; s += 2) now = pace.follow({400.0 + s, 0.4 + 1e-4 * s, 4000 + s}, false);
  EXPECT_NEAR(now.share_per_s, 1e-4, 1e-12);
  EXPECT_NEAR(now.steps_per_s, 1, 1e-9);
}

TEST(RecentPace, IsThatOfAllAtFirst) {
  RecentPace pace;
  pace.begin({5, 0, 100});
  EXPECT_EQ(pace.follow({5, 0, 100}, false).steps_per_s, 0) << "not known yet";
  EXPECT_DOUBLE_EQ(pace.follow({7, 0.02, 300}, false).share_per_s, 0.01);
  EXPECT_DOUBLE_EQ(pace.follow({15, 0.05, 500}, false).steps_per_s, 40);
}

TEST(RecentPace, DoesNotCountTheFirstStep) {
  RecentPace pace;
  pace.begin({0, 0, 0});
  EXPECT_EQ(pace.follow({3, 1e-4, 1}, false).share_per_s, 0) << "not known yet";
  EXPECT_DOUBLE_EQ(pace.follow({4, 0.1001, 1001}, false).share_per_s, 0.1);
}

TEST(RecentPace, DoesNotCountAPause) {
  RecentPace pace;
  pace.begin({0, 0, 0});
  std::ignore = pace.follow({10, 0.1, 100}, false);
  EXPECT_DOUBLE_EQ(pace.follow({500, 0.1, 100}, true).share_per_s, 0.01);
  EXPECT_DOUBLE_EQ(pace.follow({1000, 0.1, 100}, true).share_per_s, 0.01);
  EXPECT_DOUBLE_EQ(pace.follow({1010, 0.3, 400}, false).share_per_s, 0.02);
}

}  // namespace
}  // namespace breccia::recent_pace_test
