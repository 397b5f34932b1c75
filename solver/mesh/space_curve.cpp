#include "mesh/space_curve.hpp"

namespace breccia {

std::uint64_t hilbert_rank(std::array<std::uint32_t, 3> x) {
  // From the coarsest level down, undo the reflection and exchange of axes that the curve applies to each octant.
  for (std::uint32_t level = 1u << (kHilbertBits - 1); level > 1; level >>= 1) {
    const std::uint32_t below = level - 1;
    for (std::uint32_t& coordinate : x) {
      if ((coordinate & level) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t exchange = (x[0] ^ coordinate) & below;
        x[0] ^= exchange;
        coordinate ^= exchange;
      }
    }
  }
  // Gray code of the octants' numbers.
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t level = 1u << (kHilbertBits - 1); level > 1; level >>= 1) {
    if ((x[2] & level) != 0) flip ^= level - 1;
  }
  for (std::uint32_t& coordinate : x) coordinate ^= flip;

  std::uint64_t rank = 0;
  for (int bit = kHilbertBits - 1; bit >= 0; --bit) {
    for (const std::uint32_t coordinate : x) rank = (rank << 1) | ((coordinate >> bit) & 1u);
  }
  return rank;
}

}  // namespace breccia
