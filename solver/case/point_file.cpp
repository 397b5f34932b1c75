#include "case/point_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "case/nearest.hpp"
#include "case/units.hpp"

namespace breccia::case_ {
namespace {

namespace fs = std::filesystem;

constexpr const char* kForms = "numbers with decimal points, columns apart by semicolons, tabs, commas or blanks";

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Of a cell in quotes what stands between them.
std::string_view unquoted(std::string_view cell) {
  cell = without_blanks(cell);
  const bool quoted = cell.size() >= 2 && (cell.front() == '"' || cell.front() == '\'') && cell.back() == cell.front();
  return quoted ? without_blanks(cell.substr(1, cell.size() - 2)) : cell;
}

/// A place outside quotes at which one of the signs stands; npos: none.
std::size_t find_outside_quotes(std::string_view line, std::string_view signs) {
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') inside = !inside;
    if (!inside && signs.find(line[i]) != std::string_view::npos) return i;
  }
  return std::string_view::npos;
}

/// @param separator  ' ': blanks
std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  const std::string_view signs = separator == ' ' ? " \t" : std::string_view(&separator, 1);
  while (true) {
    if (separator == ' ') line = without_blanks(line);
    const std::size_t end = std::min(find_outside_quotes(line, signs), line.size());
    const std::string_view cell = line.substr(0, end);
    // "force (kN)" between blanks is one cell
    const bool is_unit = separator == ' ' && !cells.empty() && (cell.starts_with('[') || cell.starts_with('('));
    if (is_unit)
      cells.back() = {cells.back().data(), static_cast<std::size_t>(cell.data() + cell.size() - cells.back().data())};
    else
      cells.push_back(unquoted(cell));
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
  }
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

enum class NumberKind { number, not_finite, none };

NumberKind number_in(std::string_view cell, double& value) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc::invalid_argument || end != cell.data() + cell.size()) return NumberKind::none;
  if (error == std::errc::result_out_of_range) {  // also of what is too small
    const std::size_t exponent = cell.find_first_of("eE");
    const bool small = exponent != std::string_view::npos && cell.substr(exponent + 1).starts_with('-');
    value = 0;
    return small ? NumberKind::number : NumberKind::not_finite;
  }
  if (std::abs(value) < smallest_magnitude) value = 0;
  return std::isfinite(value) ? NumberKind::number : NumberKind::not_finite;
}

/// "1,5": a comma between digits and nothing else beside them.
bool has_decimal_comma(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos || cell.find(',', comma + 1) != std::string_view::npos) return false;
  std::string text(cell);
  text[comma] = '.';
  double value = 0;
  return number_in(text, value) != NumberKind::none;
}

/// A cell of a header: its name and what stands in brackets behind it.
struct HeaderCell {
  std::string_view name, unit;
};
HeaderCell header_cell(std::string_view cell) {
  const std::size_t open = cell.find_last_of("[(");
  const bool closed = open != std::string_view::npos && (cell.back() == ']' || cell.back() == ')');
  if (!closed) return {cell, {}};
  return {without_blanks(cell.substr(0, open)), without_blanks(cell.substr(open + 1, cell.size() - open - 2))};
}

/// A column as it is read.
struct Column {
  std::size_t place = 0;
  std::string unit;  ///< empty: SI
  std::string words;
};

class Reader {
 public:
  explicit Reader(const PointFile& source) : source_(source) {}

  std::vector<TimeFunction::Point> read() {
    read_text();
    std::string_view rest = text_;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      ++line_;
      take_line(rest.substr(0, end));
      const bool both = rest.substr(end).starts_with("\r\n");
      rest.remove_prefix(std::min(rest.size(), end + (both ? 2 : 1)));
    }
    line_ = 0;
    if (points_.empty()) refuse("has no line of numbers", kForms);
    return std::move(points_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed, std::string_view given = {}) const {
    constexpr std::size_t kShown = 60;
    throw InputError(Problem{source_.file.string(), line_, "", what, allowed, std::string(given.substr(0, kShown))});
  }

  void read_text() {
    std::error_code error;
    const fs::file_status status = fs::status(source_.file, error);
    if (!fs::exists(status)) refuse("the file does not exist", "a text file of columns");
    if (fs::is_directory(status)) refuse("is a folder", "a text file of columns");
    if (!fs::is_regular_file(status)) refuse("is no ordinary file", "a text file of columns");
    std::ifstream in(source_.file, std::ios::binary);
    std::array<char, 1U << 16U> piece{};
    while (in.read(piece.data(), piece.size()), in.gcount() > 0) {
      text_.append(piece.data(), static_cast<std::size_t>(in.gcount()));
      if (text_.size() > kMostPointFileBytes)
        refuse("is too large", "at most " + std::to_string(kMostPointFileBytes >> 20U) + " MiB");
    }
    if (!in.eof()) refuse("cannot be read", "a file that you may read");
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
      refuse("is UTF-16 text", "plain text or UTF-8, in spreadsheets \"CSV UTF-8\"");
    if (text_.find('\0') != std::string::npos) refuse("is no text: it holds characters 0", "a text file of columns");
    if (text_.starts_with("\xef\xbb\xbf")) text_.erase(0, 3);
  }

