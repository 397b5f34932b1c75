#include "base/printable.hpp"

#include <cstddef>

namespace breccia {

namespace {

/// @param kept  control characters that stay as they are
std::string with_written_controls(std::string_view text, std::string_view kept) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out;
  out.reserve(text.size());
  const auto escape = [&](unsigned char byte) {
    out += "\\x";
    out += kDigits[byte / 16];
    out += kDigits[byte % 16];
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (kept.find(text[i]) != std::string_view::npos) {
      out += text[i];
    } else if (byte == '\n') {
      out += "\\n";
    } else if (byte == '\t') {
      out += "\\t";
    } else if (byte < 0x20 || byte == 0x7f) {
      escape(byte);
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {  // the control characters U+0080 to U+009f in UTF-8
      escape(static_cast<unsigned char>(next));
      ++i;
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return with_written_controls(text, {}); }

std::string printable_lines(std::string_view text) { return with_written_controls(text, "\n\t"); }

}  // namespace breccia
