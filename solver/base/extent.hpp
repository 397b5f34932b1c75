#pragma once

#include <limits>

#include "base/types.hpp"

namespace breccia {

/// Box around positions, m; empty: lower is +infinity, upper -infinity, near to nothing.
struct Extent {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;

  void add(const Vec3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  void add(const Extent& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  [[nodiscard]] bool empty() const { return !(lower[0] <= upper[0]); }
  /// No further than this along any axis.
  [[nodiscard]] bool near(const Extent& other, double distance) const {
    return ((lower - other.upper).array() <= distance).all() && ((other.lower - upper).array() <= distance).all();
  }
};

/// @param positions  any range of Vec3
template <class Positions>
[[nodiscard]] Extent extent_of(const Positions& positions) {
  Extent extent;
  for (const Vec3& x : positions) extent.add(x);
  return extent;
}

}  // namespace breccia
