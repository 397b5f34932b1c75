#pragma once

#include <string>

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

}  // namespace breccia
