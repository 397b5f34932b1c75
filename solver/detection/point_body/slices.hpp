#pragma once

#include <array>
#include <cstdint>

#include "detection/point_body/cells.hpp"
#include "detection/point_body/couple_test.hpp"

namespace breccia::detection {

/// Range of cells, both ends included; empty if low > high.
struct CellRange {
  std::int32_t low, high;
};

/// Cuts the cell box of a contactor into slices that hug the region of its couples, the convex body of box and buffered
/// face planes. Source: [Schiava, figure 6.15b], proposed there and not worked out.
///
/// The range of y in a layer of cells and the range of x in a row of cells are bounds from linear inequalities: of the
/// body's shadow on the yz plane (every pair of planes that bounds x from both sides, x eliminated) and of the planes
/// themselves. They are widened by more than their round-off: a point that is a couple is never outside.
class Slices {
 public:
  /// @pre !test.skipped(); `cells` and `test` outlive this object
  Slices(const Cells& cells, const CoupleTest& test);

  [[nodiscard]] const CellBox& box() const { return box_; }
  /// Cells in y that may hold couples in the layer z. O(1).
  [[nodiscard]] CellRange y_range(std::int32_t z) const;
  /// Cells in x that may hold couples in the row (z, y). O(1).
  [[nodiscard]] CellRange x_range(std::int32_t z, std::int32_t y) const;

 private:
  struct Interval {
    double low, high;
  };
  /// y-coefficient, z-coefficient, bound: a y + b z <= c
  struct ShadowEdge {
    double a, b, c;
  };

  void add_planes();
  void add_shadow();
  [[nodiscard]] Interval layer(std::int32_t cell, Eigen::Index axis) const;
  [[nodiscard]] CellRange cells_of(const Interval& interval, std::size_t axis) const;

  const Cells& cells_;
  const CoupleTest& test_;
  CellBox box_;
  Vec3 low_, high_;                          ///< of the enlarged box, about the test's origin
  double slack_;                             ///< m
  std::array<CoupleTest::Plane, 4> planes_;  ///< unit normals
  int num_planes_ = 0;
  std::array<ShadowEdge, 8> shadow_;
  int num_edges_ = 0;
};

}  // namespace breccia::detection
