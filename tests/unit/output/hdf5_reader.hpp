#pragma once

#include <hdf5.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace breccia::test {

/// Reads a frame file with the HDF5 library's own conversions: knows nothing of how it was written.
class Hdf5Reader {
 public:
  /// Throws std::runtime_error when the file is not readable.
  explicit Hdf5Reader(const std::filesystem::path& path, std::string root = "VTKHDF")
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), root_(std::move(root)) {
    if (file_ < 0) throw std::runtime_error("not a readable HDF5 file: " + path.string());
  }
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader() { H5Fclose(file_); }

  struct Data {
    std::vector<hsize_t> shape;
    std::vector<double> values;
    std::size_t bytes = 0;  ///< of one stored number
  };

  /// The dataset /<root>/<name>, whatever its type, as doubles. Throws std::runtime_error when it cannot be read.
  [[nodiscard]] Data data(const std::string& name) const {
    const hid_t set = H5Dopen2(file_, ("/" + root_ + "/" + name).c_str(), H5P_DEFAULT);
    if (set < 0) throw std::runtime_error("no dataset " + name);
    const hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    Data data;
    data.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, data.shape.data(), nullptr);
    data.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    data.bytes = H5Tget_size(type);
    const herr_t read =
        data.values.empty() ? 0 : H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data());
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(set);
    if (read < 0) throw std::runtime_error("cannot read " + name);
    return data;
  }
  [[nodiscard]] std::vector<double> values(const std::string& name) const { return data(name).values; }

  /// Attribute Type of /VTKHDF.
  [[nodiscard]] std::string type() const {
    const hid_t attribute = H5Aopen_by_name(file_, "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) throw std::runtime_error("no attribute Type");
    const hid_t kind = H5Aget_type(attribute);
    std::string text(H5Tget_size(kind), ' ');
    H5Aread(attribute, kind, text.data());
    H5Tclose(kind);
    H5Aclose(attribute);
    return text;
  }

 private:
  hid_t file_;
  std::string root_;
};

}  // namespace breccia::test
