#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "physics/material/exponential.hpp"

namespace breccia::material::exponential_test {
namespace {

constexpr double kRounding = 1e-15;  // relative

TEST(Logarithm, IsThatOfTheLibraryToRoundOff) {
  for (double d = -0.99; d < 100; d += 0.0137) {
    EXPECT_NEAR(logarithm_1p(d), std::log1p(d), kRounding * std::abs(std::log1p(d))) << d;
  }
  for (const double d : {1e-300, 1e-20, -1e-12, 3e-7, -0.28999, -0.29001, 0.40999, 0.41001, 1e300}) {
    EXPECT_NEAR(logarithm_1p(d), std::log1p(d), kRounding * std::abs(std::log1p(d))) << d;
  }
  EXPECT_EQ(logarithm_1p(0.0), 0.0);
}

TEST(Exponential, IsThatOfTheLibraryToRoundOff) {
  for (double x = -20; x < 20; x += 0.00713) {
    EXPECT_NEAR(exponential_m1(x), std::expm1(x), kRounding * (std::abs(x) < 0.35 ? std::abs(x) : std::exp(x) + 1))
        << x;
  }
  for (const double x : {1e-300, 1e-20, -1e-12, 0.34999, 0.35001, -0.35001}) {
    EXPECT_NEAR(exponential_m1(x), std::expm1(x), kRounding * std::abs(x)) << x;
  }
  EXPECT_EQ(exponential_m1(0.0), 0.0);
}

TEST(Exponential, UndoesTheLogarithm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-0.9, 3.0);
  for (int i = 0; i < 1000; ++i) {
    const double d = any(random);
    EXPECT_NEAR(exponential_m1(logarithm_1p(d)), d, 4 * kRounding * (1 + std::abs(d))) << d;
  }
}

}  // namespace
}  // namespace breccia::material::exponential_test
