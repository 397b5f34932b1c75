#pragma once

#include <cstddef>
#include <cstdint>

namespace breccia::detection {

/// The part of PackedTree that is compiled once for each instruction set. Nothing but plain arrays here: a function of
/// a library compiled with other flags must not replace that of the rest of the program.

/// Packed tree, see PackedTree. `boxes` holds groups of 8 boxes: low x of the eight, low y, low z, high x, high y, high
/// z.
struct PackedTreeView {
  const float* boxes;          ///< (groups, 6, 8), the lowest level first
  const std::size_t* level;    ///< (num_levels) first group of each level
  int num_levels;              ///< 0: no points
  const double* leaves;        ///< (leaves, 3, 8) x, y, z of eight points; NaN where there is none
  const std::int32_t* points;  ///< (leaves, 8) their numbers
};

/// A contactor's couple test (couple_test.hpp) as plain numbers.
struct PackedQuery {
  float low[3], high[3];           ///< enlarged box in the coordinates of the tree's boxes
  double box_low[3], box_high[3];  ///< enlarged box, m
  double origin[3];
  double normal[4][3], limit[4];  ///< planes
  bool has_planes;
};

/// Room for the numbers of groups and leaves, each for all leaves and 8 more.
struct PackedFrontier {
  std::uint32_t* now;
  std::uint32_t* next;
};

/// Leaves whose boxes meet the query's, in `frontier.now`. @return how many
using PackedLeaves = std::size_t (*)(const PackedTreeView& tree, const PackedQuery& query, PackedFrontier& frontier);
/// Points of these leaves that pass the couple test. @param hits  room for 8 (count + 1)  @return how many
using PackedPoints = std::size_t (*)(const PackedTreeView& tree, const PackedQuery& query, const std::uint32_t* leaves,
                                     std::size_t count, std::int32_t* hits);

struct PackedKernel {
  PackedLeaves leaves;
  PackedPoints points;
};

extern const PackedKernel packed_kernel_sse2;
extern const PackedKernel packed_kernel_avx2;

/// For a mask of eight bits the numbers of those that are set, ascending, then zeros.
struct SetBits {
  alignas(32) std::int32_t of[256][8];
};

constexpr SetBits make_set_bits() {
  SetBits bits{};
  for (int mask = 0; mask < 256; ++mask) {
    int count = 0;
    for (int bit = 0; bit < 8; ++bit) {
      if ((mask >> bit & 1) != 0) bits.of[mask][count++] = bit;
    }
  }
  return bits;
}

extern const SetBits set_bits;

}  // namespace breccia::detection
