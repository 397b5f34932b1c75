#pragma once

#include <span>
#include <vector>

#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// Brings couples found contactor by contactor into the order (point, contactor): by counting over the points, then,
/// where contactors did not come in ascending order, among the few couples of a point. Keeps its storage between calls.
class CoupleSorter {
 public:
  /// @param found       couples, each once
  /// @param num_points  points are 0..num_points-1
  /// @param sorted      out: the same couples by (point, contactor); a vector of its own
  /// O(found log(most couples of a point) + num_points), without the logarithm where contactors ascend.
  void sort(std::span<const Couple> found, std::size_t num_points, std::vector<Couple>& sorted);

 private:
  std::vector<std::size_t> next_;  ///< (num_points) where the next couple of a point goes
};

}  // namespace breccia::detection
