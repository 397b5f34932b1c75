#include "system/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <ext/stdio_filebuf.h>

#include <cerrno>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/error.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

std::string words_of(int error) { return std::generic_category().message(error); }

std::string kind_of(mode_t mode) {
  if (S_ISLNK(mode)) return "is a symbolic link";
  if (S_ISFIFO(mode)) return "is a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device";
  if (S_ISSOCK(mode)) return "is a socket";
  return {};
}

Opened failed(int error) { return {Descriptor(), error, words_of(error)}; }

Opened no_regular_file(mode_t mode) {
  if (S_ISDIR(mode)) return failed(EISDIR);
  return {Descriptor(), EINVAL, kind_of(mode) + ", not a regular file"};
}

/// Of what could not be opened: a link gives ELOOP, a socket or a pipe without a reader ENXIO.
Opened failed_at(int folder, const char* name, int error) {
  struct stat about {};
  const bool seen = ::fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW) == 0;
  if (seen && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode)) return no_regular_file(about.st_mode);
  return failed(error);
}

Opened opened_at(int folder, const char* name, int flags, mode_t mode) {
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
Opened opened_folder_at(int folder, const char* name, int flags) {
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

}  // namespace

Descriptor::~Descriptor() {
  if (value_ >= 0) ::close(value_);
}

Opened open_folder_at(const Descriptor& folder, const std::string& name) {
  return opened_folder_at(folder.get(), name.c_str(), O_NOFOLLOW);
}

Opened open_folder_of(const fs::path& path, Depth depth) {
  std::vector<std::string> below;
  fs::path above = path.parent_path();
  for (int level = static_cast<int>(depth); level > 1; --level) {
    below.insert(below.begin(), above.filename().string());
    above = above.parent_path();
  }
  Opened folder = opened_folder_at(AT_FDCWD, above.empty() ? "." : above.c_str(), 0);
  for (const std::string& name : below) {
    if (folder) folder = open_folder_at(folder.descriptor, name);
  }
  return folder;
}

Opened open_regular_at(const Descriptor& folder, const std::string& name, int flags, mode_t mode) {
  return opened_at(folder.get(), name.c_str(), flags | O_NOFOLLOW, mode);
}

Opened open_regular(const fs::path& path, int flags, Depth depth, mode_t mode) {
  if (depth == Depth::named) return opened_at(AT_FDCWD, path.c_str(), flags, mode);
  Opened folder = open_folder_of(path, depth);
  if (!folder) return folder;
  return open_regular_at(folder.descriptor, path.filename().string(), flags, mode);
}

std::string unusual_kind(const fs::path& path) {
  struct stat about {};
  return ::lstat(path.c_str(), &about) == 0 ? kind_of(about.st_mode) : std::string();
}

namespace {

std::optional<std::string> content_of(std::istream& stream) {
  if (!stream) return std::nullopt;
  std::ostringstream text;
  if (stream.peek() != std::istream::traits_type::eof()) text << stream.rdbuf();
  return std::move(text).str();
}

}  // namespace

std::optional<std::string> regular_content(const fs::path& path, Depth depth) {
  RegularStream stream(path, depth);
  return content_of(stream);
}

std::optional<std::string> regular_content(const Descriptor& folder, const std::string& name, const fs::path& path) {
  RegularStream stream(open_regular_at(folder, name, O_RDONLY), path);
  return content_of(stream);
}

RegularStream::RegularStream(const fs::path& path, Depth depth)
    : RegularStream(open_regular(path, O_RDONLY, depth), path) {}

RegularStream::RegularStream(Opened file, const fs::path& path) : std::istream(nullptr) {
  if (!file && file.error != ENOENT && file.error != ENOTDIR)
    throw InputError(Problem{path.string(), 0, "", "cannot read this file: " + file.reason, "", ""});
  if (file) buffer_ = std::make_unique<__gnu_cxx::stdio_filebuf<char>>(file.descriptor.release(), std::ios::in);
  rdbuf(buffer_.get());
  if (buffer_ == nullptr) setstate(std::ios::failbit);
}

RegularStream::~RegularStream() { rdbuf(nullptr); }

}  // namespace breccia
