#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "catalyst/pipeline_choice.hpp"

namespace breccia::insitu {

using Point = std::array<double, 3>;

/// The points of a probe, row after row.
[[nodiscard]] std::vector<Point> points_of(const Probe& probe);

/// The tetrahedron in which a point lies.
struct Place {
  static constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::max();
  std::int64_t id = kNowhere;  ///< of the element
  std::int64_t cell = -1;      ///< on this rank
};

/// Finds the tetrahedra in which points lie; on a face between several, or where bodies overlap, that of the smallest
/// id, independent of the order of the search. A point up to 1e-9 of a tetrahedron's height outside counts as inside:
/// none falls between neighbours by round-off.
/// @param corners  (num_cells, 4, 3) m;  @param ids  (num_cells).  O(num_cells log points) and what lies nearby
[[nodiscard]] std::vector<Place> places_of(const std::vector<Point>& points, std::int64_t num_cells,
                                           const double* corners, const std::int64_t* ids);

}  // namespace breccia::insitu
