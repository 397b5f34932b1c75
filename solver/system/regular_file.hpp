#pragma once

#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>

#include "system/open_regular.hpp"

namespace breccia {

/// Content of a file; nullopt: there is none. Throws InputError that names the file: no regular file, no permission,
/// larger than kLargestContent.
[[nodiscard]] std::optional<std::string> regular_content(const std::filesystem::path& path, Depth depth = Depth::file);

/// The same of a file in an open folder. @param path  for messages
[[nodiscard]] std::optional<std::string> regular_content(const Descriptor& folder, const std::string& name,
                                                         const std::filesystem::path& path);

/// Reads a regular file. A file that is not there gives a stream that is not good.
class RegularStream : public std::istream {
 public:
  /// Throws InputError that names the file: no regular file, no permission.
  explicit RegularStream(const std::filesystem::path& path, Depth depth = Depth::file);
  RegularStream(const RegularStream&) = delete;
  RegularStream& operator=(const RegularStream&) = delete;
  ~RegularStream() override;

 private:
  RegularStream(Opened file, const std::filesystem::path& path);

  std::unique_ptr<std::streambuf> buffer_;
};

}  // namespace breccia
