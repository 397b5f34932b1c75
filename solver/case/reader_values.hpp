#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time_function.hpp"
#include "base/types.hpp"
#include "case/case.hpp"
#include "case/point_file.hpp"
#include "case/reader_toml.hpp"
#include "case/schema.hpp"

namespace breccia::case_ {

/// "path[i]", the key of an item in messages.
[[nodiscard]] std::string indexed(const std::string& path, std::size_t i);

/// Converts nodes of a case file to typed SI values by their row of the schema: type, unit, choices, range. A failed
/// read appends its problems and leaves its output unchanged. `path` is the key in messages.
class ValueReader {
 public:
  ValueReader(std::vector<Problem>& problems, std::filesystem::path folder)
      : problems_(problems), folder_(std::move(folder)) {}

  void read(const Key& key, const Node& node, const std::string& path, double& out);
  void read(const Key& key, const Node& node, const std::string& path, int& out);
  void read(const Key& key, const Node& node, const std::string& path, std::int64_t& out);
  void read(const Key& key, const Node& node, const std::string& path, std::uint64_t& out);
  void read(const Key& key, const Node& node, const std::string& path, bool& out);
  void read(const Key& key, const Node& node, const std::string& path, std::string& out);
  /// A relative name is taken from the folder given.
  void read(const Key& key, const Node& node, const std::string& path, std::filesystem::path& out);
  void read(const Key& key, const Node& node, const std::string& path, std::vector<std::string>& out);
  void read(const Key& key, const Node& node, const std::string& path, std::array<std::string, 2>& out);
  void read(const Key& key, const Node& node, const std::string& path, std::array<double, 2>& out);
  void read(const Key& key, const Node& node, const std::string& path, Vec3& out);
  void read(const Key& key, const Node& node, const std::string& path, std::array<int, 3>& out);
  void read(const Key& key, const Node& node, const std::string& path, FileColumn& out);
  /// Which numbers have a unit of length, area or volume is recorded for lengths_in().
  void read(const Key& key, const Node& node, const std::string& path, std::map<std::string, double>& out);
  void read(const Key& key, const Node& node, const std::string& path, std::map<std::string, Setting>& out);
  void read(const Key& key, const Node& node, const std::string& path, TimeFunction& out);
  void read(const Key& key, const Node& node, const std::string& path, std::array<TimeFunction, 3>& out);
  /// Letters of "xyz".
  void read(const Key& key, const Node& node, const std::string& path, std::array<bool, 3>& axes);
  /// Functions of time by axis; axes not named are left alone.
  void read_axes(const Key& key, const Node& node, const std::string& path, std::array<bool, 3>& axes,
                 std::array<TimeFunction, 3>& out);
  /// Position of the word among the choices of the key.
  [[nodiscard]] std::optional<std::size_t> read_choice(const Key& key, const Node& node, const std::string& path);

  /// Numbers of a table that have a unit of length (1), area (2), volume (3)...
  [[nodiscard]] const std::map<std::string, int>& lengths_in(const std::string& path) { return lengths_[path]; }

  /// Files from which functions of time were read, each function once.
  [[nodiscard]] const DataFiles& data_files() const { return data_; }

  /// An entry of a table that is no key of it; names the nearest key of the schema.
  void unknown_key(const Node& node, const std::string& path, const std::string& pattern);
  void missing_key(const Key& key, const Node& table, const std::string& path);
  void problem(const Node& node, const std::string& path, const std::string& what, const std::string& allowed,
               const std::string& given);

 private:
  void wrong_type(const Key& key, const Node& node, const std::string& path);
  bool number(const Key& key, const Node& node, const std::string& path, double& out);
  bool whole(const Key& key, const Node& node, const std::string& path, std::int64_t& out);
  template <class T, std::size_t N>
  void read_list(const Key& key, const Node& node, const std::string& path, bool one_for_all, std::array<T, N>& out);

  // Of functions of time (reader_functions.cpp).
  double function_part(const Key& key, const Node& table, const std::string& path, std::string_view row);
  std::vector<const Node*> function_tables(const Node& node, const std::string& path, std::string_view row);
  void function_table(const Key& key, const Node& table, const std::string& path, TimeFunction& out);
  std::vector<TimeFunction::Point> function_points(const Key& key, const Node& node, const std::string& path);
  std::vector<TimeFunction::Point> function_ramp(const Key& key, const Node& node, const std::string& path);
  std::vector<TimeFunction::Point> function_csv(const Key& key, const Node& node, const std::string& path);
  /// A row of <function> keys below a table, or its default. @return  whether it was read
  template <class T>
  bool function_row(const Key& row, const Node& table, const std::string& path, T& out);

  std::vector<Problem>& problems_;
  std::filesystem::path folder_;
  DataFiles data_;
  std::size_t num_points_ = 0;                                 ///< of data files, in all functions
  std::map<std::string, std::map<std::string, int>> lengths_;  ///< by the path of their table
};

}  // namespace breccia::case_
