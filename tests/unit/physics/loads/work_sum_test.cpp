#include <gtest/gtest.h>
#include <cmath>

#include "base/work_sum.hpp"

namespace breccia::work_sum_test {
namespace {

TEST(WorkSum, OfALinearSpringIsItsEnergyExactly) {
  constexpr double kStiffness = 7, kMass = 0.3, kStep = 0.05;
  constexpr double kRounding = 1e-12;  // of the energy, a few thousand steps of a few ulps
  double x = 1.0, v = 0.2;
  const double start = 0.5 * kStiffness * x * x;
  WorkSum work;
  double first_total = 0;
  for (int step = 0; step < 2000; ++step) {
    const double force = -kStiffness * x, v_before = v;
    v += kStep * force / kMass;
    work.add_before(force * v_before, step == 0 ? 0.0 : kStep);
    ASSERT_NEAR(work.sum().value(), start - 0.5 * kStiffness * x * x, kRounding * start) << "step " << step;
    const double total = 0.5 * kMass * v_before * v + 0.5 * kStiffness * x * x;
    if (step == 0) first_total = total;
    ASSERT_NEAR(total, first_total, kRounding * start) << "step " << step;
    work.add_after(force * v, kStep);
    x += kStep * v;
  }
}

}  // namespace
}  // namespace breccia::work_sum_test
