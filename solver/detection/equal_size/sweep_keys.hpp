#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/types.hpp"
#include "detection/equal_size/cell.hpp"
#include "detection/equal_size/radix_sort.hpp"

namespace breccia::detection {

/// Rows of cells along x that touch a row and come before it in the order by z, y, x: their offsets; x is not used.
template <int D>
constexpr auto earlier_rows() {
  if constexpr (D == 1) return std::array<std::array<int, 1>, 0>{};
  if constexpr (D == 2) return std::array<std::array<int, 2>, 1>{{{0, -1}}};
  if constexpr (D == 3) return std::array<std::array<int, 3>, 4>{{{0, -1, 0}, {0, 1, -1}, {0, 0, -1}, {0, -1, -1}}};
}

/// Box of the cells, and the cells relative to its lowest corner: 32 unsigned bits hold any difference.
template <int D, class Coordinate>
class CellBounds {
 public:
  static constexpr auto num_axes = static_cast<std::size_t>(D);

  /// @pre at least one cell; the cells outlive the box. O(n).
  explicit CellBounds(std::span<const Cell<D, Coordinate>> cells) : cells_(cells), lowest_(cells[0]) {
    Cell<D, Coordinate> highest = lowest_;
    for (const Cell<D, Coordinate>& cell : cells) {
      for (std::size_t axis = 0; axis < num_axes; ++axis) {
        lowest_[axis] = std::min(lowest_[axis], cell[axis]);
        highest[axis] = std::max(highest[axis], cell[axis]);
      }
    }
    for (std::size_t axis = 0; axis < num_axes; ++axis) extent_[axis] = from_lowest(highest[axis], axis);
  }

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] std::uint32_t extent(std::size_t axis) const { return extent_[axis]; }  ///< highest minus lowest
  [[nodiscard]] std::uint32_t at(std::size_t body, std::size_t axis) const {
    return from_lowest(cells_[body][axis], axis);
  }

 private:
  [[nodiscard]] std::uint32_t from_lowest(Coordinate coordinate, std::size_t axis) const {
    return static_cast<std::uint32_t>(coordinate) - static_cast<std::uint32_t>(lowest_[axis]);
  }

  std::span<const Cell<D, Coordinate>> cells_;
  Cell<D, Coordinate> lowest_;
  std::array<std::uint32_t, num_axes> extent_{};
};

/// Cell and body in one 64-bit number: the number of the cell in its box above the number of the body.
///
/// An empty layer of cells around the box keeps the ends of a row from touching the next row. Serves every box with
/// fewer than about 2^64 / n cells.
template <int D>
class PackedKeys {
 public:
  using Record = std::uint64_t;
  using Bound = std::uint64_t;
  struct Range {
    Bound begin, end;
  };

  /// Whether cell and body fit. After false the object is not to be used.
  template <class Coordinate>
  [[nodiscard]] bool fit(const CellBounds<D, Coordinate>& box) {
    body_bits_ = static_cast<int>(std::bit_width(box.size() - 1));
    const std::uint64_t limit = (UINT64_MAX >> body_bits_) - 2;  // so that no bound of a range overflows
    std::uint64_t volume = 1;
    for (std::size_t axis = 0; axis < D; ++axis) {
      stride_[axis] = volume;
      const std::uint64_t width = std::uint64_t{box.extent(axis)} + 2;
      if (volume > limit / width) return false;
      volume *= width;
    }
    key_bits_ = static_cast<int>(std::bit_width(volume));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      distance_[row] = 0;
      for (std::size_t axis = 1; axis < D; ++axis) {
        distance_[row] -= static_cast<std::uint64_t>(rows[row][axis]) * stride_[axis] << body_bits_;
      }
    }
    return true;
  }

  template <class Coordinate>
  std::span<Record> sort(RadixSort<Record>& radix_sort, const CellBounds<D, Coordinate>& box) const {
    const int widest = RadixSort<Record>::widest_digit(box.size());
    const int num_passes = (key_bits_ + widest - 1) / widest;
    const int digit_bits = (key_bits_ + num_passes - 1) / num_passes;
    const std::uint64_t mask = (std::uint64_t{1} << digit_bits) - 1;
    // By value: the compiler has to expect that writing the records changes what is only referred to.
    const auto make = [box, stride = stride_, body_bits = body_bits_](std::size_t body) {
      std::uint64_t key = 0;
      for (std::size_t axis = 0; axis < D; ++axis) key += (std::uint64_t{box.at(body, axis)} + 1) * stride[axis];
      return key << body_bits | body;
    };
    const auto digit = [mask, digit_bits, body_bits = body_bits_](Record record, int pass) {
      return static_cast<std::size_t>(record >> (body_bits + pass * digit_bits) & mask);
    };
    const auto sorted = radix_sort.sort(box.size(), num_passes, digit_bits, make, digit, padding);
    std::fill_n(sorted.data() + sorted.size(), padding, UINT64_MAX);
    return sorted;
  }

  [[nodiscard]] Index body(Record record) const {
    return static_cast<Index>(record & ((std::uint64_t{1} << body_bits_) - 1));
  }
  static bool before(Record record, Bound bound) { return record < bound; }

  /// Where the cell after the record's own neighbour along x begins.
  [[nodiscard]] Bound end_of_own_row(Record record) const { return cell(record) + 2 * one_cell(); }

  /// The three touching cells of an earlier row.
  [[nodiscard]] Range touching(Record record, std::size_t row) const {
    const Bound middle = cell(record) - distance_[row];
    return {middle - one_cell(), middle + 2 * one_cell()};
  }

  /// First place from `place` on that is not before the bound. Four records are counted without a branch, because how
  /// far to go is random, a few cells, and a mispredicted branch would cost more than the comparisons.
  static std::size_t advance(const Record* sorted, std::size_t place, Bound bound) {
    const Record* const next = sorted + place;
    place += std::size_t{next[0] < bound} + std::size_t{next[1] < bound} + std::size_t{next[2] < bound} +
             std::size_t{next[3] < bound};
    while (sorted[place] < bound) ++place;
    return place;
  }

 private:
  static constexpr auto rows = earlier_rows<D>();
  static constexpr std::size_t padding = 3;  ///< read by `advance`, never counted

  [[nodiscard]] std::uint64_t one_cell() const { return std::uint64_t{1} << body_bits_; }
  [[nodiscard]] Bound cell(Record record) const { return record >> body_bits_ << body_bits_; }

  std::array<std::uint64_t, static_cast<std::size_t>(D)> stride_{};  ///< difference of key per cell along each axis
  std::array<std::uint64_t, rows.size()> distance_{};                ///< to the earlier rows
  int body_bits_ = 0;
  int key_bits_ = 0;
};

