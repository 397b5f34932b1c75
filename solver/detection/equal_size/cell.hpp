#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/types.hpp"

namespace breccia::detection {

/// Cell that holds the centre of a body: floor(x / edge) along each of D axes, with cells as wide as the largest body.
/// @tparam Coordinate  int16_t as published, where every cell fits, or int32_t
template <int D, std::signed_integral Coordinate>
using Cell = std::array<Coordinate, static_cast<std::size_t>(D)>;

/// Contact detection of bodies of similar size, from the cells of their centres alone.
///
///   S search;                                  keeps its arrays, and any order it found, for the next call
///   search.detect(cells, visit);               visit(Index a, Index b) for every pair of bodies whose cells are the
///   same or
///                                              touch (26 neighbours in 3D): each pair once, a != b, in any order
///   search.bytes()                             memory of its own arrays now, without the caller's cells
///   S::name                                    "nbs", ...
///
/// Every algorithm visits exactly this set of pairs, so the choice changes the speed only. The number of bodies and
/// their cells may change freely from call to call; any coordinate of the type is allowed, its limits included. The
/// visitor is a template argument: a call for each pair through a pointer would cost more than most of the searches.
template <class S, int D, class Coordinate>
concept EqualSizeSearch = requires(S search, const S& constant, std::span<const Cell<D, Coordinate>> cells) {
  search.detect(cells, [](Index, Index) {});
  { constant.bytes() } -> std::same_as<std::size_t>;
  { S::name } -> std::convertible_to<std::string_view>;
};

}  // namespace breccia::detection
