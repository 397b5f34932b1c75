#pragma once

#include <cstdint>

#include "detection/point_body/couple_sorter.hpp"
#include "detection/point_body/couple_test.hpp"
#include "detection/point_body/curve_order.hpp"
#include "detection/point_body/packed_tree_kernel.hpp"
#include "detection/point_body/search.hpp"

namespace breccia::detection {

/// A tree of boxes over the points, rebuilt at every search: points in the order of a Hilbert curve, or in their own
/// where that is about as good, eight to a leaf, eight leaves to a group, eight groups to a group and so on, without
/// pointers. A contactor walks it level by level, eight boxes at a time (packed_tree_walk.hpp); contactors come in such
/// an order too, so one finds in the caches what the one before has used. No length is chosen: contactors and spacings
/// of points may be as different as they like, and in any order in memory. After [Kamel and Faloutsos 1993]: the packed
/// Hilbert R-tree, with eight entries a node for the width of the registers.
///
/// Boxes are floats about the middle of the points. Rounding is monotone, so no point is lost; couples are decided in
/// double precision by CoupleTest's numbers. Points more than 1e7 contactor sizes away from most others cost more than
/// they should.
///
/// O(points + contactors (log points + candidates)). Memory a point: 28 bytes, 4.5 for boxes and walk, 8 to order the
/// couples; 20 bytes a point or contactor, whichever are more, for the order along the curve; and twice the couples.
class PackedTree final : public PointBodySearch {
 public:
  /// For the processor at hand.
  PackedTree();
  explicit PackedTree(const PackedKernel& kernel) : kernel_(kernel) {}

  void search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
              std::vector<Couple>& couples) override;

 private:
  void fill_leaves(std::span<const Vec3> points, std::span<const CurveOrder::Record> order);
  void lay_out_levels(std::size_t num_leaves);
  void set_leaf_box(std::size_t leaf);
  void set_group_boxes(std::size_t level, std::size_t num_children);
  void search_contactor(const CoupleTest& test, Index contactor);
  [[nodiscard]] PackedQuery query_of(const CoupleTest& test) const;

  PackedKernel kernel_;
  CurveOrder order_;
  Vec3 centre_ = Vec3::Zero();  ///< of the boxes' coordinates, m
  std::size_t num_points_ = 0;  ///< finite ones
  std::vector<double> leaves_;  ///< PackedTreeView
  std::vector<Index> numbers_;  ///< its points
  std::vector<float> boxes_;
  std::vector<std::size_t> level_;         ///< first group of each level, and their number
  std::vector<std::uint32_t> now_, next_;  ///< PackedFrontier
  std::vector<Index> hits_;
  std::vector<Couple> found_;  ///< the first num_found_ count
  std::size_t num_found_ = 0;
  CoupleSorter sorter_;
};

}  // namespace breccia::detection
