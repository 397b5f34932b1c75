#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/communicator.hpp"
#include "state/records.hpp"

namespace breccia {

/// Longest edge of each element in the present state, m.
[[nodiscard]] std::vector<double> longest_edges(const Records& mine);

/// Largest and mean size of the elements of all ranks, m. @param size  of this rank's. Collective.
struct Sizes {
  double largest = 0, mean = 0;
};
[[nodiscard]] Sizes sizes_of_all(const Communicator& communicator, std::span<const double> size);

/// Largest size among the elements up to so many rings away from each of this rank's, itself included, m. Elements that
/// share a vertex of the mesh are one ring apart, regardless of motion and fracture. Collective.
/// @param vertices  (elements) of their corners, >= 0;  @param size  (elements) m
/// O(rings elements log elements); a rank sends its vertices to ranks that keep ranges of them.
[[nodiscard]] std::vector<double> sizes_around(const Communicator& communicator,
                                               std::span<const std::array<GlobalId, 4>> vertices,
                                               std::vector<double> size, int rings);

}  // namespace breccia
