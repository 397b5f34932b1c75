#include "detection/point_body/couple_sorter.hpp"

#include <algorithm>

namespace breccia::detection {

namespace {

/// Couples of a point up to which moving them one by one is faster than std::sort.
constexpr std::ptrdiff_t few = 24;

void sort_contactors(Couple* first, Couple* last) {
  if (last - first > few) {
    if (!std::is_sorted(first, last)) std::sort(first, last);
    return;
  }
  for (Couple* taken = first + 1; taken < last; ++taken) {
    const Couple couple = *taken;
    Couple* place = taken;
    for (; place > first && place[-1].contactor > couple.contactor; --place) *place = place[-1];
    *place = couple;
  }
}

}  // namespace

void CoupleSorter::sort(std::span<const Couple> found, std::size_t num_points, std::vector<Couple>& sorted) {
  next_.assign(num_points, 0);
  for (const Couple& couple : found) ++next_[static_cast<std::size_t>(couple.point)];
  std::size_t start = 0;
  for (std::size_t& entry : next_) {
    const std::size_t count = entry;
    entry = start;
    start += count;
  }
  sorted.resize(found.size());
  for (const Couple& couple : found) sorted[next_[static_cast<std::size_t>(couple.point)]++] = couple;
  std::size_t begin = 0;
  for (const std::size_t end : next_) {
    if (end - begin > 1) sort_contactors(sorted.data() + begin, sorted.data() + end);
    begin = end;
  }
}

}  // namespace breccia::detection
