#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace breccia {

/// The problem with a file that is not there.
inline constexpr const char* kDoesNotExist = "does not exist";

/// A file's content, or why it is not had.
struct BoundedFile {
  std::string text;
  std::string problem;  ///< in words, as Problem::what; empty: `text` is the whole content
};

/// Reads a whole file without ever waiting for it: regular files only (a pipe or device is opened but not read), and no
/// more than `most` bytes are read, for any stated file size.
/// @param most  bytes of the largest file that is read
/// Throws nothing but bad_alloc.
[[nodiscard]] BoundedFile read_bounded(const std::filesystem::path& file, std::uint64_t most);

/// "64 MB", with decimal prefixes and three digits.
[[nodiscard]] std::string bytes_text(std::uint64_t bytes);

}  // namespace breccia
