#pragma once

#include <array>
#include <cstddef>

#include "base/index.hpp"

namespace breccia {

/// Width of a block: elements and nodes are stored in blocks of eight (AoSoA), one cache line a component.
inline constexpr Index kLanes = 8;

/// Numbers of the corners of a block's elements: [corner][axis][lane].
inline constexpr std::size_t kBlockCorners = std::size_t{4} * 3 * kLanes;
using BlockCorners = std::array<double, kBlockCorners>;

/// Place of component `axis` of node `node` in a nodal field of 3 components: blocks [3][8].
[[nodiscard]] constexpr std::size_t nodal(Index node, int axis) {
  const auto n = static_cast<std::size_t>(node);
  return (n / 8) * 24 + static_cast<std::size_t>(axis) * 8 + n % 8;
}

/// Node of corner c of an element that owns its four nodes. With this numbering the nodal fields of element block k are
/// the 96 doubles [corner][axis][lane] from 96 k on, so the same array serves kernels that sweep blocks of elements and
/// access to single nodes.
[[nodiscard]] constexpr Index own_corner_node(Index element, int corner) {
  return (element / kLanes) * (4 * kLanes) + corner * kLanes + element % kLanes;
}

/// n rounded up to whole blocks.
[[nodiscard]] constexpr Index padded(Index n) { return (n + kLanes - 1) / kLanes * kLanes; }

}  // namespace breccia