/// The cell as it is, for boxes too large for one number: all coordinates are compared, slower, without any limit.
template <int D>
class WideKeys {
 public:
  struct Record {
    std::array<std::uint32_t, static_cast<std::size_t>(D)> cell;
    Index body;
  };
  using Bound = std::array<std::int64_t, static_cast<std::size_t>(D)>;  ///< a cell, also one beyond the box
  struct Range {
    Bound begin, end;
  };

  template <class Coordinate>
  static std::span<Record> sort(RadixSort<Record>& radix_sort, const CellBounds<D, Coordinate>& box) {
    struct Digit {
      std::size_t axis;
      int shift;
    };
    const int digit_bits = RadixSort<Record>::widest_digit(box.size());
    std::array<Digit, 8 * static_cast<std::size_t>(D)> digits{};  // 32 bits an axis, 4 or more a digit
    int num_digits = 0;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const auto bits = static_cast<int>(std::bit_width(box.extent(axis)));
      for (int shift = 0; shift < bits; shift += digit_bits)
        digits[static_cast<std::size_t>(num_digits++)] = {axis, shift};
    }
    const auto make = [&](std::size_t body) {
      Record record{{}, static_cast<Index>(body)};
      for (std::size_t axis = 0; axis < D; ++axis) record.cell[axis] = box.at(body, axis);
      return record;
    };
    const std::uint32_t mask = (std::uint32_t{1} << digit_bits) - 1;
    const auto digit = [&](const Record& record, int pass) {
      const auto [axis, shift] = digits[static_cast<std::size_t>(pass)];
      return static_cast<std::size_t>(record.cell[axis] >> shift & mask);
    };
    return radix_sort.sort(box.size(), std::max(num_digits, 1), digit_bits, make, digit, 0);
  }

  static Index body(const Record& record) { return record.body; }

  static bool before(const Record& record, const Bound& bound) {
    for (std::size_t axis = D; axis-- > 0;) {
      if (record.cell[axis] != bound[axis]) return record.cell[axis] < bound[axis];
    }
    return false;
  }

  static Bound end_of_own_row(const Record& record) { return moved(record, {}, 2); }

  static Range touching(const Record& record, std::size_t row) {
    return {moved(record, rows[row], -1), moved(record, rows[row], 2)};
  }

  static std::size_t advance(const Record* sorted, std::size_t place, const Bound& bound) {
    while (before(sorted[place], bound)) ++place;
    return place;
  }

 private:
  static constexpr auto rows = earlier_rows<D>();

  static Bound moved(const Record& record, const std::array<int, static_cast<std::size_t>(D)>& offset, int along_x) {
    Bound bound{};
    for (std::size_t axis = 0; axis < D; ++axis) bound[axis] = std::int64_t{record.cell[axis]} + offset[axis];
    bound[0] += along_x;
    return bound;
  }
};

}  // namespace breccia::detection
