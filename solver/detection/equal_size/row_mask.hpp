#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "detection/equal_size/cell.hpp"

namespace breccia::detection {

/// Wide enough for c - 1 and c + 1 at the limits of a coordinate.
template <class Coordinate>
using Wide = std::conditional_t<(sizeof(Coordinate) < sizeof(int)), int, std::int64_t>;

/// Order of the MR list: the last axis counts most (layers, then rows, then columns). Source: thesis, eq. (5.4).
template <class A, class B>
bool before(const A& a, const B& b) {
  for (std::size_t axis = a.size(); axis-- > 1;) {
    if (a[axis] != b[axis]) return a[axis] < b[axis];
  }
  return a[0] < b[0];
}

/// Earlier rows of the contact mask as (dy, dz): none in 1D, one in 2D, four in 3D; the own row is not listed.
/// Source: thesis, figures 4.16 and 5.12.
inline constexpr std::array<std::array<int, 2>, 4> kEarlierRows{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
template <int D>
inline constexpr std::size_t kNumEarlierRows = D == 3 ? 4 : D - 1;

/// MR-Search: walks a list sorted by before() once, with one running pointer for each row of the mask. Every pointer
/// only moves on, and stops at or before the target, so no pointer is ever tested for the end of the list. O(N +
/// pairs), no memory.
/// @param list  first(), next(i), end(), cell(i), id(i)
template <int D, class Coordinate, class List, class Visit>
void search_sorted_list(const List& list, Visit&& visit) {
  using Corner = std::array<Wide<Coordinate>, static_cast<std::size_t>(D)>;
  Index own = list.first();
  std::array<Index, 4> earlier{own, own, own, own};
  for (Index target = own; target != list.end(); target = list.next(target)) {
    Corner centre;
    const auto cell = list.cell(target);
    for (std::size_t axis = 0; axis < centre.size(); ++axis) centre[axis] = cell[axis];
    const Index id = list.id(target);
    Corner low = centre;
    low[0] -= 1;
    while (before(list.cell(own), low)) own = list.next(own);
    for (Index i = own; i != target; i = list.next(i)) visit(id, list.id(i));
    for (std::size_t row = 0; row < kNumEarlierRows<D>; ++row) {
      for (std::size_t axis = 1; axis < low.size(); ++axis) low[axis] = centre[axis] + kEarlierRows[row][axis - 1];
      Corner high = low;
      high[0] = centre[0] + 1;
      Index& begin = earlier[row];
      while (before(list.cell(begin), low)) begin = list.next(begin);
      for (Index i = begin; !before(high, list.cell(i)); i = list.next(i)) visit(id, list.id(i));
    }
  }
}

}  // namespace breccia::detection
