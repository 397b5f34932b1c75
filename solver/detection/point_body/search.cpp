#include "detection/point_body/search.hpp"

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "detection/point_body/brute_force.hpp"
#include "detection/point_body/ms.hpp"
#include "detection/point_body/packed_tree.hpp"
#include "detection/point_body/sorted_grid.hpp"

namespace breccia::detection {

std::unique_ptr<PointBodySearch> make_search(Algorithm algorithm, double cell) {
  DEMAND(cell >= 0 && std::isfinite(cell), "contact search with cell size " + std::to_string(cell));
  switch (algorithm) {
    case Algorithm::ms:
      return std::make_unique<Ms>(cell, false);
    case Algorithm::ms_slices:
      return std::make_unique<Ms>(cell, true);
    case Algorithm::sorted_grid:
      return std::make_unique<SortedGrid>(cell);
    case Algorithm::packed_tree:
      return std::make_unique<PackedTree>();
    case Algorithm::brute_force:
      return std::make_unique<BruteForce>();
  }
  DEMAND(false, "unknown detection algorithm " + std::to_string(static_cast<int>(algorithm)));
}

}  // namespace breccia::detection
