#pragma once

#include <cstdint>

#include "detection/point_body/cells.hpp"
#include "detection/point_body/couple_sorter.hpp"
#include "detection/point_body/row_table.hpp"
#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// Points counted into rows of cells along x: a row (z, y) that holds points is found by hash, its points lie
/// contiguously in the order of x and start at a table of the row's cells. A contactor visits the rows of its cell box
/// and walks each one's range in x.
///
/// Memory O(points), however far apart they lie: a row whose points are too scattered for a table of its cells is
/// sorted and searched by halving. O(points + contactors rows + candidates), where a contactor never visits more rows
/// than hold points.
class SortedGrid final : public PointBodySearch {
 public:
  /// @param cell  m, 0: chosen at every search
  explicit SortedGrid(double cell) : cell_(cell) {}

  void search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
              std::vector<Couple>& couples) override;

 private:
  /// A point's place in the rows. Row none: the point is not finite.
  struct Place {
    Index row;
    std::int32_t x;
  };
  struct Entry {
    Vec3 position;
    Index point;
  };

  void load(std::span<const Vec3> points, const Cells& cells);
  void lay_out_rows();
  void scatter(std::span<const Vec3> points);
  void search_box(const Cells& cells, const CoupleTest& test);
  void search_row(const Row& row, const CellBox& box, const CoupleTest& test);

  double cell_;
  RowTable rows_;
  std::vector<Place> places_;         ///< (num_points)
  std::vector<Index> starts_;         ///< cells of every row that has a table: first entry of the cell
  std::vector<Entry> entries_;        ///< (finite points) by row, then x
  std::vector<const Entry*> in_box_;  ///< points in the enlarged box of the contactor at hand
  std::size_t num_in_box_ = 0;
  std::vector<Couple> found_;
  CoupleSorter sorter_;
};

}  // namespace breccia::detection
