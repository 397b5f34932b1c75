#pragma once

#include <cstdint>

#include "output/frames/frame.hpp"

namespace breccia::test {

/// A square plate (normal y, 100 x 100 x 5 mm) of cubes of 24 tetrahedra under a small block, cracked along rays and
/// rings up to a radius that grows with time: frames that look like a run without being one.
struct SyntheticPlate {
  int cubes = 20;       ///< along x and z; one through the thickness
  double end = 100e-6;  ///< s, when the cracks reach the rim

  /// Elements: 24 (cubes^2 + 8), the last 192 of them the block. Every array is filled and has the size Frame asks for.
  [[nodiscard]] Frame frame(std::int64_t number, double time) const;
};

/// One of `count` pieces of nearly equal size: consecutive elements, joints and contacts.
[[nodiscard]] Frame piece_of(const Frame& whole, int number, int count);

}  // namespace breccia::test
