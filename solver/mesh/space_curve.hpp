#pragma once

#include <array>
#include <cstdint>

namespace breccia {

/// Bits a coordinate of `hilbert_rank`: a grid of 2^20 cells along each axis.
inline constexpr int kHilbertBits = 20;

/// Place along the three-dimensional Hilbert curve of a cell of the grid of 2^kHilbertBits cells an axis. Cells with
/// consecutive ranks share a face. Source: J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707 (2004) 381.
/// @pre every coordinate is below 2^kHilbertBits. O(kHilbertBits), throws nothing.
[[nodiscard]] std::uint64_t hilbert_rank(std::array<std::uint32_t, 3> cell);

}  // namespace breccia
