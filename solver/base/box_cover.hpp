#pragma once

#include <span>
#include <vector>

#include "base/extent.hpp"

namespace breccia {

/// Boxes, at most kMostBoxes, which between them cover all of the given ones: what bends, or lies in pieces, is covered
/// with less room between than by one. Empty boxes need no cover. O(boxes log kMostBoxes).
[[nodiscard]] std::vector<Extent> cover(std::span<const Extent> boxes);

inline constexpr std::size_t kMostBoxes = 32;

/// Whether the box is near to any of those (Extent::near).
[[nodiscard]] bool near_any(const Extent& box, std::span<const Extent> boxes, double distance);

}  // namespace breccia
