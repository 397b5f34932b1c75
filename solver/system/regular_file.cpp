#include "system/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <ext/stdio_filebuf.h>

#include <cerrno>
#include <cstdint>

#include "base/error.hpp"

namespace breccia {
namespace {

InputError unreadable(const std::filesystem::path& path, const std::string& reason) {
  return InputError(Problem{path.string(), 0, "", "cannot read this file: " + reason, "", ""});
}

bool is_missing(const Opened& file) { return !file && (file.error == ENOENT || file.error == ENOTDIR); }

std::optional<std::string> content_of(const Opened& file, const std::filesystem::path& path) {
  if (is_missing(file)) return std::nullopt;
  if (!file) throw unreadable(path, file.reason);
  struct stat about {};
  if (::fstat(file.descriptor.get(), &about) != 0 || static_cast<std::uint64_t>(about.st_size) > kLargestContent)
    throw unreadable(path, "it is larger than such a file may be");
  return bytes_from(file.descriptor, 0, kLargestContent);
}

}  // namespace

std::optional<std::string> regular_content(const std::filesystem::path& path, Depth depth) {
  return content_of(open_regular(path, O_RDONLY, depth), path);
}

std::optional<std::string> regular_content(const Descriptor& folder, const std::string& name,
                                           const std::filesystem::path& path) {
  return content_of(open_regular_at(folder, name, O_RDONLY), path);
}

RegularStream::RegularStream(const std::filesystem::path& path, Depth depth)
    : RegularStream(open_regular(path, O_RDONLY, depth), path) {}

RegularStream::RegularStream(Opened file, const std::filesystem::path& path) : std::istream(nullptr) {
  if (!file && !is_missing(file)) throw unreadable(path, file.reason);
  if (file) buffer_ = std::make_unique<__gnu_cxx::stdio_filebuf<char>>(file.descriptor.release(), std::ios::in);
  rdbuf(buffer_.get());
  if (buffer_ == nullptr) setstate(std::ios::failbit);
}

RegularStream::~RegularStream() { rdbuf(nullptr); }

}  // namespace breccia
