#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <string>

#include "system/open_regular.hpp"

namespace breccia::run_folder {

struct Content {
  std::string text;
  std::string problem;     ///< in words, "is a pipe, not a regular file"; empty: `text` is the content
  bool is_missing = true;  ///< nothing stands under the name; no problem then
};

/// Content of a regular file, as long as it is when it is opened. Waits for nothing and follows no link below the run's
/// folder. Throws nothing but std::bad_alloc.
[[nodiscard]] inline Content read_content(const std::filesystem::path& file, Depth depth = Depth::file,
                                          std::uint64_t most = kLargestContent) {
  Content content;
  const Opened opened = open_regular(file, O_RDONLY, depth);
  if (!opened && (opened.error == ENOENT || opened.error == ENOTDIR)) return content;
  content.is_missing = false;
  content.problem = opened.reason;
  if (!opened) return content;
  struct stat about {};
  if (::fstat(opened.descriptor.get(), &about) != 0 || static_cast<std::uint64_t>(about.st_size) > most) {
    content.problem = "is larger than such a file may be";
    return content;
  }
  content.text = bytes_from(opened.descriptor, 0, most);
  return content;
}

}  // namespace breccia::run_folder
