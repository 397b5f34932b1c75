#include "output/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace breccia {
namespace {

constexpr mode_t kFileMode = 0666;  // less the user's umask

/// Writes all of `content`; returns 0 or the errno of the write that failed.
int write_all(int descriptor, std::span<const std::byte> content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    content = content.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Syncs a descriptor; pipes and devices that cannot be synced have nothing to lose. Returns 0 or errno.
int sync_descriptor(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS) return 0;
  return errno;
}

/// Makes the rename itself durable. Returns 0 or errno.
int sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES ? 0 : errno;  // a folder may be writable but not readable
  const int error = sync_descriptor(descriptor);
  ::close(descriptor);
  return error;
}

/// Creates `path` with `content`, or takes the file as it is; on the disk when it returns. Returns 0 or errno.
int write_synced(const std::filesystem::path& path, std::optional<std::span<const std::byte>> content) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | (content ? O_CREAT | O_TRUNC : 0), kFileMode);
  if (descriptor < 0) return errno;
  int error = content ? write_all(descriptor, *content) : 0;
  if (error == 0) error = sync_descriptor(descriptor);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

OutputError output_error(const std::filesystem::path& path, const std::string& what, int error_number) {
  Problem problem;
  problem.file = path.string();
  problem.what = error_number == 0 ? what : what + ": " + std::generic_category().message(error_number);
  return OutputError(problem);
}

void create_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw output_error(path, "cannot create this folder", error.value());
}

std::filesystem::path temporary_of(const std::filesystem::path& path) {
  return path.parent_path() / ("." + path.filename().string() + ".tmp");
}

void write_files_atomically(std::span<const FileContent> files) {
  const FileContent* failed = nullptr;
  int error = 0;
  const auto attempt = [&](const FileContent& file, int result) {
    if (result != 0 && error == 0) {
      error = result;
      failed = &file;
    }
  };
  for (const FileContent& file : files) {
    if (error == 0) attempt(file, write_synced(temporary_of(file.path), file.content));
  }
  for (const FileContent& file : files) {
    if (error == 0 && ::rename(temporary_of(file.path).c_str(), file.path.c_str()) != 0) attempt(file, errno);
  }
  if (error != 0) {
    for (const FileContent& file : files) ::unlink(temporary_of(file.path).c_str());
    throw output_error(failed->path, "cannot write this file", error);
  }
  if (files.empty()) return;
  const std::filesystem::path& path = files.back().path;
  error = sync_folder(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
  if (error != 0) throw output_error(path, "cannot write its folder to the disk", error);
}

void sync_file(const std::filesystem::path& path) {
  const int error = write_synced(path, {});
  if (error != 0 && error != ENOENT) throw output_error(path, "cannot write this file to the disk", error);
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content) {
  const FileContent file{path, content};
  write_files_atomically({&file, 1});
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  write_file_atomically(path, bytes_of(content));
}

namespace {
constexpr std::size_t kReserve = 8192;  // bytes
}

LineFile::LineFile(std::filesystem::path path, std::size_t keep) : path_(std::move(path)), size_(keep) {
  const int fresh = keep == 0 ? O_TRUNC : 0;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | fresh, kFileMode);
  if (descriptor_ < 0) throw output_error(path_, "cannot create this file", errno);
  if (keep == 0) {
    reserve();
    return;
  }
  struct stat status {};
  int error = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
  const bool too_short = error == 0 && static_cast<std::size_t>(status.st_size) < keep;
  if (error == 0 && !too_short && ::ftruncate(descriptor_, static_cast<off_t>(keep)) != 0) error = errno;
  if (error == 0 && !too_short) return;
  ::close(descriptor_);
  throw output_error(
      path_,
      too_short ? "this file has lost lines that were written before the checkpoint" : "cannot go on with this file",
      error);
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::append_line(std::string_view line) {
  std::string whole(line);
  whole += '\n';
  const int error = write_all(descriptor_, bytes_of(whole));
  if (error != 0) {
    // What cannot be cut (a device) holds no lines either, so the result does not matter.
    [[maybe_unused]] const int cut = ::ftruncate(descriptor_, static_cast<off_t>(size_));
    throw output_error(path_, "cannot append a line to this file", error);
  }
  size_ += whole.size();
  reserve();
}

/// Room for the next lines, so that a run that ends because the disk is full can still say so. Not every system can.
void LineFile::reserve() {
  if (size_ + kReserve / 2 > reserved_ &&
      ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(size_), kReserve) == 0)
    reserved_ = size_ + kReserve;
}

void LineFile::sync() {
  const int error = sync_descriptor(descriptor_);
  if (error != 0) throw output_error(path_, "cannot write this file to the disk", error);
}

}  // namespace breccia
