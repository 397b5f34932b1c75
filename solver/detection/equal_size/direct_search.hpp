#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "detection/equal_size/cell.hpp"

namespace breccia::detection {

/// Direct search (DS): every pair of bodies is compared. The oracle of the other searches.
/// Source: thesis, chapter 4. O(N^2) time, no memory. The visitor's exceptions pass through.
template <int D, std::signed_integral Coordinate>
class DirectSearch {
 public:
  static constexpr std::string_view name = "direct_search";

  template <class Visit>
  void detect(std::span<const Cell<D, Coordinate>> cells, Visit&& visit) {
    for (std::size_t a = 1; a < cells.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (touch(cells[a], cells[b])) visit(static_cast<Index>(a), static_cast<Index>(b));
      }
    }
  }

  std::size_t bytes() const { return 0; }

 private:
  static bool touch(const Cell<D, Coordinate>& a, const Cell<D, Coordinate>& b) {
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
      const std::int64_t apart = std::int64_t{a[axis]} - b[axis];
      if (apart < -1 || apart > 1) return false;
    }
    return true;
  }
};

}  // namespace breccia::detection
