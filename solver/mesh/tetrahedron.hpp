#pragma once

#include <array>
#include <cstddef>

namespace breccia {

/// Corners of face f, the face opposite to corner f, counter-clockwise seen from outside a positively oriented element:
/// (x1-x0) x (x2-x0) of these three points outwards.
inline constexpr std::array<std::array<int, 3>, 4> kFaceCorners{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Corner (0..3) of the neighbour that meets corner i (0..2) of the own face; code as in FaceLink (mesh/topology.hpp).
[[nodiscard]] constexpr int matching_corner(int code, int i) {
  return kFaceCorners[static_cast<std::size_t>(code / 3)][static_cast<std::size_t>((code % 3 - i + 3) % 3)];
}

}  // namespace breccia
