#pragma once

#include <sys/types.h>

#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace breccia {

// Files of a run's folder. The folder may come from others, so that under any name there may be a link to a file
// elsewhere, or a pipe or device on which open and read wait for ever. Here only regular files are opened, and no link
// below the folder is followed.

/// Owns a file descriptor; -1: none.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  [[nodiscard]] int get() const { return value_; }
  [[nodiscard]] int release() { return std::exchange(value_, -1); }
  explicit operator bool() const { return value_ >= 0; }

 private:
  int value_;
};

/// How many names at the end of a path belong to a run's folder and are looked up without following a link.
enum class Depth : int {
  named = 0,     ///< the user named the file itself: a link to a regular file is followed
  file = 1,      ///< a file of a run's folder
  subfolder = 2  ///< a file of one of its folders, such as frames/
};

struct Opened {
  Descriptor descriptor;
  int error = 0;       ///< errno where there is no descriptor; EINVAL for something that is no regular file
  std::string reason;  ///< why there is no descriptor, in words

  explicit operator bool() const { return static_cast<bool>(descriptor); }
};

/// Opens a regular file without waiting. @param flags  of open(2); O_CLOEXEC is added
[[nodiscard]] Opened open_regular(const std::filesystem::path& path, int flags, Depth depth, mode_t mode = 0666);
/// The same below an open folder. @param name  without a slash
[[nodiscard]] Opened open_regular_at(const Descriptor& folder, const std::string& name, int flags, mode_t mode = 0666);

/// Opens the folder of a file of that depth. @pre depth != Depth::named
[[nodiscard]] Opened open_folder_of(const std::filesystem::path& path, Depth depth);
/// Opens a folder below an open one; a link is not followed.
[[nodiscard]] Opened open_folder_at(const Descriptor& folder, const std::string& name);

/// "is a symbolic link", "is a pipe", ...; empty: a regular file, a folder, or nothing stands there.
[[nodiscard]] std::string unusual_kind(const std::filesystem::path& path);

/// Content of a file; nullopt: there is none. Throws InputError that names the file: no regular file, no permission.
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
  friend std::optional<std::string> regular_content(const Descriptor& folder, const std::string& name,
                                                    const std::filesystem::path& path);
  RegularStream(Opened file, const std::filesystem::path& path);

  std::unique_ptr<std::streambuf> buffer_;
};

}  // namespace breccia
