#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "detection/equal_size/row_mask.hpp"

namespace breccia::detection {

/// MR-S (Munjiza-Rougier-Schiava): the MR list in arrays id, ix, iy, iz and p. Source: thesis, section 5.4.
/// The first call, and one after the number of bodies changed, sorts id and the coordinates: O(N log N). Later calls
/// change p alone. Differs from the source: a singly linked list cannot step back, so MR-Sort takes both objects of
/// each pair out of order off the list, merge-sorts the k objects taken and merges them in again: O(N + k log k), which
/// is also the guard, as the worst is the cost of a full sort. 14 bytes a body in 3D with 16-bit coordinates, 20 with
/// 32-bit. Throws std::bad_alloc.
template <int D, std::signed_integral Coordinate>
class MrS {
 public:
  static constexpr std::string_view name = "mr_s";

  template <class Visit>
  void detect(std::span<const Cell<D, Coordinate>> cells, Visit&& visit) {
    const bool same_bodies = id_.size() == cells.size();
    if (!same_bodies) full_sort(cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& cell = cells[static_cast<std::size_t>(id_[i])];
      for (std::size_t axis = 0; axis < cell.size(); ++axis) coordinate_[axis][i] = cell[axis];
    }
    if (same_bodies) mr_sort();
    search_sorted_list<D, Coordinate>(*this, visit);
  }

  std::size_t bytes() const {
    std::size_t sum = (id_.capacity() + p_.capacity()) * sizeof(Index);
    for (const auto& axis : coordinate_) sum += axis.capacity() * sizeof(Coordinate);
    return sum;
  }

  /// The sorted list, as search_sorted_list() reads it.
  Index first() const { return first_; }
  Index next(Index i) const { return p_[static_cast<std::size_t>(i)]; }
  Index end() const { return kEnd; }
  Cell<D, Coordinate> cell(Index i) const {
    Cell<D, Coordinate> cell;
    for (std::size_t axis = 0; axis < cell.size(); ++axis) cell[axis] = coordinate_[axis][static_cast<std::size_t>(i)];
    return cell;
  }
  Index id(Index i) const { return id_[static_cast<std::size_t>(i)]; }

 private:
  static constexpr Index kEnd = -1;

  void full_sort(std::span<const Cell<D, Coordinate>> cells) {
    const auto fit = [&](auto& array) {
      array.resize(cells.size());
      array.shrink_to_fit();
    };
    fit(id_);
    fit(p_);
    for (auto& axis : coordinate_) fit(axis);
    std::iota(id_.begin(), id_.end(), Index{0});
    std::sort(id_.begin(), id_.end(), [&](Index a, Index b) {
      return before(cells[static_cast<std::size_t>(a)], cells[static_cast<std::size_t>(b)]);
    });
    std::iota(p_.begin(), p_.end(), Index{1});
    if (!p_.empty()) p_.back() = kEnd;
    first_ = p_.empty() ? kEnd : 0;
  }

  bool less(Index a, Index b) const { return before(cell(a), cell(b)); }
  void push(Index& list, Index i) {
    p_[static_cast<std::size_t>(i)] = list;
    list = i;
  }
  Index pop(Index& list) {
    const Index top = list;
    list = next(list);
    return top;
  }

  /// What is in order is kept as a stack with the largest on top, so that an object can be taken off it again.
  void mr_sort() {
    Index kept = kEnd;
    Index taken = kEnd;
    std::size_t num_taken = 0;
    for (Index rest = first_; rest != kEnd;) {
      const Index i = pop(rest);
      if (kept != kEnd && less(i, kept)) {
        push(taken, pop(kept));
        push(taken, i);
        num_taken += 2;
      } else {
        push(kept, i);
      }
    }
    taken = sort_descending(taken, num_taken);
    first_ = kEnd;
    while (kept != kEnd || taken != kEnd) {
      const bool from_kept = taken == kEnd || (kept != kEnd && less(taken, kept));
      push(first_, pop(from_kept ? kept : taken));
    }
  }

  /// Merge sort of the first count objects of a list; recursion log2(count) deep.
  /// @return the sorted list, ended by kEnd; @param list is left at what follows the count objects
  Index sort_descending(Index& list, std::size_t count) {
    if (count == 0) return kEnd;
    if (count == 1) {
      Index single = kEnd;
      push(single, pop(list));
      return single;
    }
    Index left = sort_descending(list, count / 2);
    Index right = sort_descending(list, count - count / 2);
    Index first = kEnd;
    Index last = kEnd;
    while (left != kEnd || right != kEnd) {
      const bool from_left = right == kEnd || (left != kEnd && less(right, left));
      const Index i = pop(from_left ? left : right);
      if (last == kEnd) {
        first = i;
      } else {
        p_[static_cast<std::size_t>(last)] = i;
      }
      last = i;
    }
    p_[static_cast<std::size_t>(last)] = kEnd;
    return first;
  }

  std::vector<Index> id_;
  std::array<std::vector<Coordinate>, static_cast<std::size_t>(D)> coordinate_;
  std::vector<Index> p_;
  Index first_ = kEnd;
};

}  // namespace breccia::detection
