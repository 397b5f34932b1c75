#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "detection/equal_size/row_mask.hpp"

namespace breccia::detection {

/// MR (Munjiza-Rougier): a closed, doubly linked list of MR-objects behind a list head. Source: thesis, section 5.3.
/// The first call, and one after the number of bodies changed, sorts the whole list: O(N log N). Later calls move each
/// object that is out of order back to its place (MR-Sort), O(N + steps back). Differs from the source: links are
/// 4-byte indices, the whole list is sorted by std::sort, and a call that needs more than 8 N steps back gives up
/// MR-Sort and sorts the whole list, since bodies thrown anywhere would make it quadratic.
/// 20 bytes a body in 3D with 16-bit coordinates, 24 with 32-bit. Throws std::bad_alloc.
template <int D, std::signed_integral Coordinate>
class Mr {
 public:
  static constexpr std::string_view name = "mr";

  template <class Visit>
  void detect(std::span<const Cell<D, Coordinate>> cells, Visit&& visit) {
    const bool same_bodies = objects_.size() == cells.size() + 1;
    if (same_bodies) {
      for (std::size_t i = 1; i < objects_.size(); ++i) {
        objects_[i].cell = cells[static_cast<std::size_t>(objects_[i].id)];
      }
      if (!mr_sort()) full_sort();
    } else {
      objects_.resize(cells.size() + 1);
      objects_.shrink_to_fit();
      for (std::size_t i = 1; i < objects_.size(); ++i) {
        objects_[i] = {0, 0, static_cast<Index>(i - 1), cells[i - 1]};
      }
      full_sort();
    }
    search_sorted_list<D, Coordinate>(*this, visit);
  }

  std::size_t bytes() const { return objects_.capacity() * sizeof(Object); }

  /// The sorted list, as search_sorted_list() reads it.
  Index first() const { return objects_[0].next; }
  Index next(Index i) const { return at(i).next; }
  Index end() const { return 0; }
  const Cell<D, Coordinate>& cell(Index i) const { return at(i).cell; }
  Index id(Index i) const { return at(i).id; }

 private:
  struct Object {
    Index next;
    Index previous;
    Index id;
    Cell<D, Coordinate> cell;
  };

  const Object& at(Index i) const { return objects_[static_cast<std::size_t>(i)]; }
  Object& at(Index i) { return objects_[static_cast<std::size_t>(i)]; }

  void full_sort() {
    std::sort(objects_.begin() + 1, objects_.end(),
              [](const Object& a, const Object& b) { return before(a.cell, b.cell); });
    const std::size_t count = objects_.size();
    for (std::size_t i = 0; i < count; ++i) {
      objects_[i].next = static_cast<Index>(i + 1 < count ? i + 1 : 0);
      objects_[i].previous = static_cast<Index>(i > 0 ? i - 1 : count - 1);
    }
  }

  /// @return false where the list was too far from sorted; it is then still linked, in any order
  bool mr_sort() {
    std::size_t steps_left = 8 * objects_.size();
    for (Index i = first(); i != end();) {
      const Index following = next(i);
      Index place = at(i).previous;
      if (place != end() && before(cell(i), cell(place))) {
        do {
          if (steps_left-- == 0) return false;
          place = at(place).previous;
        } while (place != end() && before(cell(i), cell(place)));
        move_behind(i, place);
      }
      i = following;
    }
    return true;
  }

  void move_behind(Index i, Index place) {
    at(at(i).previous).next = at(i).next;
    at(at(i).next).previous = at(i).previous;
    at(i).previous = place;
    at(i).next = at(place).next;
    at(at(i).next).previous = i;
    at(place).next = i;
  }

  std::vector<Object> objects_;  // [0] is the list head
};

}  // namespace breccia::detection
