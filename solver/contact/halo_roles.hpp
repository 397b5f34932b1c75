#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/extent.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// What an element on which this rank evaluates no forces may do in couples that act on one on which it does.
enum class HaloRole : std::uint8_t {
  none,
  contactor,             ///< be touched by points of the latter: it is no further than twice the buffer away
  contactor_and_points,  ///< touch and be touched by an evaluated element: no further than the buffer away
};

// In buffers: how far points in couples with evaluated elements are from these at most, and what is in couples with
// such points. A little more for round-off.
inline constexpr double kPointReach = 1.01, kContactorReach = 2.02;

/// The roles of all elements in couples that a search with this buffer may find.
/// @param extents  (num_slots) boxes around the elements; those that are not evaluated and whose position is not known
/// are empty
/// @param cell  m, > 0: of the cells by which the neighbourhood is found
/// @param roles  out: (num_slots) HaloRole::none for evaluated elements. O(num_slots).
void find_halo_roles(const ContactState& contact, std::span<const Extent> extents, double buffer, double cell,
                     std::vector<HaloRole>& roles);

}  // namespace breccia
