#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace breccia {

/// SHA-256 of the bytes (FIPS 180-4), as 64 hexadecimal digits. O(bytes).
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);
/// Of a regular file's bytes; empty: it is none, or cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace breccia
