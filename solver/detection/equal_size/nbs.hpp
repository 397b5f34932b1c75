#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "detection/equal_size/row_mask.hpp"

namespace breccia::detection {

/// Munjiza-NBS: singly linked lists of layers (3D), of the rows of two layers, and of the columns of the rows of the
/// mask, each a head a slot and a link a body. Source: thesis, section 5.2 (2D), and the mask of chapter 4 for 3D.
/// Lists are visited through the bodies, heads are reset by walking the bodies again: O(N + n_x + n_y + n_z + pairs)
/// time and memory. An axis that spans more than 4 N + 64 cells is compacted: occupied coordinates are sorted and
/// numbered, neighbours one apart and others two, which keeps the pairs and needs at most 2 N slots, O(N log N).
/// Bytes: 4 D a body for links, 4 a slot for heads (2 n_y, 5 n_x in 3D), 8 a body and axis compacted.
/// Throws std::bad_alloc.
template <int D, std::signed_integral Coordinate>
class Nbs {
 public:
  static constexpr std::string_view name = "nbs";

  template <class Visit>
  void detect(std::span<const Cell<D, Coordinate>> cells, Visit&& visit) {
    cells_ = cells;
    if (cells.empty()) return;
    for (std::size_t axis = 0; axis < D; ++axis) prepare(axis);
    if constexpr (D == 3) {
      load(layers_, 2, [&](auto take) { every_body(take); });
      for (Index i = 0; i < size(); ++i) {
        const Index z = slot(2, i);
        if (heads(layers_, z) == i) search_layer(z, visit);  // the head stands for its list: met once, then old
      }
      unload(layers_, 2, [&](auto take) { every_body(take); });
    } else {
      search_layer(1, visit);
    }
  }

  std::size_t bytes() const {
    std::size_t sum = layers_.capacity();
    for (const auto& heads : rows_) sum += heads.capacity();
    for (const auto& heads : columns_) sum += heads.capacity();
    for (const auto& links : next_) sum += links.capacity();
    for (const auto& slots : slots_) sum += slots.capacity();
    return sum * sizeof(Index) + occupied_.capacity() * sizeof(Coordinate);
  }

 private:
  using Heads = std::vector<Index>;
  static constexpr Index kNone = -1;
  static constexpr std::size_t kRowsOfMask = kNumEarlierRows<D> + 1;

  Index size() const { return static_cast<Index>(cells_.size()); }
  static Index& heads(Heads& list, Index slot) { return list[static_cast<std::size_t>(slot)]; }

  Index slot(std::size_t axis, Index i) const {
    const auto body = static_cast<std::size_t>(i);
    if (!slots_[axis].empty()) return slots_[axis][body];
    return static_cast<Index>(Wide<Coordinate>{cells_[body][axis]} - lowest_[axis] + 1);
  }

