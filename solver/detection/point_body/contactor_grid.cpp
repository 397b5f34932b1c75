#include "detection/point_body/contactor_grid.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace breccia::detection {

namespace {

/// Cells of a box up to which a contactor is binned. The cell is as large as a typical box, which then touches 8 cells.
constexpr double kMostCells = 512;

double num_cells(const CellBox& box) {
  double count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count *= static_cast<double>(box.high[axis]) - static_cast<double>(box.low[axis]) + 1;
  }
  return count;
}

template <class Visit>
void for_each_cell(const CellBox& box, Visit&& visit) {
  for (std::int32_t z = box.low[2]; z <= box.high[2]; ++z) {
    for (std::int32_t y = box.low[1]; y <= box.high[1]; ++y) {
      for (std::int32_t x = box.low[0]; x <= box.high[0]; ++x) visit(x, y, z);
    }
  }
}

}  // namespace

std::size_t ContactorGrid::bucket(std::int32_t x, std::int32_t y, std::int32_t z) const {
  std::uint64_t h = static_cast<std::uint32_t>(x) * 0x9e3779b97f4a7c15ULL;
  h = (h ^ (h >> 29) ^ static_cast<std::uint32_t>(y)) * 0xbf58476d1ce4e5b9ULL;
  h = (h ^ (h >> 32) ^ static_cast<std::uint32_t>(z)) * 0x94d049bb133111ebULL;
  return static_cast<std::size_t>(h >> 32) & (start_.size() - 2);
}

void ContactorGrid::build(std::span<const Corners> contactors, double buffer) {
  demand_searchable(0, contactors.size(), buffer);
  contactors_ = contactors;
  buffer_ = buffer;
  cells_ = Cells(choose_cell(contactors, buffer, 1.0));
  start_.assign(std::bit_ceil(contactors.size() + 1) + 1, 0);
  wide_.clear();
  fill_buckets();
}

/// Counts the entries of every bucket, then puts them there.
void ContactorGrid::fill_buckets() {
  const auto visit_binned = [&](auto&& visit, bool note_wide) {
    for (std::size_t c = 0; c < contactors_.size(); ++c) {
      const CoupleTest test(contactors_[c], buffer_);
      if (test.skipped()) continue;
      const CellBox box = cell_box(cells_, test);
      if (num_cells(box) > kMostCells) {
        if (note_wide) wide_.push_back(static_cast<Index>(c));
        continue;
      }
      for_each_cell(
          box, [&](std::int32_t x, std::int32_t y, std::int32_t z) { visit(static_cast<Index>(c), bucket(x, y, z)); });
    }
  };
  visit_binned([&](Index, std::size_t b) { ++start_[b + 1]; }, true);
  for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
  entries_.resize(static_cast<std::size_t>(start_.back()));
  // Filling moves every start to its bucket's end, the start of the next one: shifting them back by one puts them
  // right.
  visit_binned([&](Index c, std::size_t b) { entries_[static_cast<std::size_t>(start_[b]++)] = c; }, false);
  std::copy_backward(start_.begin(), start_.end() - 1, start_.end());
  start_.front() = 0;
}

void ContactorGrid::couples_of(const Vec3& point, std::vector<Index>& contactors) const {
  contactors.clear();
  if (!point.allFinite()) return;
  const auto try_one = [&](Index c) {
    const Corners& x = contactors_[static_cast<std::size_t>(c)];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double low = std::min(std::min(x[0][axis], x[1][axis]), std::min(x[2][axis], x[3][axis]));
      const double high = std::max(std::max(x[0][axis], x[1][axis]), std::max(x[2][axis], x[3][axis]));
      if (point[axis] < low - buffer_ || point[axis] > high + buffer_) return;
    }
    if (CoupleTest(x, buffer_).holds(point)) contactors.push_back(c);
  };
  const std::size_t b = bucket(cells_.of(point[0]), cells_.of(point[1]), cells_.of(point[2]));
  for (Index i = start_[b]; i < start_[b + 1]; ++i) try_one(entries_[static_cast<std::size_t>(i)]);
  for (const Index c : wide_) try_one(c);
  std::sort(contactors.begin(), contactors.end());
  contactors.erase(std::unique(contactors.begin(), contactors.end()), contactors.end());  // two cells, one bucket
}

}  // namespace breccia::detection
