#pragma once

#include <cmath>

namespace breccia::material {

/// ln(1 + d) for d > -1, relative error below 1e-15, without loss of digits around 0. Plain arithmetic, not the
/// library's logarithm, whose last bit depends on the processor.
/// ln m = 2 atanh(s), s = (m - 1) / (m + 1), by its series for |s| < 0.172.
[[nodiscard]] inline double logarithm_1p(double d) {
  double s = d / (2.0 + d), whole = 0;
  if (!(d > -0.29 && d < 0.41)) {
    int exponent = 0;
    double m = std::frexp(1.0 + d, &exponent);
    if (m < 0.70710678118654752440) {
      m *= 2.0;
      --exponent;
    }
    s = (m - 1.0) / (m + 1.0);
    whole = exponent;
  }
  const double q = s * s;
  double sum = 1. / 21;
  for (const double term : {1. / 19, 1. / 17, 1. / 15, 1. / 13, 1. / 11, 1. / 9, 1. / 7, 1. / 5, 1. / 3}) {
    sum = sum * q + term;
  }
  const double small = 2.0 * s * (1.0 + q * sum);
  constexpr double kHigh = 0x1.62e42fefa38p-1, kLow = 0x1.ef35793c7673p-45;  // of ln 2: whole * kHigh is exact
  return whole * kHigh + (whole * kLow + small);
}

/// e^x - 1, relative error below 1e-15 around 0, absolute error 1e-15 e^x elsewhere; |x| < 700.
[[nodiscard]] inline double exponential_m1(double x) {
  constexpr double kHigh = 0x1.62e42fefa38p-1, kLow = 0x1.ef35793c7673p-45;
  const double whole = x > -0.35 && x < 0.35 ? 0.0 : std::nearbyint(x * 1.4426950408889634074);
  const double r = (x - whole * kHigh) - whole * kLow;
  double sum = 1. / 15;
  for (const double divisor : {14., 13., 12., 11., 10., 9., 8., 7., 6., 5., 4., 3., 2.})
    sum = (sum * r + 1.0) / divisor;
  const double small = r + r * r * sum;
  return whole == 0 ? small : std::ldexp(1.0 + small, static_cast<int>(whole)) - 1.0;
}

}  // namespace breccia::material
