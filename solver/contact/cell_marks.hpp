#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/extent.hpp"

namespace breccia {

/// Cells of a region, some of them marked: a cheap test for boxes that may come near to any of many others.
class CellMarks {
 public:
  /// @param cell  m, > 0: edge of the cells; longer where there would be more than kMostCells along an axis
  CellMarks(const Extent& region, double cell);

  /// Marks the cells that come within `distance` of the box, m >= 0.
  void mark(const Extent& box, double distance);
  /// Whether the box touches a marked cell. Never false if it comes within the distance of a box that has been marked,
  /// up to round-off. @pre box lies in the region
  [[nodiscard]] bool any(const Extent& box) const;

  static constexpr std::int64_t kMostCells = 128;

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell_of(const Vec3& x) const;
  template <class Use>
  void each(const Cell& low, const Cell& high, Use&& use) const;

  Extent region_;
  Cell cells_{0, 0, 0};       ///< along each axis; 0: the region is empty, or not finite: everything counts as marked
  Vec3 per_length_{0, 0, 0};  ///< cells a metre
  bool bounded_ = false;
  std::vector<std::uint8_t> marks_;
};

}  // namespace breccia