  /// Slots of an axis run from 1, with an empty one at either end for the mask.
  void prepare(std::size_t axis) {
    const auto less = [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::minmax_element(cells_.begin(), cells_.end(), less);
    lowest_[axis] = (*low)[axis];
    const std::int64_t extent = std::int64_t{(*high)[axis]} - (*low)[axis] + 1;
    std::size_t slots = static_cast<std::size_t>(extent);
    slots_[axis].clear();
    if (extent > 4 * std::int64_t{size()} + 64) slots = compact(axis);
    next_[axis].resize(cells_.size());
    const auto fit = [slots](Heads& list) { list.assign(slots + 2, kNone); };
    if (axis == 0) std::for_each_n(columns_.begin(), kRowsOfMask, fit);
    if (axis == 1) std::for_each_n(rows_.begin(), D - 1, fit);
    if (axis == 2) fit(layers_);
  }

  std::size_t compact(std::size_t axis) {
    occupied_.clear();
    for (const auto& cell : cells_) occupied_.push_back(cell[axis]);
    std::sort(occupied_.begin(), occupied_.end());
    occupied_.erase(std::unique(occupied_.begin(), occupied_.end()), occupied_.end());
    std::vector<Index> number(occupied_.size(), 1);
    for (std::size_t i = 1; i < number.size(); ++i) {
      const bool adjacent = Wide<Coordinate>{occupied_[i]} - occupied_[i - 1] == 1;
      number[i] = number[i - 1] + (adjacent ? 1 : 2);
    }
    for (const auto& cell : cells_) {
      const auto at = std::lower_bound(occupied_.begin(), occupied_.end(), cell[axis]) - occupied_.begin();
      slots_[axis].push_back(number[static_cast<std::size_t>(at)]);
    }
    return static_cast<std::size_t>(number.back());
  }

  template <class Take>
  void every_body(Take take) const {
    for (Index i = 0; i < size(); ++i) take(i);
  }
  template <class Take>
  void along(std::size_t axis, Index i, Take take) const {
    for (; i != kNone; i = next_[axis][static_cast<std::size_t>(i)]) take(i);
  }
  template <class Take>
  void layer(Index z, Take take) {
    if constexpr (D == 3) {
      along(2, heads(layers_, z), take);
    } else if (z == 1) {
      every_body(take);
    }
  }
  template <class Take>
  void row(Heads& rows, Index y, Take take) {
    if constexpr (D > 1) {
      along(1, heads(rows, y), take);
    } else {
      every_body(take);
    }
  }

  template <class Walk>
  void load(Heads& list, std::size_t axis, Walk walk) {
    walk([&](Index i) {
      Index& head = heads(list, slot(axis, i));
      next_[axis][static_cast<std::size_t>(i)] = head;
      head = i;
    });
  }
  template <class Walk>
  void unload(Heads& list, std::size_t axis, Walk walk) {
    walk([&](Index i) { heads(list, slot(axis, i)) = kNone; });
  }

  template <class Visit>
  void search_layer(Index z, Visit&& visit) {
    if constexpr (D == 1) {
      search_row(1, visit);
    } else {
      for (Index k = 0; k < D - 1; ++k) load(rows_[std::size_t(k)], 1, [&](auto take) { layer(z - k, take); });
      layer(z, [&](Index i) {
        const Index y = slot(1, i);
        if (heads(rows_[0], y) == i) search_row(y, visit);
      });
      for (Index k = 0; k < D - 1; ++k) unload(rows_[std::size_t(k)], 1, [&](auto take) { layer(z - k, take); });
    }
  }

  /// Own row first, then the earlier rows of the mask.
  template <class Take>
  void mask_row(std::size_t k, Index y, Take take) {
    if (k == 0) return row(rows_[0], y, take);
    const auto& offset = kEarlierRows[k - 1];
    row(rows_[offset[1] == 0 ? 0 : 1], y + offset[0], take);
  }

  template <class Visit>
  void search_row(Index y, Visit&& visit) {
    for (std::size_t k = 0; k < kRowsOfMask; ++k) {
      load(columns_[k], 0, [&](auto take) { mask_row(k, y, take); });
    }
    mask_row(0, y, [&](Index i) {
      const Index x = slot(0, i);
      const auto meet = [&](Index other) { visit(i, other); };
      along(0, next_[0][static_cast<std::size_t>(i)], meet);  // own cell: those behind it in the list
      along(0, heads(columns_[0], x - 1), meet);
      for (std::size_t k = 1; k < kRowsOfMask; ++k) {
        for (Index step = -1; step <= 1; ++step) along(0, heads(columns_[k], x + step), meet);
      }
    });
    for (std::size_t k = 0; k < kRowsOfMask; ++k) {
      unload(columns_[k], 0, [&](auto take) { mask_row(k, y, take); });
    }
  }

  std::span<const Cell<D, Coordinate>> cells_;  // the caller's, during detect() only
  std::array<Wide<Coordinate>, static_cast<std::size_t>(D)> lowest_{};
  std::array<std::vector<Index>, static_cast<std::size_t>(D)> next_;   // X, Y, Z
  std::array<std::vector<Index>, static_cast<std::size_t>(D)> slots_;  // of a compacted axis; empty otherwise
  std::vector<Coordinate> occupied_;
  std::array<Heads, 5> columns_;  // A, one a row of the mask
  std::array<Heads, 2> rows_;     // B, of this layer and the one before
  Heads layers_;                  // C
};

}  // namespace breccia::detection
