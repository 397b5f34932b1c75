#include "report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/number_text.hpp"
#include "base/quantity_text.hpp"

namespace breccia::report {
namespace {

/// Bytes of the UTF-8 character at the start of `text`; 0: there is none.
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xc2 && first < 0xe0 ? 2 : (first & 0xf0) == 0xe0 ? 3 : 4;
  if (first >= 0x80 && (first < 0xc2 || first > 0xf4)) return 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if (first == 0xe0 && byte(1) < 0xa0) return 0;   // could be written shorter
  if (first == 0xed && byte(1) >= 0xa0) return 0;  // half of a pair of UTF-16
  if (first == 0xf0 && byte(1) < 0x90) return 0;   // could be written shorter
  if (first == 0xf4 && byte(1) >= 0x90) return 0;  // beyond the last character
  return length;
}

std::string_view entity(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

bool is_control(char c) {
  const auto u = static_cast<unsigned char>(c);
  return (u < 0x20 && c != '\n' && c != '\t') || u == 0x7f;
}

/// Three digits; thousands are grouped, what is very large or small has a power of ten.
std::string plain_number(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 999.5 && size < 999999.5) return count_text(std::llround(rounded(value, 3)));
  if (size >= 0.000995 && size < 999.5) return fmt::format("{:.3g}", value);
  const std::string text = fmt::format("{:.2e}", value);
  const std::size_t e = text.find('e');
  return text.substr(0, e) + " × 10" + raised(std::stoi(text.substr(e + 1)));
}

/// Units whose prefixes are not those of a plain unit: a prefix of m2 is squared, kg has one already.
struct Scaled {
  std::string_view si;
  double from;    ///< values of at least this size
  double factor;  ///< of the unit, SI
  const char* unit;
};
constexpr std::array<Scaled, 9> kScaled{{{"m2", 1e-2, 1, "m²"},
                                         {"m2", 1e-9, 1e-6, "mm²"},
                                         {"m2", 0, 1e-12, "µm²"},
                                         {"m3", 1e-3, 1, "m³"},
                                         {"m3", 1e-13, 1e-9, "mm³"},
                                         {"m3", 0, 1e-18, "µm³"},
                                         {"kg", 1, 1, "kg"},
                                         {"kg", 1e-3, 1e-3, "g"},
                                         {"kg", 0, 1e-6, "mg"}}};

const Scaled* scale_of(double value, std::string_view unit) {
  for (const Scaled& scale : kScaled) {
    if (scale.si == unit && (std::abs(value) >= scale.from || value == 0)) return &scale;
  }
  return nullptr;
}

std::string with_prefix(double value, std::string_view unit) {
  std::string text = quantity_text(value, unit);
  const std::size_t space = text.find(' ');
  const bool micro = space != std::string::npos && text.compare(space + 1, 1, "u") == 0 &&
                     text.compare(space + 1, std::string::npos, unit) != 0;
  if (micro) text.replace(space + 1, 1, "µ");
  return text;
}

}  // namespace

std::string raised(int exponent) {
  constexpr std::array<const char*, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kRaised[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const std::string_view as_entity = entity(text.front());
    if (length == 0 || is_control(text.front()))
      out += "\xef\xbf\xbd";
    else if (!as_entity.empty())
      out += as_entity;
    else
      out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string quantity(double value, std::string_view unit) {
  if (!std::isfinite(value)) return "–";
  std::string text;
  if (unit.empty())
    text = plain_number(value);
  else if (const Scaled* scale = scale_of(value, unit); scale != nullptr)
    text = plain_number(value / scale->factor) + " " + scale->unit;
  else
    text = with_prefix(value, unit);
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < left ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Cell Cell::number_of(double value, std::string_view unit) {
  if (!std::isfinite(value)) return {"–", true};
  return {fmt::format("<data value=\"{:.17g}\">{}</data>", value, escaped(quantity(value, unit))), true};
}

Cell Cell::count(double value) {
  if (!std::isfinite(value)) return {"–", true};
  const auto whole = static_cast<std::int64_t>(std::llround(value));
  return {fmt::format("<data value=\"{}\">{}</data>", whole, count_text(whole)), true};
}

Cell Cell::id(double value) { return {std::isfinite(value) ? fmt::format("{:.0f}", value) : "–", true}; }

std::string Table::html() const {
  if (rows.empty()) return {};
  std::string text = "<div class=\"scroll\"><table>\n";
  if (!caption.empty()) text += "<caption>" + escaped(caption) + "</caption>\n";
  if (!heads.empty()) {
    text += "<thead><tr>";
    for (std::size_t i = 0; i < heads.size(); ++i) {
      const bool number = i < rows.front().size() && rows.front()[i].number;
      text += fmt::format("<th scope=\"col\"{}>{}</th>", number ? " class=\"n\"" : "", escaped(heads[i]));
    }
    text += "</tr></thead>\n";
  }
  text += "<tbody>\n";
  for (const std::vector<Cell>& row : rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const char* right = row[i].number ? " class=\"n\"" : "";
      text += i == 0 ? fmt::format("<th scope=\"row\"{}>{}</th>", right, row[i].html)
                     : fmt::format("<td{}>{}</td>", right, row[i].html);
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string section(std::string_view id, std::string_view title, const std::string& html) {
  if (html.empty()) return {};
  return fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-h\">\n<h2 id=\"{0}-h\">{1}</h2>\n{2}</section>\n", id,
                     escaped(title), html);
}

std::string paragraph(std::string_view text) { return "<p>" + escaped(text) + "</p>\n"; }

std::string pair(const std::string& html) { return html.empty() ? html : "<div class=\"pair\">\n" + html + "</div>\n"; }

std::string tables(const std::string& html) {
  return html.empty() ? html : "<div class=\"tables\">\n" + html + "</div>\n";
}

std::string figure(const std::string& html, std::string_view caption) {
  return "<figure>\n" + html + "<figcaption>" + escaped(caption) + "</figcaption>\n</figure>\n";
}

}  // namespace breccia::report
