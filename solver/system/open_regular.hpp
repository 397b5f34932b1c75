#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace breccia {

// Files of a run's folder. The folder may come from others, so that under any name there may be a link to a file
// elsewhere, or a pipe or device on which open and read wait for ever. Here only regular files are opened, and no link
// below the folder is followed. Header only: desktop, plug-ins and adaptor, which link nothing of the solver, open the
// files of a run by the same rules.

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
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }

  [[nodiscard]] int get() const { return value_; }
  [[nodiscard]] int release() { return std::exchange(value_, -1); }
  explicit operator bool() const { return value_ >= 0; }

 private:
  int value_;
};

/// How many names at the end of a path belong to a run's folder and are resolved without following a link.
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

namespace open_regular_detail {

inline std::string kind_of(mode_t mode) {
  if (S_ISLNK(mode)) return "is a symbolic link";
  if (S_ISFIFO(mode)) return "is a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device";
  if (S_ISSOCK(mode)) return "is a socket";
  return {};
}

inline Opened failed(int error) { return {Descriptor(), error, std::generic_category().message(error)}; }

inline Opened no_regular_file(mode_t mode) {
  if (S_ISDIR(mode)) return failed(EISDIR);
  return {Descriptor(), EINVAL, kind_of(mode) + ", not a regular file"};
}

/// Of what could not be opened: a link gives ELOOP, a socket or a pipe without a reader ENXIO.
inline Opened failed_at(int folder, const char* name, int error) {
  struct stat about {};
  const bool seen = ::fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW) == 0;
  if (seen && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode)) return no_regular_file(about.st_mode);
  return failed(error);
}

inline Opened opened_at(int folder, const char* name, int flags, mode_t mode) {
  // O_TRUNC only once it is known to be a regular file.
  Descriptor file(::openat(folder, name, (flags & ~O_TRUNC) | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, mode));
  if (!file) return failed_at(folder, name, errno);
  struct stat about {};
  if (::fstat(file.get(), &about) != 0) return failed(errno);
  if (!S_ISREG(about.st_mode)) return no_regular_file(about.st_mode);
  if ((flags & O_TRUNC) != 0 && ::ftruncate(file.get(), 0) != 0) return failed(errno);
  return {std::move(file), 0, {}};
}

/// To read it, or at least to reach what is in it: a folder may be writable but not readable.
inline Opened opened_folder_at(int folder, const char* name, int flags) {
  constexpr int kFolder = O_DIRECTORY | O_CLOEXEC | O_NONBLOCK;
  Descriptor found(::openat(folder, name, O_RDONLY | kFolder | flags));
  if (!found && errno == EACCES) found = Descriptor(::openat(folder, name, O_PATH | kFolder | flags));
  if (found) return {std::move(found), 0, {}};
  const int error = errno;
  struct stat about {};
  const bool seen = flags != 0 && ::fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW) == 0;
  if (seen && S_ISLNK(about.st_mode)) return {Descriptor(), error, "is a symbolic link, not a folder"};
  return failed(error);
}

}  // namespace open_regular_detail

/// Opens a folder below an open one; a link is not followed.
[[nodiscard]] inline Opened open_folder_at(const Descriptor& folder, const std::string& name) {
  return open_regular_detail::opened_folder_at(folder.get(), name.c_str(), O_NOFOLLOW);
}

/// Opens the folder of a file of that depth. @pre depth != Depth::named
[[nodiscard]] inline Opened open_folder_of(const std::filesystem::path& path, Depth depth) {
  std::vector<std::string> below;
  std::filesystem::path above = path.parent_path();
  for (int level = static_cast<int>(depth); level > 1; --level) {
    below.insert(below.begin(), above.filename().string());
    above = above.parent_path();
  }
  Opened folder = open_regular_detail::opened_folder_at(AT_FDCWD, above.empty() ? "." : above.c_str(), 0);
  for (const std::string& name : below) {
    if (folder) folder = open_folder_at(folder.descriptor, name);
  }
  return folder;
}

/// Opens a regular file of an open folder without waiting. @param name  without a slash  @param flags  of open(2);
/// O_CLOEXEC is added
[[nodiscard]] inline Opened open_regular_at(const Descriptor& folder, const std::string& name, int flags,
                                            mode_t mode = 0666) {
  return open_regular_detail::opened_at(folder.get(), name.c_str(), flags | O_NOFOLLOW, mode);
}

/// The same by a path.
[[nodiscard]] inline Opened open_regular(const std::filesystem::path& path, int flags, Depth depth,
                                         mode_t mode = 0666) {
  if (depth == Depth::named) return open_regular_detail::opened_at(AT_FDCWD, path.c_str(), flags, mode);
  Opened folder = open_folder_of(path, depth);
  if (!folder) return folder;
  return open_regular_at(folder.descriptor, path.filename().string(), flags, mode);
}

/// "is a symbolic link", "is a pipe", ...; empty: a regular file, a folder, or nothing stands there.
[[nodiscard]] inline std::string unusual_kind(const std::filesystem::path& path) {
  struct stat about {};
  return ::lstat(path.c_str(), &about) == 0 ? open_regular_detail::kind_of(about.st_mode) : std::string();
}

/// Bytes of the largest file that is read whole: a history of a million lines has about one gigabyte.
inline constexpr std::uint64_t kLargestContent = std::uint64_t{1} << 32;

/// Bytes of a file from `begin` on, as many as there are when it is read and `most` at most: reading a file that grows
/// ends. Fewer where reading fails.
[[nodiscard]] inline std::string bytes_from(const Descriptor& file, std::uint64_t begin, std::uint64_t most) {
  struct stat about {};
  if (::fstat(file.get(), &about) != 0 || about.st_size < 0) return {};
  const auto size = static_cast<std::uint64_t>(about.st_size);
  const std::uint64_t wanted = size > begin ? std::min(size - begin, most) : 0;
  constexpr std::uint64_t kPiece = 1 << 24;  // memory is allocated as bytes arrive, for any stated file size
  std::string text;
  while (text.size() < wanted) {
    const std::size_t had = text.size();
    text.resize(had + static_cast<std::size_t>(std::min(wanted - had, kPiece)));
    const ssize_t got = ::pread(file.get(), text.data() + had, text.size() - had, static_cast<off_t>(begin + had));
    const bool again = got < 0 && errno == EINTR;
    text.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got <= 0 && !again) break;
  }
  return text;
}

}  // namespace breccia
