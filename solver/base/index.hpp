#pragma once

#include <cstdint>

namespace breccia {

/// Local index of an element, node, joint or contact point on one rank.
using Index = std::int32_t;
/// Identity of an entity in the whole model, the same on any number of ranks.
using GlobalId = std::int64_t;

}  // namespace breccia
