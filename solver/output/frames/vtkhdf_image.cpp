#include "output/frames/vtkhdf_image.hpp"

#include <fcntl.h>

#include "base/error.hpp"
#include "output/frames/hdf5_file.hpp"
#include "output/frames/vtkhdf_layout.hpp"
#include "system/atomic_file.hpp"
#include "system/shared_file.hpp"

namespace breccia {
namespace {

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
      const SharedFile file(temporary, path, O_CREAT);
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
