#include "output/vtkhdf_image.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/error.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5_file.hpp"
#include "output/vtkhdf_layout.hpp"

namespace breccia {
namespace {

/// A file that several ranks write, each to places of its own.
class SharedFile {
 public:
  /// @param file  named in errors;  @param flags  of open(2), beside O_WRONLY
  SharedFile(const std::filesystem::path& path, const std::filesystem::path& file, int flags)
      : file_(file), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666)) {
    if (descriptor_ < 0) fail(errno);
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  ~SharedFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  /// Takes the space on the disk where that can be done beforehand.
  void reserve(std::uint64_t size) const {
    const int error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(size));
    if (error != 0 && error != EOPNOTSUPP && error != EINVAL) fail(error);
  }
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (written < 0 && errno != EINTR) fail(errno);
      if (written <= 0) continue;
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      offset += static_cast<std::uint64_t>(written);
    }
  }
  /// What has been written here is on the disk: other machines, and the rank that renames the file, can rely on it.
  void finish() {
    int error = ::fsync(descriptor_) == 0 || errno == EINVAL ? 0 : errno;
    if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
    if (error != 0) fail(error);
  }

 private:
  [[noreturn]] void fail(int error) const { throw output_error(file_, "cannot write this file", error); }

  std::filesystem::path file_;
  int descriptor_;
};

std::vector<std::byte> packed(std::span<const std::uint64_t> numbers) {
  const auto bytes = std::as_bytes(numbers);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::byte> vtkhdf_image(const GridView& grid) try {
  check_sizes(grid);
  return hdf5_image(vtkhdf_columns(grid, Pieces({}, num_cells(grid))));
} catch (const Hdf5Failure& failure) {
  throw output_error("HDF5", "cannot build a frame in memory: " + failure.what, failure.error_number);
}

void write_vtkhdf_temporary(const std::filesystem::path& path, const GridView& grid, const Communicator& communicator) {
  const std::filesystem::path temporary = temporary_of(path);
  communicator.agree([&] { check_sizes(grid); });
  const std::vector<Column> columns = vtkhdf_columns(grid, Pieces(communicator, num_cells(grid)));
  std::vector<std::byte> places;
  communicator.agree([&] {
    if (!communicator.is_root()) return;
    try {
      const Hdf5Skeleton skeleton = hdf5_skeleton(columns);
      const SharedFile file(temporary, path, O_CREAT | O_TRUNC);
      file.reserve(skeleton.size);
      for (const Hdf5Skeleton::Part& part : skeleton.structure) file.write_at(part.offset, part.bytes);
      places = packed(skeleton.offsets);
    } catch (const Hdf5Failure& failure) {
      throw output_error(path, "cannot write this file: HDF5 failed at " + failure.what, failure.error_number);
    }
  });
  communicator.broadcast(places);
  communicator.agree([&] {
    const auto* const offsets = reinterpret_cast<const std::uint64_t*>(places.data());
    SharedFile file(temporary, path, 0);
    std::vector<std::byte> space;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Column& column = columns[i];
      if (column.rows.mine > 0) file.write_at(offsets[i] + column.rows.before * column.row_size(), column.bytes(space));
    }
    file.finish();
  });
}

}  // namespace breccia
