#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace breccia::run_folder {

struct WholeLines {
  std::vector<std::string_view> lines;  ///< without their line feeds; views into the text
  bool is_cut = false;                  ///< something follows the last line feed: a line that is not whole
};

/// The lines of a text that end with a line feed.
[[nodiscard]] inline WholeLines whole_lines(std::string_view text) {
  WholeLines found;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    found.lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  found.is_cut = !text.empty();
  return found;
}

/// Reads the next line that ends with a line feed. False at the end, and before a line that is not whole.
[[nodiscard]] inline bool next_whole_line(std::istream& stream, std::string& line) {
  return std::getline(stream, line) && !stream.eof();
}

}  // namespace breccia::run_folder
