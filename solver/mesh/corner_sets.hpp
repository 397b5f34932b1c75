#pragma once

#include <array>
#include <bit>
#include <cstddef>

#include "base/types.hpp"

namespace breccia {

/// Sets of the corners of an element: bit m stands for the set whose corners are the bits of m, m = 1 to 14.
using CornerSets = Index;

inline constexpr unsigned kNumCornerSets = 15;  ///< m is below

/// Calls f(m) for every set, ascending.
template <class F>
void for_each_set(CornerSets sets, F&& f) {
  constexpr unsigned kAll = (1U << kNumCornerSets) - 2;
  for (unsigned left = static_cast<unsigned>(sets) & kAll; left != 0; left &= left - 1)
    f(static_cast<unsigned>(std::countr_zero(left)));
}

/// Of the sets of one or two corners of an element, ascending: how far each corner lies behind a plane through the set,
/// m; all zero where there is none. No element of six meshes with 54,000 had more of them than so many at rest; further
/// ones have none.
inline constexpr std::size_t kMostSides = 4;
using SideRows = std::array<std::array<double, 4>, kMostSides>;

/// Calls f(m, place among the sets of one or two corners, or -1) for every set, ascending.
template <class F>
void for_each_side(CornerSets sets, F&& f) {
  int small = 0;
  for_each_set(sets, [&](unsigned m) { f(m, std::popcount(m) < 3 ? small++ : -1); });
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

}  // namespace breccia
