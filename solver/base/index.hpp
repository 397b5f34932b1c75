#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace breccia {

/// Local index of an element, node, joint or contact point on one rank.
using Index = std::int32_t;
/// Identity of an entity in the whole model, the same on any number of ranks.
using GlobalId = std::int64_t;

/// Where the entity of an index or id stands in an array. @pre 0 <= i
template <std::integral I>
[[nodiscard]] constexpr std::size_t at(I i) {
  return static_cast<std::size_t>(i);
}

}  // namespace breccia
