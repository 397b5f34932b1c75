#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Pieces of an HTML page. Text that comes from a run goes through escaped(); everything below that takes `text` does
/// so itself, what takes `html` is written as it is.
namespace breccia::report {

/// Text without a meaning in HTML, in elements and in quoted attributes; bytes that are no UTF-8 and control
/// characters become U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// Exponent in raised digits: "⁻⁶".
[[nodiscard]] std::string raised(int exponent);

/// Three digits with a prefix, as quantity_text (base/quantity_text.hpp): "12.3 µs", "1,240 mm²", "50 g"; pure
/// numbers as "0.904", "1,138" or "2.05 × 10⁻⁵". @param unit  SI; m2, m3 and kg get units of their own size
[[nodiscard]] std::string quantity(double value, std::string_view unit);

/// RFC 4648.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// One cell of a table.
struct Cell {
  std::string html;
  bool number = false;  ///< stands at the right

  [[nodiscard]] static Cell text(std::string_view text) { return {escaped(text)}; }
  [[nodiscard]] static Cell raw(std::string html) { return {std::move(html)}; }
  /// Shown with three digits and a prefix; the element's data-value has all digits.
  [[nodiscard]] static Cell number_of(double value, std::string_view unit);
  [[nodiscard]] static Cell count(double value);
  [[nodiscard]] static Cell id(double value);  ///< a whole number that is a name
};

struct Table {
  std::string caption;
  std::vector<std::string> heads;
  std::vector<std::vector<Cell>> rows;

  /// Cells of a row beyond the first are data of what the first one names.
  [[nodiscard]] std::string html() const;
};

/// A section with its heading; nothing for an empty body. @param id  of the anchor, a word
[[nodiscard]] std::string section(std::string_view id, std::string_view title, const std::string& html);
[[nodiscard]] std::string paragraph(std::string_view text);
/// Figures or tables beside each other where there is room; nothing for nothing.
[[nodiscard]] std::string pair(const std::string& html);
[[nodiscard]] std::string tables(const std::string& html);
[[nodiscard]] std::string figure(const std::string& html, std::string_view caption);

}  // namespace breccia::report
