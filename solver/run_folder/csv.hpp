#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "run_folder/lines.hpp"

namespace breccia {

/// A field of a line of CSV (RFC 4180); breaks of lines become spaces, so that a line is a row.
[[nodiscard]] inline std::string csv_field(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += (c == '\r' || c == '\n') ? ' ' : c;
  }
  return text + '"';
}

namespace run_folder {

/// Fields of a line of CSV (RFC 4180): within quotes commas belong to the field, and two quotes are one. Carriage
/// returns are dropped. At least one field.
[[nodiscard]] inline std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && in_quotes && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      in_quotes = !in_quotes;
    } else if (c == ',' && !in_quotes) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

/// The number that a field is as a whole, "nan" and "inf" among them, in any locale; nullopt: it is none.
[[nodiscard]] inline std::optional<double> number_of(std::string_view field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

/// The step with which a row begins, as an integer or as the double that it is, "1e+06"; nullopt: it begins with none.
[[nodiscard]] inline std::optional<std::int64_t> step_of_row(std::string_view row) {
  constexpr double kMost = 9e15;  // doubles count exactly up to 2^53
  const std::optional<double> step = number_of(row.substr(0, row.find_first_of(",\r")));
  if (!step || !(std::abs(*step) <= kMost) || std::floor(*step) != *step) return std::nullopt;
  return static_cast<std::int64_t>(*step);
}

/// The rows of a table, behind its header, that begin with a step before `step`; none where it has another header. A
/// row that begins with no step is dropped, and so is a last one without its line feed.
[[nodiscard]] inline std::string rows_before(std::string_view table, std::string_view header, std::int64_t step) {
  const WholeLines rows = whole_lines(table);
  std::string kept;
  if (rows.lines.empty() || rows.lines.front() != header) return kept;
  for (std::size_t i = 1; i < rows.lines.size(); ++i) {
    const std::optional<std::int64_t> own = step_of_row(rows.lines[i]);
    if (own && *own < step) kept.append(rows.lines[i]) += '\n';
  }
  return kept;
}

}  // namespace run_folder
}  // namespace breccia
