#pragma once

#include <array>
#include <bit>
#include <cstddef>

#include "base/types.hpp"

namespace breccia {

/// Sets of the corners of an element: bit m stands for the set whose corners are the bits of m, m = 1 to 14.
using CornerSets = Index;

inline constexpr unsigned kNumCornerSets = 15;  ///< m is below
inline constexpr CornerSets kAllSets = (1 << kNumCornerSets) - 2;

/// Set of the corners of the face opposite to a corner.
[[nodiscard]] constexpr unsigned face_set(std::size_t opposite) { return 15U ^ 1U << opposite; }

/// Calls f(m) for every set, ascending.
template <class F>
void for_each_set(CornerSets sets, F&& f) {
  for (auto left = static_cast<unsigned>(sets & kAllSets); left != 0; left &= left - 1)
    f(static_cast<unsigned>(std::countr_zero(left)));
}

/// Whether some set has all corners of m.
[[nodiscard]] inline bool covers(CornerSets sets, unsigned m) {
  bool covered = false;
  for_each_set(sets, [&](unsigned other) { covered = covered || (other & m) == m; });
  return covered;
}

/// Those sets that no other one covers.
[[nodiscard]] inline CornerSets largest_sets(CornerSets sets) {
  CornerSets kept = 0;
  for_each_set(sets, [&](unsigned m) {
    if (!covers(sets & ~(1 << m), m)) kept |= 1 << m;
  });
  return kept;
}

/// How far each corner of an element lies behind some sides of the surface, m; the rows in use come first.
inline constexpr std::size_t kMostSides = 6;
using SideRows = std::array<std::array<double, 4>, kMostSides>;

}  // namespace breccia
