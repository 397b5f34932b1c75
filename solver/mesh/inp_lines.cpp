#include "mesh/inp_lines.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/trimmed.hpp"

namespace breccia {
namespace {

std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    parts.emplace_back(trimmed(text.substr(from, comma - from)));
    from = comma + 1;
  }
  return parts;
}

/// "Set-1" without the quotes that keep its case.
std::string unquoted(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

void read_keyword(InpLine& line, std::string_view text) {
  std::vector<std::string> parts = parts_of(text.substr(1));
  line.keyword = lower_case(parts.front());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::string_view part = parts[i];
    if (part.empty()) continue;
    const std::size_t equals = std::min(part.find('='), part.size());
    const std::string_view value = equals < part.size() ? part.substr(equals + 1) : std::string_view();
    line.parameters[lower_case(std::string(trimmed(part.substr(0, equals))))] = unquoted(value);
  }
}

}  // namespace

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool InpLines::open(const std::filesystem::path& file) {
  constexpr std::size_t kDeepest = 20;  // files that include each other
  std::error_code ignored;
  if (open_.size() == kDeepest || !std::filesystem::is_regular_file(file, ignored)) return false;
  auto opened = std::make_unique<Open>();
  opened->file = file;
  opened->in.open(file, std::ios::binary);
  if (!opened->in) return false;
  open_.push_back(std::move(opened));
  return true;
}

bool InpLines::raw_line(std::string& text) {
  while (!open_.empty()) {
    Open& now = *open_.back();
    while (std::getline(now.in, text)) {
      ++now.line;
      if (now.line == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
      text = std::string(trimmed(text));
      if (!text.empty() && !text.starts_with("**")) return true;
    }
    open_.pop_back();
  }
  return false;
}

bool InpLines::next(InpLine& line) {
  std::string text;
  line = {};
  if (!raw_line(text)) return false;
  line.file = open_.back()->file.string();
  line.line = open_.back()->line;
  line.continues = text.ends_with(',');
  if (text.starts_with('*')) {
    std::string more;
    while (text.ends_with(',') && raw_line(more)) text += more;  // a keyword continues behind a comma
    read_keyword(line, text);
    return true;
  }
  line.items = parts_of(text);
  if (line.continues) line.items.pop_back();
  return true;
}

}  // namespace breccia
