#include "output/frames/hdf5_file.hpp"

#include <hdf5.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <utility>

namespace breccia {
namespace {

// Chunks of this many rows: large enough that the chunk index costs nothing, small enough to stay in the cache while
// it is shuffled and deflated.
constexpr hsize_t kChunkRows = 16384;
constexpr unsigned kDeflateLevel = 1;
constexpr std::size_t kImageGrowth = std::size_t{4} << 20;  // bytes by which the file in memory grows
// Bytes, more than the structure of a file takes, and that of a dataset.
constexpr hsize_t kMetadata = hsize_t{1} << 16, kMetadataOfDataset = 2048;

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
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  void close_now() { checked(close_(std::exchange(id_, -1)), "close"); }

 private:
  hid_t id_;
  Close close_;
};

/// HDF5 prints its error stack by default; the exception has the message.
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

hid_t native(NumberType type) {
  switch (type) {
    case NumberType::float64:
      return H5T_NATIVE_DOUBLE;
    case NumberType::float32:
      return H5T_NATIVE_FLOAT;
    case NumberType::int64:
      return H5T_NATIVE_INT64;
    case NumberType::int32:
      return H5T_NATIVE_INT32;
    case NumberType::int8:
      return H5T_NATIVE_INT8;
    case NumberType::uint8:
      break;
  }
  return H5T_NATIVE_UINT8;
}

Handle make_group(hid_t parent, const char* name) {
  return Handle(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
}

void write_text_attribute(hid_t object, const char* name, const std::string& value) {
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose, name);
  checked(H5Tset_size(text, value.size()), name);
  checked(H5Tset_strpad(text, H5T_STR_NULLPAD), name);
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(H5Acreate2(object, name, text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  checked(H5Awrite(attribute, text, value.data()), name);
}

/// Attributes Version = (1, 0) and Type, by which a reader knows the format.
void write_format_attributes(hid_t root, const std::string& type) {
  const std::array<std::int64_t, 2> version{1, 0};
  const hsize_t length = version.size();
  const Handle version_space(H5Screate_simple(1, &length, nullptr), H5Sclose, "Version");
  const Handle version_attribute(H5Acreate2(root, "Version", H5T_NATIVE_INT64, version_space, H5P_DEFAULT, H5P_DEFAULT),
                                 H5Aclose, "Version");
  checked(H5Awrite(version_attribute, H5T_NATIVE_INT64, version.data()), "Version");
  write_text_attribute(root, "Type", type);
}

void deflate(hid_t creation, const Column& column, int dimensions) {
  const std::array<hsize_t, 2> chunk{std::min<hsize_t>(column.rows.total, kChunkRows),
                                     static_cast<hsize_t>(column.components)};
  checked(H5Pset_chunk(creation, dimensions, chunk.data()), column.name);
  checked(H5Pset_shuffle(creation), column.name);
  checked(H5Pset_deflate(creation, kDeflateLevel), column.name);
}

enum class Storage { deflated, reserved };  ///< the latter: plain, its place taken at once

Handle make_dataset(hid_t parent, const Column& column, Storage storage) {
  const int dimensions = column.components == 1 ? 1 : 2;
  const std::array<hsize_t, 2> shape{column.rows.total, static_cast<hsize_t>(column.components)};
  const Handle space(H5Screate_simple(dimensions, shape.data(), nullptr), H5Sclose, column.name);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, column.name);
  checked(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), column.name);
  if (storage == Storage::reserved) checked(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY), column.name);
  if (storage == Storage::deflated && column.deflates && column.rows.total > 0) deflate(creation, column, dimensions);
  Handle data(H5Dcreate2(parent, column.name.c_str(), native(column.type), space, H5P_DEFAULT, creation, H5P_DEFAULT),
              H5Dclose, column.name);
  if (!column.unit.empty()) write_text_attribute(data, "unit", column.unit);
  return data;
}

/// Makes groups and datasets. @param use  is called with each dataset and its column
template <class Use>
void make_tree(hid_t file, std::span<const Column> columns, const Hdf5Format& format, Storage storage, Use&& use) {
  const Handle root = make_group(file, format.root.c_str());
  write_format_attributes(root, format.type);
  std::map<std::string, Handle> groups;
  for (const std::string& name : format.groups) groups.emplace(name, make_group(root, name.c_str()));
  for (const Column& column : columns) {
    const hid_t parent = column.group.empty() ? root : groups.at(column.group);
    use(make_dataset(parent, column, storage), column);
  }
}

