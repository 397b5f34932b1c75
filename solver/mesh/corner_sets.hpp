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

/// How far each corner of an element lies behind some sides of the surface, m: those of its sets of one or two corners,
/// ascending, all zero where there is none; with kExact num_planes() of them, each a function of the overlap.
/// Further ones are left out.
inline constexpr std::size_t kMostSides = 6;
using SideRows = std::array<std::array<double, 4>, kMostSides>;

/// Beside the sets, of an element that cannot break: its overlap is the least distance to the sides of the surface
/// around it (mesh/surface_planes.hpp) and not made of the sets.
inline constexpr CornerSets kExact = 1 << kNumCornerSets;
inline constexpr int kPlanesBit = 16;
[[nodiscard]] constexpr CornerSets with_planes(std::size_t count) {
  return static_cast<CornerSets>(count) << kPlanesBit;
}
[[nodiscard]] constexpr std::size_t num_planes(CornerSets sets) { return static_cast<std::size_t>(sets) >> kPlanesBit; }

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
