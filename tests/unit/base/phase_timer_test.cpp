#include "base/phase_timer.hpp"

#include <gtest/gtest.h>

namespace breccia::phase_timer_test {
namespace {

TEST(PhaseTimer, AddsUpWhatIsMeasuredOfEachPhaseAndWhatOtherTimersHave) {
  PhaseTimer timer, other;
  timer.add(Phase::sweep, 1.5);
  timer.add(Phase::sweep, 0.25);
  timer.add(Phase::contact, 2.0);
  other.add(Phase::sweep, 4.0);
  timer.add(other);
  EXPECT_EQ(timer.seconds(Phase::sweep), 5.75);
  EXPECT_EQ(timer.seconds(Phase::contact), 2.0);
  EXPECT_EQ(timer.seconds(Phase::insitu), 0.0);
}

TEST(PhaseTimer, HasANameForEveryPhase) {
  for (std::size_t p = 0; p < static_cast<std::size_t>(Phase::count); ++p)
    EXPECT_FALSE(name_of(static_cast<Phase>(p)).empty()) << p;
  EXPECT_EQ(name_of(Phase::insitu), "in situ");
}

}  // namespace
}  // namespace breccia::phase_timer_test
