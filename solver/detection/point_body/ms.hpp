#pragma once

#include "detection/point_body/cells.hpp"
#include "detection/point_body/couple_sorter.hpp"
#include "detection/point_body/ms_tree.hpp"
#include "detection/point_body/search.hpp"
#include "detection/point_body/slices.hpp"

namespace breccia::detection {

/// CD-MS: all points are loaded into an MS-tree by their cell; every contactor walks the list of points in its cell
/// box, row by row. Only "smallest greater than" searches are made, so empty cells, rows and layers cost nothing.
/// Source: [Schiava, 6.4], algorithm 6.5; three details of its printed form are put right: the last layer and the last
/// row of the box are searched too, the end of the list ends every loop, and cells go by floor. A search is left out
/// where the node at hand is its answer, and the end of a row's range is met by its key instead of searched beforehand.
///
/// O(n log n) to load n points; a contactor costs O(log n) for every row in its cell box that holds points, anywhere in
/// x, and O(1) for every point in the box.
class Ms final : public PointBodySearch {
 public:
  /// @param cell        m, 0: chosen at every search
  /// @param use_slices  walk the slices of the cell box (slices.hpp) instead of the whole box
  Ms(double cell, bool use_slices) : cell_(cell), use_slices_(use_slices) {}

  void search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
              std::vector<Couple>& couples) override;

 private:
  void load(std::span<const Vec3> points, const Cells& cells);
  template <class Slicing>
  void search_box(std::span<const Vec3> points, const CoupleTest& test, Index contactor, const Slicing& slicing);

  double cell_;
  bool use_slices_;
  MsTree tree_;
  std::vector<Couple> found_;
  CoupleSorter sorter_;
};

}  // namespace breccia::detection
