#include "output/shared_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "output/atomic_file.hpp"

namespace breccia {

SharedFile::SharedFile(const std::filesystem::path& path, const std::filesystem::path& file, int flags)
    : file_(file), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666)) {
  if (descriptor_ < 0) fail(errno);
}

SharedFile::~SharedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SharedFile::reserve(std::uint64_t size) const {
  // Not posix_fallocate: where a file system has none (NFS 3), that reads the file, and writes where other ranks write.
  if (::fallocate(descriptor_, 0, 0, static_cast<off_t>(size)) == 0) return;
  if (errno != EOPNOTSUPP && errno != EINVAL && errno != ENOSYS) fail(errno);
}

void SharedFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) fail(errno);
    if (written <= 0) continue;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void SharedFile::finish() {
  int error = ::fsync(descriptor_) == 0 || errno == EINVAL ? 0 : errno;
  if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
  if (error != 0) fail(error);
}

void SharedFile::fail(int error) const { throw output_error(file_, "cannot write this file", error); }

}  // namespace breccia
