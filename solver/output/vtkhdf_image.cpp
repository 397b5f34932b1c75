#include "output/vtkhdf_image.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "output/atomic_file.hpp"
#include "parallel/mpi_handle.hpp"

namespace breccia {
namespace {

// Chunks of this many rows: large enough that the chunk index costs nothing, small enough to stay in the cache while
// it is shuffled and deflated.
constexpr hsize_t kChunkRows = 16384;
constexpr unsigned kDeflateLevel = 1;
constexpr std::size_t kImageGrowth = std::size_t{4} << 20;  // bytes by which the file in memory grows
constexpr hsize_t kMetadata = hsize_t{1} << 16;             // bytes, more than the headers of a frame take

/// What HDF5 could not do.
struct Hdf5Failure {
  std::string what;
};

/// HDF5 reports a failure by a negative number.
template <class T>
T checked(T result, const std::string& what) {
  if (result < 0) throw Hdf5Failure{what};
  return result;
}

/// Owns one HDF5 handle.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& what) : id_(checked(id, what)), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  void close_now() { checked(close_(std::exchange(id_, -1)), "close"); }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 prints its error stack by default; the exception says what is needed.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

struct Shape {
  std::size_t points_per_cell;
  std::uint8_t vtk_type;
};

Shape shape_of(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedra:
      return {4, 10};
    case CellKind::triangles:
      return {3, 5};
    case CellKind::vertices:
      break;
  }
  return {1, 1};
}

std::size_t cells_of(const GridView& grid) { return grid.points.size() / 3 / shape_of(grid.kind).points_per_cell; }

/// Rows of a dataset: this rank's follow those of the ranks before it.
struct Rows {
  hsize_t mine, before, total;
};

/// The piece of each rank, in cells.
class Pieces {
 public:
  Pieces(const Communicator& communicator, std::size_t cells) : rank_(static_cast<std::size_t>(communicator.rank())) {
    const auto mine = static_cast<hsize_t>(cells);
    for (const std::vector<hsize_t>& list : communicator.all_gather(std::span(&mine, 1))) cells_.push_back(list.at(0));
  }
  [[nodiscard]] bool alone() const { return cells_.size() == 1; }
  /// Of a dataset with so many rows a cell and so many more a piece.
  [[nodiscard]] Rows rows(hsize_t a_cell, hsize_t a_piece) const {
    const auto up_to = [&](std::size_t end) {
      return a_cell * std::accumulate(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(end), hsize_t{0}) + a_piece * end;
    };
    return {up_to(rank_ + 1) - up_to(rank_), up_to(rank_), up_to(cells_.size())};
  }
  /// Of a dataset that the first rank has for all.
  [[nodiscard]] Rows single() const { return rank_ == 0 ? Rows{1, 0, 1} : Rows{0, 1, 1}; }

 private:
  std::size_t rank_;
  std::vector<hsize_t> cells_;
};

enum class Packing { plain, deflated };

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

Handle make_group(hid_t parent, const char* name) {
  return Handle(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
}

/// Attributes Version = (1, 0) and Type, by which a reader knows the format.
void write_format_attributes(hid_t root) {
  const std::array<std::int64_t, 2> version{1, 0};
  const hsize_t length = version.size();
  const Handle version_space(H5Screate_simple(1, &length, nullptr), H5Sclose, "Version");
  const Handle version_attribute(H5Acreate2(root, "Version", H5T_NATIVE_INT64, version_space, H5P_DEFAULT, H5P_DEFAULT),
                                 H5Aclose, "Version");
  checked(H5Awrite(version_attribute, H5T_NATIVE_INT64, version.data()), "Version");

  const std::string type = "UnstructuredGrid";
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "Type");
  checked(H5Tset_size(text, type.size()), "Type");
  checked(H5Tset_strpad(text, H5T_STR_NULLPAD), "Type");
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "Type");
  const Handle type_attribute(H5Acreate2(root, "Type", text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "Type");
  checked(H5Awrite(type_attribute, text, type.data()), "Type");
}

/// Writes this rank's piece of a grid into an open file, in step with the other ranks: whatever fails on one of them fails
/// on all before the next collective call.
class GridWriter {
 public:
  /// @param run  runs a part of the work on all ranks, and throws on all if it failed on any
  using Run = std::function<void(const std::function<void()>&)>;
  GridWriter(const GridView& grid, const Pieces& pieces, Run run)
      : grid_(grid), pieces_(pieces), run_(std::move(run)), transfer_(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "transfer") {
    if (!pieces.alone()) checked(H5Pset_dxpl_mpio(transfer_, H5FD_MPIO_COLLECTIVE), "transfer");
  }

