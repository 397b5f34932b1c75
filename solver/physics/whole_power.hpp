#pragma once

namespace breccia {

/// x^n, n >= 0, by squaring: faster than pow, and the same bits on every machine.
[[nodiscard]] inline double whole_power(double x, int n) {
  double result = 1.0;
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) result *= x;
    x *= x;
  }
  return result;
}

}  // namespace breccia
