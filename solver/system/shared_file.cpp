#include "system/shared_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {

namespace {

/// With O_CREAT, a new one: what a run that was killed, or somebody else, left under the name is removed.
Opened opened(const std::filesystem::path& path, int flags) {
  Opened folder = open_folder_of(path, Depth::subfolder);
  if (!folder) return folder;
  const std::string name = path.filename().string();
  const bool is_new = (flags & O_CREAT) != 0;
  if (is_new) ::unlinkat(folder.descriptor.get(), name.c_str(), 0);
  return open_regular_at(folder.descriptor, name, O_WRONLY | flags | (is_new ? O_EXCL : 0));
}

}  // namespace

SharedFile::SharedFile(const std::filesystem::path& path, const std::filesystem::path& file, int flags)
    : file_(file), descriptor_(-1) {
  Opened result = opened(path, flags);
  if (!result) throw output_error(file_, "cannot write this file: " + result.reason);
  descriptor_ = result.descriptor.release();
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
