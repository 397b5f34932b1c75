#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace breccia {

/// Where elements count as lying when space is divided. A small fragment, or a small body that is still whole, lies
/// where its elements are on average, so that all of it goes to one domain: what is cut has elements on both sides that
/// are computed twice, or sent. A fragment is small if it has no more than a sixteenth of the elements of a domain, is
/// no wider than proxies reach anyway, and lies on this rank altogether; elements of others lie at their own centroids.
/// @param centroid    (elements)
/// @param neighbours  (elements) by face: an element of these that it hangs together with, or as FaceLink, kFree or
/// kBeyond
/// @param fair_share  elements of a domain, on average;  @param reach  m, of proxies
/// O(elements).
[[nodiscard]] std::vector<Vec3> places_of_fragments(std::span<const Vec3> centroid,
                                                    std::span<const std::array<Index, 4>> neighbours, double fair_share,
                                                    double reach);

}  // namespace breccia
