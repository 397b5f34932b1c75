#include "system/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "system/write_all.hpp"

namespace breccia {
namespace {

constexpr mode_t kFileMode = 0666;  // less the user's umask

/// Syncs a descriptor; pipes and devices that cannot be synced have nothing to lose. Returns 0 or errno.
int sync_descriptor(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS) return 0;
  return errno;
}

/// Makes the rename itself durable. Returns 0 or errno.
int sync_folder(const Descriptor& folder) {
  const int error = sync_descriptor(folder.get());
  return error == EBADF ? 0 : error;  // a folder that is writable but not readable cannot be synced
}

/// Why a file cannot be written.
struct Failure {
  std::string reason;  ///< empty: it is written
};

Failure failure_of(int error) { return {error == 0 ? std::string() : std::generic_category().message(error)}; }

/// Makes the file `name` with `content`, or opens the one that is there; on the disk when it returns. What stands under
/// the name of a new file is removed first, so that no link is followed and no file of another name is written.
Failure write_synced(const Descriptor& folder, const std::string& name,
                     std::optional<std::span<const std::byte>> content) {
  if (content) ::unlinkat(folder.get(), name.c_str(), 0);
  Opened file = open_regular_at(folder, name, O_WRONLY | (content ? O_CREAT | O_EXCL : 0), kFileMode);
  if (!file) return {file.reason};
  const int descriptor = file.descriptor.release();
  int error = content ? write_all(descriptor, *content) : 0;
  if (error == 0) error = sync_descriptor(descriptor);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return failure_of(error);
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

void write_files_atomically(std::span<const FileContent> files, Depth depth) {
  if (files.empty()) return;
  const Opened folder = open_folder_of(files.front().path, depth);
  if (!folder) throw output_error(files.front().path, "cannot write this file: its folder: " + folder.reason);
  write_files_atomically(folder.descriptor, files);
}

void write_files_atomically(const Descriptor& folder, std::span<const FileContent> files) {
  const int at = folder.get();
  const FileContent* failed = nullptr;
  std::string reason;
  const auto attempt = [&](const FileContent& file, const Failure& result) {
    if (!result.reason.empty() && failed == nullptr) {
      reason = result.reason;
      failed = &file;
    }
  };
  const auto temporary = [](const FileContent& file) { return temporary_of(file.path).filename().string(); };
  for (const FileContent& file : files) {
    if (failed == nullptr) attempt(file, write_synced(folder, temporary(file), file.content));
  }
  for (const FileContent& file : files) {
    const std::string name = file.path.filename().string();
    if (failed == nullptr && ::renameat(at, temporary(file).c_str(), at, name.c_str()) != 0)
      attempt(file, failure_of(errno));
  }
  if (failed != nullptr) {
    for (const FileContent& file : files) ::unlinkat(at, temporary(file).c_str(), 0);
    throw output_error(failed->path, "cannot write this file: " + reason);
  }
  const int error = sync_folder(folder);
  if (error != 0) throw output_error(files.back().path, "cannot write its folder to the disk", error);
}

void sync_file(const std::filesystem::path& path) {
  const Opened folder = open_folder_of(path, Depth::file);
  struct stat about {};
  if (!folder || (::fstatat(folder.descriptor.get(), path.filename().c_str(), &about, AT_SYMLINK_NOFOLLOW) != 0 &&
                  errno == ENOENT))
    return;
  const Failure failure = write_synced(folder.descriptor, path.filename().string(), {});
  if (!failure.reason.empty()) throw output_error(path, "cannot write this file to the disk: " + failure.reason);
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content, Depth depth) {
  const FileContent file{path, content};
  write_files_atomically({&file, 1}, depth);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content, Depth depth) {
  write_file_atomically(path, bytes_of(content), depth);
}

namespace {
constexpr std::size_t kReserve = 8192;  // bytes
}

LineFile::LineFile(std::filesystem::path path, std::size_t keep) : path_(std::move(path)), size_(keep) {
  const int fresh = keep == 0 ? O_TRUNC : 0;
  Opened file = open_regular(path_, O_WRONLY | O_CREAT | O_APPEND | fresh, Depth::file, kFileMode);
  if (!file) throw output_error(path_, "cannot create this file: " + file.reason);
  descriptor_ = file.descriptor.release();
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
      too_short ? "this file has lost lines that were written before the checkpoint" : "cannot continue this file",
      error);
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::append_line(std::string_view line) {
  std::string whole(line);
  whole += '\n';
  const int error = write_all(descriptor_, whole);
  if (error != 0) {
    // The reported error is that of the write, regardless of this result.
    [[maybe_unused]] const int cut = ::ftruncate(descriptor_, static_cast<off_t>(size_));
    throw output_error(path_, "cannot append a line to this file", error);
  }
  size_ += whole.size();
  reserve();
}

/// Space for the next lines, so that a run that ends because the disk is full can still report it. Not every system
/// can.
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
