#include "detection/point_body/couple_sorter.hpp"

namespace breccia::detection {

void CoupleSorter::sort(const std::vector<Couple>& found, std::size_t num_points, std::vector<Couple>& sorted) {
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
}

}  // namespace breccia::detection
