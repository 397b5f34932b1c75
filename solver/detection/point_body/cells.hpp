#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "base/types.hpp"
#include "detection/point_body/couple_test.hpp"

namespace breccia::detection {

/// Integer coordinates of space cells: floor(x / size), negative coordinates included, Source: [Schiava, eq. (6.3)]
/// with floor in the place of truncation, which would make the cell around 0 twice as wide.
///
/// Beyond +-2^30 cells the coordinate stays at that bound. `of` never decreases with x, so the cells of a point in a
/// box always lie between the cells of the box's corners, for any round-off.
class Cells {
 public:
  static constexpr std::int32_t bound = 1 << 30;

  /// @param size  m, > 0; sizes outside 1e-150..1e150 are brought back into it
  explicit Cells(double size) : size_(std::clamp(size, 1e-150, 1e150)), inverse_(1 / size_) {}

  [[nodiscard]] double size() const { return size_; }

  /// @pre x is finite
  [[nodiscard]] std::int32_t of(double x) const {
    const double scaled = std::clamp(x * inverse_, -static_cast<double>(bound), static_cast<double>(bound));
    const auto truncated = static_cast<std::int32_t>(scaled);
    return truncated - (static_cast<double>(truncated) > scaled ? 1 : 0);
  }

 private:
  double size_;
  double inverse_;
};

/// Range of cells that the enlarged box of a contactor touches, both ends included; x, y, z.
struct CellBox {
  std::array<std::int32_t, 3> low, high;
};

/// @pre !test.skipped()
[[nodiscard]] inline CellBox cell_box(const Cells& cells, const CoupleTest& test) {
  CellBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    box.low[axis] = cells.of(test.low()[k]);
    box.high[axis] = cells.of(test.high()[k]);
  }
  return box;
}

/// Cell size, m: `share` of the geometric mean of the contactors' enlarged box widths (the mean over the three axes),
/// from an even sample of at most 4,096 contactors. The geometric mean, because a few large contactors among many small
/// ones must not make the cells large. 1 if no contactor is finite and has a width. O(1).
[[nodiscard]] double choose_cell(std::span<const Corners> contactors, double buffer, double share);

}  // namespace breccia::detection
