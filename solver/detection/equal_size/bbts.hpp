#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "detection/equal_size/bbts_tree.hpp"
#include "detection/equal_size/cell.hpp"

namespace breccia::detection {

/// Balanced Binary Tree Schiava: the tree is built anew from all bodies, then every cell looks up the earlier cells
/// that touch it, one descent from the root for each. Source: [Schiava, ch. 4: BBTS-load, BBTS-search, mask of eq.
/// (4.37)]
///
/// In 3D the mask is the own cell and 13 others, in 2D 1 + 4, in 1D 1 + 1. Where the source descends once for every
/// body and cell of its mask, the bodies of one cell share the descents here and need none for their own cell; cells
/// are taken in ascending order, so that one descent finds the nodes of the one before in the cache.
///
/// O(n log n) and the pairs. 24 bytes a body for 16-bit coordinates in 3D (40 in eq. (4.16)), 32 for 32-bit ones.
template <int D, class Coordinate>
class Bbts {
 public:
  static constexpr std::string_view name = "bbts";

  /// @pre fewer than 2^31 - 1 bodies. Throws std::bad_alloc.
  template <class Visit>
  void detect(std::span<const Cell<D, Coordinate>> cells, Visit&& visit) {
    load(cells);
    tree_.for_each_cell([&](Index node) {
      pair_within(node, visit);
      for (const Offset& offset : mask) {
        const Index other = find_neighbour(tree_.key(node), offset);
        if (other != none) pair_between(node, other, visit);
      }
    });
  }

  [[nodiscard]] std::size_t bytes() const { return tree_.bytes(); }

 private:
  using Tree = BbtsTree<D, Coordinate>;
  using Offset = std::array<int, static_cast<std::size_t>(D)>;
  static constexpr Index none = Tree::none;
  static constexpr int num_around = D == 1 ? 3 : D == 2 ? 9 : 27;

  /// The first half of the touching cells in ascending order: those before the own cell, which stands in the middle.
  static constexpr auto mask = [] {
    std::array<Offset, num_around / 2> offsets{};
    for (int k = 0; k < num_around / 2; ++k) {
      int digits = k;
      for (int& component : offsets[static_cast<std::size_t>(k)]) {
        component = digits % 3 - 1;
        digits /= 3;
      }
    }
    return offsets;
  }();

  void load(std::span<const Cell<D, Coordinate>> cells) {
    tree_.clear();
    tree_.reserve(cells.size());
    for (std::size_t body = 0; body < cells.size(); ++body) tree_.add(cells[body], static_cast<Index>(body));
  }

  /// First node of the cell at this offset; none where the type of the coordinates ends.
  [[nodiscard]] Index find_neighbour(const Cell<D, Coordinate>& cell, const Offset& offset) const {
    using Limits = std::numeric_limits<Coordinate>;
    Cell<D, Coordinate> neighbour{};
    for (std::size_t axis = 0; axis < D; ++axis) {
      const std::int64_t moved = std::int64_t{cell[axis]} + offset[axis];
      if (moved < Limits::min() || moved > Limits::max()) return none;
      neighbour[axis] = static_cast<Coordinate>(moved);
    }
    return tree_.find(neighbour);
  }

  template <class Visit>
  void pair_within(Index first, Visit& visit) const {
    for (Index a = first; a != none; a = tree_.next_in_cell(a)) {
      for (Index b = tree_.next_in_cell(a); b != none; b = tree_.next_in_cell(b))
        visit(tree_.object(a), tree_.object(b));
    }
  }

  template <class Visit>
  void pair_between(Index first, Index other, Visit& visit) const {
    for (Index a = first; a != none; a = tree_.next_in_cell(a)) {
      for (Index b = other; b != none; b = tree_.next_in_cell(b)) visit(tree_.object(a), tree_.object(b));
    }
  }

  Tree tree_;
};

}  // namespace breccia::detection
