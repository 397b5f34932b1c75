#include "detection/point_body/sorted_grid.hpp"

#include <algorithm>
#include <tuple>

#include "detection/point_body/couple_test.hpp"

namespace breccia::detection {

namespace {

/// Cell size over the contactors' mean box width. Measured flat between 0.35 and 0.7 (tests/benchmark/detection).
constexpr double cell_share = 0.5;

/// A row gets a table of its cells while it has at most so many cells a point, plus a few.
constexpr std::int64_t cells_per_point = 4, spare_cells = 16;

}  // namespace

void SortedGrid::load(std::span<const Vec3> points, const Cells& cells) {
  rows_.clear();
  places_.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3& position = points[p];
    if (!position.allFinite()) {
      places_[p].row = RowTable::none;
      continue;
    }
    const std::int32_t x = cells.of(position[0]);
    places_[p] = {rows_.count_point(cells.of(position[2]), cells.of(position[1]), x), x};
  }
  lay_out_rows();
  scatter(points);
}

/// Places of the rows among entries and cell starts.
void SortedGrid::lay_out_rows() {
  Index num_entries = 0;
  std::int64_t num_starts = 0;
  for (Row& row : rows_.rows()) {
    row.begin = num_entries;
    num_entries += row.count;
    if (row.width() > cells_per_point * row.count + spare_cells) continue;
    row.table = num_starts;
    num_starts += row.width() + 1;
  }
  entries_.resize(static_cast<std::size_t>(num_entries));
  starts_.assign(static_cast<std::size_t>(num_starts), 0);
}

/// Counting sort within the rows that have a table, in the order of the points within a cell. In the other rows `begin`
/// is moved to the row's end and back, and the points are sorted by coordinate.
void SortedGrid::scatter(std::span<const Vec3> points) {
  for (const Place& place : places_) {
    if (place.row == RowTable::none) continue;
    const Row& row = rows_.rows()[static_cast<std::size_t>(place.row)];
    if (row.table >= 0) ++starts_[static_cast<std::size_t>(row.table + place.x - row.x_low)];
  }
  for (Row& row : rows_.rows()) {
    if (row.table < 0) {
      row.begin += row.count;
      continue;
    }
    Index end = row.begin;
    for (std::int64_t k = row.table; k <= row.table + row.width(); ++k) {
      end += starts_[static_cast<std::size_t>(k)];
      starts_[static_cast<std::size_t>(k)] = end;
    }
  }
  for (std::size_t p = points.size(); p-- > 0;) {
    if (places_[p].row == RowTable::none) continue;
    Row& row = rows_.rows()[static_cast<std::size_t>(places_[p].row)];
    Index& end = row.table < 0 ? row.begin : starts_[static_cast<std::size_t>(row.table + places_[p].x - row.x_low)];
    entries_[static_cast<std::size_t>(--end)] = {points[p], static_cast<Index>(p)};
  }
  for (const Row& row : rows_.rows()) {
    if (row.table >= 0) continue;
    std::sort(entries_.begin() + row.begin, entries_.begin() + row.begin + row.count,
              [](const Entry& a, const Entry& b) {
                return std::tie(a.position[0], a.point) < std::tie(b.position[0], b.point);
              });
  }
}

void SortedGrid::search_row(const Row& row, const CellBox& box, const CoupleTest& test) {
  if (box.high[0] < row.x_low || box.low[0] > row.x_high) return;
  const Entry* first = entries_.data() + row.begin;
  const Entry* last = first + row.count;
  if (row.table >= 0) {
    const Index* starts = starts_.data() + row.table;
    first = entries_.data() + starts[std::max(box.low[0], row.x_low) - row.x_low];
    last = entries_.data() + starts[std::min(box.high[0], row.x_high) + 1 - row.x_low];
  } else {
    const double x_low = test.low()[0], x_high = test.high()[0];
    first = std::partition_point(first, last, [=](const Entry& entry) { return entry.position[0] < x_low; });
    last = std::partition_point(first, last, [=](const Entry& entry) { return entry.position[0] <= x_high; });
  }
  const auto longest = num_in_box_ + static_cast<std::size_t>(last - first);
  if (in_box_.size() < longest) in_box_.resize(2 * longest);
  for (; first != last; ++first) {
    in_box_[num_in_box_] = first;
    num_in_box_ += test.in_box(first->position);
  }
}

void SortedGrid::search_box(const Cells& cells, const CoupleTest& test) {
  const CellBox box = cell_box(cells, test);
  const std::span<const Row> rows = rows_.rows();
  const std::int64_t layers = std::int64_t{box.high[2]} - box.low[2] + 1;
  const std::int64_t rows_in_layer = std::int64_t{box.high[1]} - box.low[1] + 1;
  if (layers * rows_in_layer > static_cast<std::int64_t>(rows.size())) {
    for (const Row& row : rows) {
      const bool in_box = row.z >= box.low[2] && row.z <= box.high[2] && row.y >= box.low[1] && row.y <= box.high[1];
      if (in_box) search_row(row, box, test);
    }
    return;
  }
  for (std::int32_t z = box.low[2]; z <= box.high[2]; ++z) {
    for (std::int32_t y = box.low[1]; y <= box.high[1]; ++y) {
      const Index row = rows_.find(z, y);
      if (row != RowTable::none) search_row(rows[static_cast<std::size_t>(row)], box, test);
    }
  }
}

void SortedGrid::search(std::span<const Vec3> points, std::span<const Corners> contactors, double buffer,
                        std::vector<Couple>& couples) {
  demand_searchable(points.size(), contactors.size(), buffer);
  const Cells cells(cell_ > 0 ? cell_ : choose_cell(contactors, buffer, cell_share));
  load(points, cells);
  found_.clear();
  for (std::size_t c = 0; c < contactors.size(); ++c) {
    const CoupleTest test(contactors[c], buffer);
    if (test.skipped()) continue;
    num_in_box_ = 0;
    search_box(cells, test);
    for (std::size_t k = 0; k < num_in_box_; ++k) {
      if (test.in_planes(in_box_[k]->position)) found_.push_back({in_box_[k]->point, static_cast<Index>(c)});
    }
  }
  sorter_.sort(found_, points.size(), couples);
}

}  // namespace breccia::detection
