#pragma once

#include <vector>

#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// Brings couples found contactor by contactor into the order (point, contactor) by counting.
/// Keeps its storage between calls.
class CoupleSorter {
 public:
  /// @param found       couples with contactors in ascending order
  /// @param num_points  points are 0..num_points-1
  /// @param sorted      out: the same couples by (point, contactor); a vector of its own
  /// O(found + num_points).
  void sort(const std::vector<Couple>& found, std::size_t num_points, std::vector<Couple>& sorted);

 private:
  std::vector<std::size_t> next_;  ///< (num_points) where the next couple of a point goes
};

}  // namespace breccia::detection