  void write(hid_t file) const {
    const Handle root = make_group(file, "VTKHDF");
    run_([&] { write_format_attributes(root); });
    write_cells(root);
    write_cell_arrays(root);
    const Handle fields = make_group(root, "FieldData");
    const std::size_t mine = pieces_.single().mine;
    write_dataset(fields, "time", std::span(&grid_.time, mine), 1, pieces_.single(), Packing::plain);
    write_dataset(fields, "step", std::span(&grid_.step, mine), 1, pieces_.single(), Packing::plain);
  }

 private:
  /// One-dimensional when components is 1.
  template <class T>
  void write_dataset(hid_t parent, const std::string& name, std::span<const T> values, int components, const Rows& rows,
                     Packing packing) const {
    const auto width = static_cast<hsize_t>(components);
    const int dimensions = components == 1 ? 1 : 2;
    const std::array<hsize_t, 2> shape{rows.total, width}, part{rows.mine, width}, start{rows.before, 0};
    run_([&] {
      const Handle space(H5Screate_simple(dimensions, shape.data(), nullptr), H5Sclose, name);
      const Handle piece(H5Screate_simple(dimensions, part.data(), nullptr), H5Sclose, name);
      const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
      checked(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), name);
      if (pieces_.alone() && packing == Packing::deflated && rows.total > 0) {
        const std::array<hsize_t, 2> chunk{std::min(rows.total, kChunkRows), width};
        checked(H5Pset_chunk(creation, dimensions, chunk.data()), name);
        checked(H5Pset_shuffle(creation), name);
        checked(H5Pset_deflate(creation, kDeflateLevel), name);
      }
      const Handle data(H5Dcreate2(parent, name.c_str(), native_type<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose, name);
      if (rows.total == 0) return;
      if (rows.mine > 0) {
        checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr), name);
      } else {
        checked(H5Sselect_none(space), name);
        checked(H5Sselect_none(piece), name);
      }
      checked(H5Dwrite(data, native_type<T>(), piece, space, transfer_, values.data()), name);
    });
  }

  /// One entry a piece.
  void write_count(hid_t root, const std::string& name, std::size_t count) const {
    const auto value = static_cast<std::int64_t>(count);
    write_dataset(root, name, std::span(&value, 1), 1, pieces_.rows(0, 1), Packing::plain);
  }

  /// Points and offsets are numbered anew in every piece.
  void write_cells(hid_t root) const {
    const auto [n, vtk_type] = shape_of(grid_.kind);
    const std::size_t points = grid_.points.size() / 3, cells = cells_of(grid_);
    write_count(root, "NumberOfPoints", points);
    write_count(root, "NumberOfCells", cells);
    write_count(root, "NumberOfConnectivityIds", points);
    write_dataset(root, "Points", grid_.points, 3, pieces_.rows(n, 0), Packing::plain);

    std::vector<std::int64_t> numbers(points);
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    write_dataset(root, "Connectivity", std::span<const std::int64_t>(numbers), 1, pieces_.rows(n, 0), Packing::deflated);
    numbers.resize(cells + 1);
    for (std::size_t c = 0; c <= cells; ++c) numbers[c] = static_cast<std::int64_t>(n * c);
    write_dataset(root, "Offsets", std::span<const std::int64_t>(numbers), 1, pieces_.rows(1, 1), Packing::deflated);
    const std::vector<std::uint8_t> types(cells, vtk_type);
    write_dataset(root, "Types", std::span(types), 1, pieces_.rows(1, 0), Packing::deflated);
  }

  void write_cell_arrays(hid_t root) const {
    const Handle group = make_group(root, "CellData");
    std::vector<float> floats;
    for (const CellArray& array : grid_.arrays) {
      std::visit(
          [&](auto values) {
            if constexpr (std::is_same_v<decltype(values), std::span<const double>>) {
              floats.resize(values.size());
              std::transform(values.begin(), values.end(), floats.begin(), [](double v) { return static_cast<float>(v); });
              write_dataset(group, array.name, std::span<const float>(floats), array.components, pieces_.rows(1, 0), Packing::plain);
            } else {
              write_dataset(group, array.name, values, array.components, pieces_.rows(1, 0), Packing::deflated);
            }
          },
          array.values);
    }
  }

  const GridView& grid_;
  const Pieces& pieces_;
  Run run_;
  Handle transfer_;
};

