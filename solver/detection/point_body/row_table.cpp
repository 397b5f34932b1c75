#include "detection/point_body/row_table.hpp"

#include <algorithm>

namespace breccia::detection {

void RowTable::clear() {
  rows_.clear();
  std::fill(slots_.begin(), slots_.end(), Slot{0, none});
}

void RowTable::grow() {
  slots_.assign(2 * slots_.size(), Slot{0, none});
  mask_ = slots_.size() - 1;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::uint64_t key = key_of(rows_[r].z, rows_[r].y);
    std::size_t slot = slot_of(key);
    while (slots_[slot].row != none) slot = (slot + 1) & mask_;
    slots_[slot] = {key, static_cast<Index>(r)};
  }
}

Index RowTable::count_point(std::int32_t z, std::int32_t y, std::int32_t x) {
  const std::uint64_t key = key_of(z, y);
  std::size_t slot = slot_of(key);
  for (; slots_[slot].row != none; slot = (slot + 1) & mask_) {
    if (slots_[slot].key != key) continue;
    Row& row = rows_[static_cast<std::size_t>(slots_[slot].row)];
    row.x_low = std::min(row.x_low, x);
    row.x_high = std::max(row.x_high, x);
    ++row.count;
    return slots_[slot].row;
  }
  const auto added = static_cast<Index>(rows_.size());
  slots_[slot] = {key, added};
  rows_.push_back({z, y, x, x, 1, 0, -1});
  if (2 * rows_.size() > slots_.size()) grow();
  return added;
}

}  // namespace breccia::detection
