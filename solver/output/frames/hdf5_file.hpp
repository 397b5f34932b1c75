#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/frames/vtkhdf_layout.hpp"

namespace breccia {

/// What HDF5, or the memory it works on, could not do.
struct Hdf5Failure {
  std::string what;
  int error_number = 0;  ///< errno, 0: none
};

/// How a file presents itself to its readers.
struct Hdf5Format {
  std::string root;                 ///< the group that holds everything
  std::string type;                 ///< its attribute Type; its Version is (1, 0)
  std::vector<std::string> groups;  ///< below it: those that columns may name
  std::uint64_t user_block = 0;     ///< bytes before those of HDF5, for us: 0, or a power of 2 from 512 on
};
[[nodiscard]] Hdf5Format vtkhdf_format();

// HDF5 works in memory only, so that Breccia writes to the disk itself: HDF5 does not release a file that it cannot
// write, and prints nothing to stderr here. Both functions throw Hdf5Failure.

/// The bytes of a file with these datasets and their values.
/// @pre the columns are those of a rank that is alone. Allocates twice the size of the file.
[[nodiscard]] std::vector<std::byte> hdf5_image(std::span<const Column> columns);

/// A file without the values of its datasets: each has a place of its own, contiguous and plain.
struct Hdf5Skeleton {
  struct Part {
    std::uint64_t offset;
    std::vector<std::byte> bytes;
  };
  std::uint64_t size;                  ///< bytes of the whole file
  std::vector<std::uint64_t> offsets;  ///< (columns) where the values begin
  std::vector<Part> structure;         ///< everything that is no value
};
/// Allocates memory for the structure alone, for any number of rows, but needs the right to create a file of that size.
[[nodiscard]] Hdf5Skeleton hdf5_skeleton(std::span<const Column> columns, const Hdf5Format& format = vtkhdf_format());

}  // namespace breccia
