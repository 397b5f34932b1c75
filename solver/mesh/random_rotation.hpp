#pragma once

#include <cstdint>

#include "base/types.hpp"

namespace breccia {

/// Number k of the stream `stream` of a seed: SplitMix64 used as a counter-based generator. Source: Steele, Lea, Flood,
/// Fast splittable pseudorandom number generators, OOPSLA 2014.
[[nodiscard]] std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t k);

/// A rotation drawn uniformly over all rotations, the same for the same (seed, stream) on every machine: only integer
/// arithmetic, + - * / and sqrt. Source: Marsaglia, Choosing a point from the surface of a sphere, Ann. Math. Stat. 43
/// (1972) 645: a uniform unit quaternion from two points in the unit disc.
[[nodiscard]] Mat3 random_rotation(std::uint64_t seed, std::uint64_t stream);

}  // namespace breccia