void check_sizes(const GridView& grid) {
  const std::size_t cells = cells_of(grid);
  DEMAND(grid.points.size() == 3 * cells * shape_of(grid.kind).points_per_cell, "points " + std::to_string(grid.points.size()));
  for (const CellArray& array : grid.arrays) {
    const std::size_t size = std::visit([](auto values) { return values.size(); }, array.values);
    DEMAND(size == cells * static_cast<std::size_t>(array.components),
           array.name + " has " + std::to_string(size) + " values for " + std::to_string(cells) + " cells");
  }
}

/// An upper bound of the size of the file that all ranks write together.
hsize_t size_bound(const GridView& grid, const Pieces& pieces) {
  hsize_t a_cell = shape_of(grid.kind).points_per_cell * (3 * sizeof(double) + sizeof(std::int64_t)) + sizeof(std::int64_t) + 1;
  for (const CellArray& array : grid.arrays) a_cell += static_cast<hsize_t>(array.components) * sizeof(std::int64_t);
  return kMetadata + pieces.rows(a_cell, 4 * sizeof(std::int64_t)).total;
}

/// Takes the space on the disk beforehand: HDF5 cannot close, and so crashes at its end over, a file for which there is none.
/// @param flags  O_TRUNC or 0
void reserve(const std::filesystem::path& path, const std::filesystem::path& file, hsize_t size, int flags) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0666);
  int error = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, static_cast<off_t>(size));
  if (descriptor >= 0) ::close(descriptor);
  if (error != 0 && error != EOPNOTSUPP && error != EINVAL) throw output_error(file, "cannot write this file", error);
}

}  // namespace

std::vector<std::byte> vtkhdf_image(const GridView& grid) try {
  const QuietHdf5 quiet;
  check_sizes(grid);
  // In memory, so that every write to the disk is our own: HDF5 does not give up a file that it cannot write.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  checked(H5Pset_fapl_core(access, kImageGrowth, 0), "file access");
  const Handle file(H5Fcreate("frame", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "file");
  const Pieces pieces({}, cells_of(grid));
  GridWriter(grid, pieces, [](const std::function<void()>& work) { work(); }).write(file);
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = checked(H5Fget_file_image(file, nullptr, 0), "image");
  std::vector<std::byte> image(static_cast<std::size_t>(size));
  checked(H5Fget_file_image(file, image.data(), image.size()), "image");
  return image;
} catch (const Hdf5Failure& failure) {
  throw output_error("HDF5", "cannot build a frame in memory: " + failure.what);
}

void write_vtkhdf_temporary(const std::filesystem::path& path, const GridView& grid, const Communicator& communicator) {
  const QuietHdf5 quiet;
  const std::filesystem::path temporary = temporary_of(path);
  const auto run = [&](const std::function<void()>& work) {
    communicator.agree([&] {
      try {
        work();
      } catch (const Hdf5Failure& failure) {
        throw output_error(path, "cannot write this file: HDF5 failed at " + failure.what);
      }
    });
  };
  run([&] { check_sizes(grid); });
  const Pieces pieces(communicator, cells_of(grid));
  const hsize_t size = size_bound(grid, pieces);
  run([&] {  // while HDF5 knows nothing of it, as the file may not even be creatable
    if (communicator.is_root()) reserve(temporary, path, size, O_TRUNC);
  });
  std::optional<Handle> access, file;
  run([&] {
    access.emplace(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
    checked(H5Pset_fapl_mpio(*access, communicator.handle()->comm, MPI_INFO_NULL), "file access");
    file.emplace(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, *access), H5Fclose, "create");
  });
  run([&] {  // creation has emptied it
    if (communicator.is_root()) reserve(temporary, path, size, 0);
  });
  GridWriter(grid, pieces, run).write(*file);
  run([&] { checked(H5Fflush(*file, H5F_SCOPE_GLOBAL), "flush"); });
  run([&] { file->close_now(); });
}

}  // namespace breccia
