#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "run_folder/csv.hpp"
#include "run_folder/lines.hpp"
#include "system/open_regular.hpp"

namespace breccia::run_folder {

/// What becomes of a field that is no number.
enum class OddFields { leave_out_the_row, read_as_nan };

/// history.csv by columns; a run adds rows until it ends.
struct History {
  std::vector<std::string> names;            ///< as in the file's first line: "kinetic [J]"
  std::vector<std::vector<double>> columns;  ///< as many; equal lengths

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }

  /// Values of the first column of that name; empty when there is none.
  [[nodiscard]] const std::vector<double>& column(std::string_view name) const {
    static const std::vector<double> none;
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? none : columns[static_cast<std::size_t>(found - names.begin())];
  }

  /// Last value of a column; NaN when there is none.
  [[nodiscard]] double last(std::string_view name) const {
    const std::vector<double>& values = column(name);
    return values.empty() ? std::numeric_limits<double>::quiet_NaN() : values.back();
  }

  /// The first line names the columns, each other one is a row. A row with more or fewer fields is left out.
  /// @return  what is wrong with the row; empty: nothing
  std::string add_line(std::string_view line, OddFields odd = OddFields::leave_out_the_row) {
    const std::vector<std::string> fields = fields_of(line);
    if (names.empty()) {
      names = fields;
      columns.resize(names.size());
      return {};
    }
    if (fields.size() != names.size())
      return std::to_string(fields.size()) + " numbers for " + std::to_string(names.size()) + " columns";
    std::vector<double> row;
    row.reserve(fields.size());
    for (const std::string& field : fields) {
      const std::optional<double> value = number_of(field);
      if (!value && odd == OddFields::leave_out_the_row) return "'" + field + "' is no number";
      row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
    return {};
  }
};

/// What a text of history.csv holds.
struct HistoryText {
  History history;                 ///< of its whole rows
  bool is_cut = false;             ///< the last row is still being written, or was cut off; it is left out
  std::size_t num_left_out = 0;    ///< other rows that are left out
  std::size_t first_left_out = 0;  ///< line of the first of them, counted from 1
  std::string problem;             ///< with that line
};

[[nodiscard]] inline HistoryText parse_history(std::string_view text) {
  HistoryText read;
  const WholeLines found = whole_lines(text);
  read.is_cut = found.is_cut;
  for (std::size_t i = 0; i < found.lines.size(); ++i) {
    std::string problem = read.history.add_line(found.lines[i]);
    if (problem.empty() || ++read.num_left_out > 1) continue;
    read.first_left_out = i + 1;
    read.problem = std::move(problem);
  }
  return read;
}

/// The columns of a history and its last whole row, for a file of any length; without columns where it has no whole
/// line, without a row where it has none. Throws nothing but std::bad_alloc.
[[nodiscard]] inline History last_row_of(const std::filesystem::path& file) {
  constexpr std::uint64_t kHeader = 1 << 24, kTail = 1 << 16;  // bytes
  const Opened opened = open_regular(file, O_RDONLY, Depth::file);
  struct stat about {};
  if (!opened || ::fstat(opened.descriptor.get(), &about) != 0) return {};
  const std::string begin = bytes_from(opened.descriptor, 0, kHeader);
  const std::size_t header = begin.find('\n');
  History history;
  if (header == std::string::npos) return history;
  (void)history.add_line(std::string_view(begin).substr(0, header));
  // A row can be longer than the header: each number has up to 25 characters.
  const auto size = static_cast<std::uint64_t>(about.st_size), rest = size - std::min<std::uint64_t>(size, header);
  const std::uint64_t tail = std::min<std::uint64_t>(rest, std::max<std::uint64_t>(kTail, 64 * history.names.size()));
  const std::string bytes = bytes_from(opened.descriptor, size - tail, tail);
  const std::vector<std::string_view> lines = whole_lines(bytes).lines;
  for (std::size_t i = lines.size(); i > 1 && history.rows() == 0; --i) (void)history.add_line(lines[i - 1]);
  return history;
}

}  // namespace breccia::run_folder