  void take_line(std::string_view line) {
    const std::string_view content = without_blanks(line);
    if (content.empty() || content.starts_with('#') || content.starts_with('%') || content.starts_with('!')) return;
    if (separator_ == 0 && content.starts_with("sep=") && content.size() == 5) {
      separator_ = content[4];
      return;
    }
    if (separator_ == 0) {
      const auto has = [&](char sign) { return find_outside_quotes(content, {&sign, 1}) != std::string_view::npos; };
      separator_ = has(';') ? ';' : has('\t') ? '\t' : has(',') ? ',' : ' ';
    }
    const std::vector<std::string_view> cells = cells_of(content, separator_);
    if (num_columns_ == 0) {
      first_line_ = line_;
      num_columns_ = cells_of(content, separator_).size();
      if (take_header(cells)) return;
    }
    if (cells.size() > num_columns_)
      refuse("has " + std::to_string(cells.size()) + " columns, line " + std::to_string(first_line_) + " has " +
                 std::to_string(num_columns_),
             kForms, content);
    take_point(cells, content);
  }

  [[nodiscard]] bool is_number(const std::vector<std::string_view>& cells, const FileColumn& column) const {
    double value = 0;
    const auto place = static_cast<std::size_t>(column.number - 1);
    return place < cells.size() &&
           (number_in(cells[place], value) != NumberKind::none || has_decimal_comma(cells[place]));
  }

  /// Whether the first line is a header; finds the columns.
  bool take_header(const std::vector<std::string_view>& cells) {
    const bool named = !source_.time.name.empty() || !source_.value.name.empty();
    const bool header = named || (!is_number(cells, source_.time) && !is_number(cells, source_.value));
    time_ = column_of(source_.time, cells, header, "s");
    value_ = column_of(source_.value, cells, header, source_.si_unit);
    return header;
  }

  Column column_of(const FileColumn& asked, const std::vector<std::string_view>& cells, bool header,
                   const std::string& si_unit) const {
    Column column;
    column.place = static_cast<std::size_t>(asked.number - 1);
    if (!asked.name.empty()) column.place = place_of(asked.name, cells);
    if (column.place >= cells.size())
      refuse("has no column " + std::to_string(column.place + 1), "columns 1 to " + std::to_string(cells.size()));
    column.words = "column " + (asked.name.empty() ? std::to_string(asked.number) : "\"" + asked.name + "\"");
    const std::string stated(header ? header_cell(cells[column.place]).unit : std::string_view());
    column.unit = asked.unit.empty() ? stated : asked.unit;
    if (!stated.empty() && !asked.unit.empty() && differ(stated, asked.unit))
      refuse("the header states another unit of " + column.words + " than the case", "\"" + stated + "\", or no unit",
             asked.unit);
    check_unit(column, si_unit);
    return column;
  }

  [[nodiscard]] std::size_t place_of(const std::string& name, const std::vector<std::string_view>& cells) const {
    std::vector<std::string> names;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      names.emplace_back(header_cell(cells[i]).name);
      if (cells[i] != name && names.back() != name) continue;
      if (found) refuse("has two columns of one name", "column numbers, from 1", name);
      found = i;
    }
    if (!found) refuse("has no column of that name in its first line", nearest_words(name, names), name);
    return *found;
  }

  /// True for units that are both known and not the same.
  static bool differ(const std::string& a, const std::string& b) {
    try {
      return parse_quantity("1 " + a).value != parse_quantity("1 " + b).value;
    } catch (const UnitError&) {
      return false;  // the header is free if the case has the unit
    }
  }

  void check_unit(const Column& column, const std::string& si_unit) const {
    if (column.unit.empty()) return;
    try {
      (void)to_si("1 " + column.unit, si_unit);
    } catch (const UnitError& e) {
      refuse("the unit of " + column.words + " " + e.what(), e.allowed, column.unit);
    }
  }

  [[nodiscard]] double number(const Column& column, const std::string& si_unit,
                              const std::vector<std::string_view>& cells, std::string_view line) const {
    if (column.place >= cells.size()) refuse("has no " + column.words, kForms, line);
    const std::string_view cell = cells[column.place];
    double value = 0;
    const NumberKind kind = number_in(cell, value);
    if (kind == NumberKind::not_finite) refuse(column.words + " is not finite", "finite numbers", cell);
    if (kind == NumberKind::none && has_decimal_comma(cell))
      refuse(column.words + " has a decimal comma", "decimal points: 1.5", cell);
    if (kind == NumberKind::none) refuse(column.words + " is no number", kForms, cell);
    if (column.unit.empty() || value == 0) return value;
    try {  // from the digits, as a number with its unit in the case
      return to_si(std::string(cell) + " " + column.unit, si_unit);
    } catch (const UnitError& e) {
      refuse(column.words + " " + e.what(), e.allowed, cell);
    }
  }

  void take_point(const std::vector<std::string_view>& cells, std::string_view line) {
    const double time = number(time_, "s", cells, line) + source_.start;
    const double value = number(value_, source_.si_unit, cells, line) * source_.scale;
    if (!std::isfinite(time) || !std::isfinite(value)) refuse("is not finite with start and scale", "finite numbers");
    if (!points_.empty() && !(time > points_.back().time))
      refuse("is not later than the line before", "times increasing, numbers with decimal points", line);
    if (points_.size() == kMostPoints) refuse("the file has too many lines", "at most " + std::to_string(kMostPoints));
    points_.push_back({time, std::abs(value) < smallest_magnitude ? 0.0 : value});
  }

  const PointFile& source_;
  std::string text_;
  int line_ = 0, first_line_ = 0;
  char separator_ = 0;
  std::size_t num_columns_ = 0;
  Column time_, value_;
  std::vector<TimeFunction::Point> points_;
};

}  // namespace

std::vector<TimeFunction::Point> read_points(const PointFile& source) { return Reader(source).read(); }

}  // namespace breccia::case_
