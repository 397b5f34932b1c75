#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace breccia::detection {

/// Place of a cell on the Hilbert curve through a cube of 4^pairs cells an edge. Cells that follow one another on the
/// curve share a face, so objects in its order are near in memory when they are near in space. Source: [Hamilton 2006],
/// the curve of three axes with equal numbers of bits; its 12 orientations stand in a table of two binary digits of x,
/// y and z a step.
class HilbertCurve {
 public:
  static constexpr int most_pairs = 5;  ///< 10 bits an axis

  /// @param x, y, z  0 .. 4^pairs - 1   @param pairs  1 .. most_pairs
  /// @return  0 .. 64^pairs - 1. O(pairs)
  [[nodiscard]] static std::uint32_t place(std::uint32_t x, std::uint32_t y, std::uint32_t z, int pairs) {
    const std::uint32_t digits = spread(x) | spread(y) << 1 | spread(z) << 2;
    std::uint32_t step = 0, place = 0;
    for (int shift = 6 * (pairs - 1); shift >= 0; shift -= 6) {
      step = steps[(step & ~63U) | (digits >> shift & 63)];
      place = place << 6 | (step & 63);
    }
    return place;
  }

 private:
  static constexpr std::uint32_t num_orientations = 12;
  /// (orientation, two bits of x, y and z) -> next orientation << 6 | place among 64
  using Steps = std::array<std::uint16_t, std::size_t{64} * num_orientations>;
  static const Steps steps;
  static constexpr Steps make_steps();

  /// The ten bits of x at every third place.
  static std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16) & 0x030000FF;
    x = (x | x << 8) & 0x0300F00F;
    x = (x | x << 4) & 0x030C30C3;
    return (x | x << 2) & 0x09249249;
  }
};

}  // namespace breccia::detection
