#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "output/frames/vtkhdf_layout.hpp"

namespace breccia {

// A checkpoint is an HDF5 file that any program for such files reads. Breccia itself reads it by an index of its own,
// the dataset `index`, so that no damaged file is given to a library: the first bytes, in front of those of HDF5 (its
// user block), contain the place of the index. Every byte of the file has a checksum.

inline constexpr std::uint64_t kCheckpointHeader = 512;  ///< bytes
inline constexpr int kCheckpointFormat = 14;

/// 64-bit checksum: any change of one bit changes it.
[[nodiscard]] std::uint64_t checksum_of(std::span<const std::byte> bytes);

/// Bytes of the file that lie together.
struct IndexedBytes {
  std::uint64_t offset = 0, size = 0, checksum = 0;
};

struct IndexedColumn {
  std::string path;  ///< group/name
  NumberType type = NumberType::uint8;
  int components = 1;
  std::uint64_t offset = 0;
  bool zero = false;                     ///< all its numbers are 0, and it is not stored
  std::vector<std::uint64_t> rows;       ///< by rank that wrote them
  std::vector<std::uint64_t> checksums;  ///< likewise
};

struct CheckpointIndex {
  std::int64_t step = 0;
  double time = 0;         ///< s
  std::uint64_t size = 0;  ///< bytes of the file
  std::vector<IndexedColumn> columns;
  std::vector<IndexedBytes> structure;  ///< what is neither of the header, a column nor the index
};

[[nodiscard]] std::string index_text(const CheckpointIndex& index);
/// Bytes of a text with so many columns, parts of the structure and ranks at most.
[[nodiscard]] std::size_t index_bound(const std::vector<IndexedColumn>& columns, std::size_t parts, std::size_t ranks);
/// The first bytes of the file. @param place  of the index, with its checksum
[[nodiscard]] std::vector<std::byte> header_bytes(const IndexedBytes& place, std::uint64_t file_size);

/// Reads and verifies header, index and structure. Throws InputError that names the file.
[[nodiscard]] CheckpointIndex read_index(const std::filesystem::path& file);

/// The bytes at a place of a file. Throws InputError, also when they do not have their checksum.
/// @param what  they are, for messages
[[nodiscard]] std::vector<std::byte> read_verified(const std::filesystem::path& file, const IndexedBytes& place,
                                                   const std::string& what);

/// The error of a checkpoint that cannot be used.
[[noreturn]] void refuse_checkpoint(const std::filesystem::path& file, const std::string& what);

}  // namespace breccia
