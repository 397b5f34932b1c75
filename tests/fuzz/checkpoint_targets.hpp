#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace breccia::fuzz {

using Bytes = std::vector<std::byte>;

/// One file of this process in memory-backed storage where there is some.
[[nodiscard]] const std::filesystem::path& scratch_file();

/// The whole file: nearly everything ends at a checksum.
void read_checkpoint_file(std::span<const std::byte> bytes);
[[nodiscard]] std::vector<Bytes> checkpoint_seeds();
/// The text of the index, with the right checksum: what it says of the file is wrong.
void read_checkpoint_index(std::span<const std::byte> bytes);
[[nodiscard]] std::vector<Bytes> index_seeds();
/// The numbers of the state, with the right checksums.
void read_checkpoint_state(std::span<const std::byte> bytes);
[[nodiscard]] std::vector<Bytes> state_seeds();

}  // namespace breccia::fuzz
