#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "verification/recorder.hpp"

namespace breccia::test {
namespace {

TEST(Recording, with_a_residual_that_is_no_number_passes_no_limit) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Recording recording;
  for (const double residual : {1e-6, kNan, 2e-6}) {
    recording.rows.emplace_back();
    recording.rows.back().energy.residual_relative = residual;
  }
  EXPECT_TRUE(std::isnan(recording.worst_residual()));
  EXPECT_FALSE(recording.worst_residual() < 1e-3);
  recording.rows.erase(recording.rows.begin() + 1);
  EXPECT_EQ(recording.worst_residual(), 2e-6);
}

}  // namespace
}  // namespace breccia::test
