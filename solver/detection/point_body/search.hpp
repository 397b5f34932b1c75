#pragma once

#include <array>
#include <compare>
#include <memory>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace breccia::detection {

/// A contact point and a tetrahedron that may touch before the next search.
struct Couple {
  Index point;
  Index contactor;
  auto operator<=>(const Couple&) const = default;
};

/// Corners of a contactor, positively oriented, m.
using Corners = std::array<Vec3, 4>;

/// Contact detection of points (targets) against tetrahedra (contactors).
///
/// A couple is a point that lies (1) in the contactor's bounding box enlarged by `buffer` on every side and (2) no
/// farther than `buffer` outside the plane of each of its faces. Every algorithm returns exactly this set, so the
/// choice changes the speed only, never a result. While no point and no corner has moved by more than buffer / 2, every
/// point that is inside a tetrahedron belongs to a couple.
///
/// An element that is crushed flat or inverted (computed volume not positive) has no outside: for it (1) alone decides.
/// Points and contactors with a coordinate that is not finite have no couples.
class PointBodySearch {
 public:
  virtual ~PointBodySearch() = default;
  PointBodySearch() = default;
  PointBodySearch(const PointBodySearch&) = delete;
  PointBodySearch& operator=(const PointBodySearch&) = delete;

  /// @param points      (num_points) positions, m
  /// @param contactors  (num_contactors) corners, m
  /// @param buffer      m, >= 0
  /// @param couples     out: sorted by (point, contactor); its old content is dropped, its storage kept
  /// Repeated searches of like size allocate nothing. Throws InternalError if the buffer is negative or not finite.
  virtual void search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
                      std::vector<Couple>& couples) = 0;
};

enum class Algorithm {
  ms,           ///< MS-tree and MS-search over the contactor's cell box
  ms_slices,    ///< the same with the box cut into slices that hug the tetrahedron
  sorted_grid,  ///< points sorted by cell, cells found by hash
  packed_tree,  ///< points in a packed tree of boxes along a Hilbert curve
  brute_force   ///< every pair: the oracle
};

/// @param cell  m, size of the space cells of ms, ms_slices and sorted_grid; 0: chosen at every search from the
/// contactors'
///              mean size and the buffer. It changes the speed only. Throws InternalError if negative or not finite.
[[nodiscard]] std::unique_ptr<PointBodySearch> make_search(Algorithm algorithm, double cell);

}  // namespace breccia::detection
