#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "output/frames/vtkhdf_image.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

enum class NumberType { float64, float32, int64, int32, int8, uint8 };
[[nodiscard]] std::size_t size_of(NumberType type);  ///< bytes

/// Rows of a dataset: this rank's follow those of the ranks before it.
struct Rows {
  std::uint64_t mine, before, total;
};

/// The piece of each rank, in cells.
class Pieces {
 public:
  /// Collective.
  Pieces(const Communicator& communicator, std::size_t cells);
  [[nodiscard]] bool alone() const { return cells_.size() == 1; }
  /// Of a dataset with so many rows a cell and so many more a piece.
  [[nodiscard]] Rows rows(std::uint64_t a_cell, std::uint64_t a_piece) const;
  /// Of a dataset that the first rank has for all.
  [[nodiscard]] Rows single() const { return rank_ == 0 ? Rows{1, 0, 1} : Rows{0, 1, 1}; }

 private:
  std::size_t rank_;
  std::vector<std::uint64_t> cells_;
};

/// A dataset of a file, and this rank's part of it.
struct Column {
  std::string group;  ///< below the root; "": the root itself
  std::string name;
  NumberType type;
  int components;  ///< 1: a one-dimensional dataset, else (rows, components)
  Rows rows;
  bool deflates;  ///< worth its time
  /// This rank's rows as they are stored, made on request. @param space  may be used for them; must outlive the result
  std::function<std::span<const std::byte>(std::vector<std::byte>& space)> bytes;
  std::string unit{};  ///< "": none

  [[nodiscard]] std::size_t row_size() const {
    return static_cast<std::size_t>(components) * size_of(type);
  }  ///< bytes
};

/// The datasets of a VTKHDF 1.0 unstructured grid, in the order of the file. Points and offsets are numbered within
/// each piece. The result refers to the grid's arrays.
[[nodiscard]] std::vector<Column> vtkhdf_columns(const GridView& grid, const Pieces& pieces);

[[nodiscard]] std::size_t num_cells(const GridView& grid);
/// Throws InternalError unless all arrays fit the cells.
void check_sizes(const GridView& grid);

}  // namespace breccia
