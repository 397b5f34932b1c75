#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace breccia::detection {

/// Row of cells along x that holds at least one point.
struct Row {
  std::int32_t z, y;
  std::int32_t x_low, x_high;  ///< outermost cells that hold points
  Index count;                 ///< points
  Index begin;                 ///< first entry
  std::int64_t table;          ///< where its cells start in the table of cell starts; -1: too scattered for one

  [[nodiscard]] std::int64_t width() const { return std::int64_t{x_high} - x_low + 1; }
};

/// The rows that hold points, by hash of (z, y) with open addressing. Numbers follow the first appearance.
class RowTable {
 public:
  static constexpr Index none = -1;

  /// Drops all rows, keeps the storage.
  void clear();
  /// Counts a point into its row and returns the row's number. O(1) in the mean.
  Index count_point(std::int32_t z, std::int32_t y, std::int32_t x);
  /// Number of the row, or none. O(1) in the mean.
  [[nodiscard]] Index find(std::int32_t z, std::int32_t y) const {
    const std::uint64_t key = key_of(z, y);
    for (std::size_t slot = slot_of(key);; slot = (slot + 1) & mask_) {
      if (slots_[slot].row == none || slots_[slot].key == key) return slots_[slot].row;
    }
  }
  [[nodiscard]] std::span<Row> rows() { return rows_; }
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }

 private:
  struct Slot {
    std::uint64_t key;
    Index row;
  };

  static std::uint64_t key_of(std::int32_t z, std::int32_t y) {
    return std::uint64_t{static_cast<std::uint32_t>(z)} << 32 | static_cast<std::uint32_t>(y);
  }
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    // Both halves are spread over all bits by odd constants of their own; the upper bits are the well mixed ones.
    const std::uint64_t mixed = (key >> 32) * 0x9E3779B97F4A7C15u + (key & 0xFFFFFFFFu) * 0xC2B2AE3D27D4EB4Fu;
    return static_cast<std::size_t>((mixed ^ mixed >> 29) * 0x9E3779B97F4A7C15u >> 32) & mask_;
  }
  void grow();

  std::vector<Row> rows_;
  std::vector<Slot> slots_ = std::vector<Slot>(64, Slot{0, none});  ///< at most half full
  std::size_t mask_ = 63;
};

}  // namespace breccia::detection
