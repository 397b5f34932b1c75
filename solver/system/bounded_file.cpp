#include "system/bounded_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/number_text.hpp"

namespace breccia {
namespace {

/// What is wrong with an open file before it is read; empty: nothing.
std::string kind_problem(int descriptor, std::uint64_t most) {
  struct stat about {};
  if (::fstat(descriptor, &about) != 0) return std::string("cannot be read: ") + std::strerror(errno);
  if (S_ISDIR(about.st_mode)) return "is a folder";
  if (!S_ISREG(about.st_mode)) return "is not a file";
  if (static_cast<std::uint64_t>(about.st_size) > most)
    return "is larger (" + bytes_text(static_cast<std::uint64_t>(about.st_size)) + ") than such a file may be (" +
           bytes_text(most) + ")";
  return {};
}

/// Reads to the end, which files of /proc reach beyond their size.
std::string read_all(int descriptor, std::uint64_t most, std::string& text) {
  constexpr std::size_t kPiece = 1 << 20;
  for (;;) {
    const std::size_t had = text.size();
    if (had > most) return "is larger than such a file may be (" + bytes_text(most) + ")";
    text.resize(had + kPiece);
    const ssize_t got = ::read(descriptor, text.data() + had, kPiece);
    text.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return {};
    if (got < 0 && errno != EINTR) return std::string("cannot be read: ") + std::strerror(errno);
  }
}

}  // namespace

BoundedFile read_bounded(const std::filesystem::path& file, std::uint64_t most) {
  BoundedFile read;
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) {
    read.problem =
        errno == ENOENT || errno == ENOTDIR ? kDoesNotExist : std::string("cannot be read: ") + std::strerror(errno);
    return read;
  }
  read.problem = kind_problem(descriptor, most);
  if (read.problem.empty()) read.problem = read_all(descriptor, most, read.text);
  ::close(descriptor);
  if (!read.problem.empty()) read.text.clear();
  return read;
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array kPrefixes{" B", " kB", " MB", " GB", " TB", " PB", " EB"};
  auto value = static_cast<double>(bytes);
  std::size_t prefix = 0;
  for (; value >= 999.5 && prefix + 1 < kPrefixes.size(); ++prefix) value /= 1000;
  return number_text(value, 3) + kPrefixes[prefix];
}

}  // namespace breccia