/// A file without a name that takes memory only where something has been written.
class SparseMemory {
 public:
  /// @param size  largest size, bytes; throws if it exceeds the limit of file sizes
  explicit SparseMemory(hsize_t size) : descriptor_(::memfd_create("frame", MFD_CLOEXEC)) {
    if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0) return;
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Hdf5Failure{"memory for the structure of the file", error};
  }
  SparseMemory(const SparseMemory&) = delete;
  SparseMemory& operator=(const SparseMemory&) = delete;
  ~SparseMemory() { ::close(descriptor_); }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  [[nodiscard]] hsize_t size() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) throw Hdf5Failure{"size", errno};
    return static_cast<hsize_t>(status.st_size);
  }
  [[nodiscard]] Hdf5Skeleton::Part part(hsize_t begin, hsize_t end) const {
    Hdf5Skeleton::Part part{begin, std::vector<std::byte>(end - begin)};
    const ssize_t got = ::pread(descriptor_, part.bytes.data(), part.bytes.size(), static_cast<off_t>(begin));
    if (got != static_cast<ssize_t>(part.bytes.size())) throw Hdf5Failure{"structure", got < 0 ? errno : 0};
    return part;
  }

 private:
  int descriptor_;
};

hsize_t size_of_values(const Column& column) { return column.rows.total * column.row_size(); }

/// What lies between the values of all columns.
std::vector<Hdf5Skeleton::Part> structure_of(const SparseMemory& memory, std::span<const Column> columns,
                                             std::span<const std::uint64_t> offsets) {
  std::vector<std::pair<hsize_t, hsize_t>> values;  // begin and end
  for (std::size_t i = 0; i < columns.size(); ++i)
    values.emplace_back(offsets[i], offsets[i] + size_of_values(columns[i]));
  values.emplace_back(memory.size(), memory.size());
  std::sort(values.begin(), values.end());
  std::vector<Hdf5Skeleton::Part> parts;
  hsize_t at = 0;
  for (const auto& [begin, end] : values) {
    if (begin > at) parts.push_back(memory.part(at, begin));
    at = std::max(at, end);
  }
  return parts;
}

/// Not locked: each file has one writer and gets its name when it is complete, and a file system may have no locks.
Handle unlocked_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  checked(H5Pset_file_locking(access, false, true), "file access");
  return access;
}

}  // namespace

Hdf5Format vtkhdf_format() { return {"VTKHDF", "UnstructuredGrid", {"CellData", "FieldData"}, 0}; }

std::vector<std::byte> hdf5_image(std::span<const Column> columns) {
  const QuietHdf5 quiet;
  const Handle access = unlocked_access();
  checked(H5Pset_fapl_core(access, kImageGrowth, 0), "file access");
  const Handle file(H5Fcreate("frame", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "file");
  std::vector<std::byte> space;
  make_tree(file, columns, vtkhdf_format(), Storage::deflated, [&](const Handle& data, const Column& column) {
    if (column.rows.total == 0) return;
    checked(H5Dwrite(data, native(column.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, column.bytes(space).data()),
            column.name);
  });
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = checked(H5Fget_file_image(file, nullptr, 0), "image");
  std::vector<std::byte> image(static_cast<std::size_t>(size));
  checked(H5Fget_file_image(file, image.data(), image.size()), "image");
  return image;
}

Hdf5Skeleton hdf5_skeleton(std::span<const Column> columns, const Hdf5Format& format) {
  const QuietHdf5 quiet;
  hsize_t bound = format.user_block + kMetadata;
  for (const Column& column : columns) bound += size_of_values(column) + kMetadataOfDataset;
  const SparseMemory memory(bound);
  const Handle access = unlocked_access();
  checked(H5Pset_fapl_stdio(access),
          "file access");  // the one driver that does not resolve the real path, as there is no file
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  checked(H5Pset_userblock(creation, format.user_block), "user block");
  Handle file(H5Fcreate(memory.path().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "file");
  Hdf5Skeleton skeleton;
  make_tree(file, columns, format, Storage::reserved, [&](const Handle& data, const Column& column) {
    const haddr_t offset = column.rows.total == 0 ? 0 : H5Dget_offset(data);
    if (offset == HADDR_UNDEF) throw Hdf5Failure{"place of " + column.name};
    skeleton.offsets.push_back(offset);
  });
  file.close_now();
  skeleton.size = memory.size();
  skeleton.structure = structure_of(memory, columns, skeleton.offsets);
  return skeleton;
}

}  // namespace breccia
