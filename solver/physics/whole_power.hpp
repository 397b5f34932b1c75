#pragma once

namespace breccia {

/// x^n, n >= 0, by squaring: faster than pow, and the same bits on every machine.
template <class T>
[[nodiscard]] inline T whole_power(T x, int n) {
  T result = 1.0;
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) result *= x;
    x *= x;
  }
  return result;
}

}  // namespace breccia
