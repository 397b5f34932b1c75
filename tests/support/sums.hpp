#pragma once

#include <array>

#include "base/exact_sum.hpp"
#include "base/types.hpp"

namespace breccia::test {

inline Vec3 value_of(const std::array<ExactSum, 3>& sums) {
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

}  // namespace breccia::test
