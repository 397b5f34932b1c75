#include "output/vtkhdf_image.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "base/error.hpp"
#include "output/atomic_file.hpp"

namespace breccia {
namespace {

// Chunks of this many rows: large enough that the chunk index costs nothing, small enough to stay in the cache while
// it is shuffled and deflated.
constexpr hsize_t kChunkRows = 16384;
constexpr unsigned kDeflateLevel = 1;
constexpr std::size_t kImageGrowth = std::size_t{4} << 20;  // bytes by which the file in memory grows

/// HDF5 reports a failure by a negative number.
template <class T>
T checked(T result, const char* what) {
  if (result < 0) throw output_error("HDF5", std::string("cannot build a frame in memory: ") + what);
  return result;
}

/// Owns one HDF5 handle.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const char* what) : id_(checked(id, what)), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_(id_); }
  operator hid_t() const { return id_; }

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

enum class Packing { plain, deflated };

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// One dataset of values.size() / components rows; one-dimensional when components is 1.
template <class T>
void write_dataset(hid_t parent, const std::string& name, std::span<const T> values, int components, Packing packing) {
  const hsize_t width = static_cast<hsize_t>(components);
  const std::array<hsize_t, 2> shape{values.size() / width, width};
  const int rank = components == 1 ? 1 : 2;
  const Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose, name.c_str());
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name.c_str());
  if (packing == Packing::deflated && shape[0] > 0) {
    const std::array<hsize_t, 2> chunk{std::min(shape[0], kChunkRows), width};
    checked(H5Pset_chunk(creation, rank, chunk.data()), name.c_str());
    checked(H5Pset_shuffle(creation), name.c_str());
    checked(H5Pset_deflate(creation, kDeflateLevel), name.c_str());
  }
  const Handle data(H5Dcreate2(parent, name.c_str(), native_type<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                    H5Dclose, name.c_str());
  if (values.empty()) return;
  checked(H5Dwrite(data, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name.c_str());
}

template <class T>
void write_single(hid_t parent, const std::string& name, T value) {
  write_dataset<T>(parent, name, std::span<const T>(&value, 1), 1, Packing::plain);
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

void write_cells(hid_t root, const GridView& grid) {
  const auto [n, vtk_type] = shape_of(grid.kind);
  const std::size_t points = grid.points.size() / 3;
  const std::size_t cells = points / n;
  DEMAND(grid.points.size() == 3 * n * cells, "points " + std::to_string(grid.points.size()));
  write_single<std::int64_t>(root, "NumberOfPoints", static_cast<std::int64_t>(points));
  write_single<std::int64_t>(root, "NumberOfCells", static_cast<std::int64_t>(cells));
  write_single<std::int64_t>(root, "NumberOfConnectivityIds", static_cast<std::int64_t>(points));
  write_dataset<double>(root, "Points", grid.points, 3, Packing::plain);

  std::vector<std::int64_t> numbers(points);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  write_dataset<std::int64_t>(root, "Connectivity", numbers, 1, Packing::deflated);
  numbers.resize(cells + 1);
  for (std::size_t c = 0; c <= cells; ++c) numbers[c] = static_cast<std::int64_t>(n * c);
  write_dataset<std::int64_t>(root, "Offsets", numbers, 1, Packing::deflated);
  const std::vector<std::uint8_t> types(cells, vtk_type);
  write_dataset<std::uint8_t>(root, "Types", types, 1, Packing::deflated);
}

void write_cell_arrays(hid_t root, const GridView& grid) {
  const Handle group = make_group(root, "CellData");
  const std::size_t cells = grid.points.size() / 3 / shape_of(grid.kind).points_per_cell;
  std::vector<float> floats;
  for (const CellArray& array : grid.arrays) {
    std::visit(
        [&](auto values) {
          DEMAND(
              values.size() == cells * static_cast<std::size_t>(array.components),
              array.name + " has " + std::to_string(values.size()) + " values for " + std::to_string(cells) + " cells");
          using T = std::remove_const_t<typename decltype(values)::element_type>;
          if constexpr (std::is_same_v<T, double>) {
            floats.resize(values.size());
            std::transform(values.begin(), values.end(), floats.begin(),
                           [](double v) { return static_cast<float>(v); });
            write_dataset<float>(group, array.name, floats, array.components, Packing::plain);
          } else {
            write_dataset<T>(group, array.name, values, array.components, Packing::deflated);
          }
        },
        array.values);
  }
}

}  // namespace

std::vector<std::byte> vtkhdf_image(const GridView& grid) {
  const QuietHdf5 quiet;
  // In memory, so that every write to the disk is our own: HDF5 does not give up a file that it cannot write.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  checked(H5Pset_fapl_core(access, kImageGrowth, 0), "file access");
  const Handle file(H5Fcreate("frame", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "file");
  {
    const Handle root = make_group(file, "VTKHDF");
    write_format_attributes(root);
    write_cells(root, grid);
    write_cell_arrays(root, grid);
    const Handle fields = make_group(root, "FieldData");
    write_single(fields, "time", grid.time);
    write_single(fields, "step", grid.step);
  }
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = checked(H5Fget_file_image(file, nullptr, 0), "image");
  std::vector<std::byte> image(static_cast<std::size_t>(size));
  checked(H5Fget_file_image(file, image.data(), image.size()), "image");
  return image;
}

}  // namespace breccia
