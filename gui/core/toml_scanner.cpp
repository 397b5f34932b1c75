#include "core/toml_scanner.hpp"

#include <algorithm>

namespace breccia::gui {
namespace {

bool bare(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

std::string below(const std::string& path, const std::string& name) { return path.empty() ? name : path + "." + name; }

}  // namespace

int TomlScanner::line_of(std::size_t at) {
  if (at < counted_to_) {
    counted_to_ = 0;
    line_ = 1;
  }
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_to_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  counted_to_ = at;
  return line_;
}

void TomlScanner::blanks() {
  while (now() == ' ' || now() == '\t') ++at_;
}

void TomlScanner::to_line_end() {
  at_ = std::min(text_.find('\n', at_), text_.size());
  if (!at_end()) ++at_;
}

void TomlScanner::blanks_and_lines() {
  while (!at_end()) {
    if (now() == '#') {
      to_line_end();
    } else if (now() == ' ' || now() == '\t' || now() == '\n' || now() == '\r') {
      ++at_;
    } else {
      return;
    }
  }
}

std::size_t TomlScanner::note(Place place) {
  place.line = line_of(place.entry.begin);
  places_.index_.emplace(place.path, places_.places_.size());
  places_.places_.push_back(std::move(place));
  return places_.places_.size() - 1;
}

void TomlScanner::scan() {
  if (ahead("\xEF\xBB\xBF")) at_ = 3;
  std::string section;
  std::size_t owner = std::string::npos;
  while (true) {
    blanks_and_lines();
    if (at_end()) return;
    if (now() == '[') {
      const std::size_t before = places_.places_.size();
      header();
      if (places_.places_.size() > before) {
        owner = before;
        section = places_.places_[before].path;
      }
    } else {
      entry(section, owner);
    }
    to_line_end();
  }
}

void TomlScanner::header() {
  const std::size_t begin = at_;
  const bool list = ahead("[[");
  at_ += list ? 2 : 1;
  const std::vector<std::string> parts = key();
  blanks();
  if (parts.empty() || !ahead(list ? "]]" : "]")) return;
  at_ += list ? 2 : 1;
  Place place;
  place.kind = Place::Kind::section;
  place.value = place.entry = {begin, at_};
  place.path = resolved(parts, list);
  note(std::move(place));
}

std::string TomlScanner::resolved(const std::vector<std::string>& parts, bool list) {
  std::string path;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    path = below(path, parts[i]);
    const bool last = i + 1 == parts.size();
    if (last && list) {
      path += "[" + std::to_string(places_.counts_[path]++) + "]";
    } else if (const auto it = places_.counts_.find(path); it != places_.counts_.end() && it->second > 0) {
      path += "[" + std::to_string(it->second - 1) + "]";
    }
  }
  return path;
}

void TomlScanner::entry(const std::string& section, std::size_t stop_owner) {
  const std::size_t begin = at_;
  const std::vector<std::string> parts = key();
  blanks();
  if (parts.empty() || now() != '=') return;
  ++at_;
  blanks();
  std::string path = section;
  for (const std::string& part : parts) path = below(path, part);
  const std::size_t start = at_;
  const std::size_t mine = note({Place::Kind::value, {start, start}, {begin, start}, 0, path});
  const bool table = now() == '{';
  if (!value(path, 0)) at_ = std::min(text_.find('\n', start), text_.size());
  std::size_t end = at_;
  while (end > start && (text_[end - 1] == ' ' || text_[end - 1] == '\t' || text_[end - 1] == '\r')) --end;
  Place& place = places_.places_[mine];
  place.value = {start, end};
  place.entry = {begin, end};
  if (table) place.kind = Place::Kind::inline_table;
  if (stop_owner != std::string::npos) places_.places_[stop_owner].entry.end = end;
}

std::string TomlScanner::key_part() {
  const std::size_t begin = at_;
  if (now() == '"' || now() == '\'') {
    if (!quoted(now())) return {};
    return text_.substr(begin + 1, at_ - begin - 2);
  }
  while (bare(now())) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::vector<std::string> TomlScanner::key() {
  std::vector<std::string> parts;
  while (true) {
    blanks();
    std::string part = key_part();
    if (part.empty()) return {};
    parts.push_back(std::move(part));
    blanks();
    if (now() != '.') return parts;
    ++at_;
  }
}

bool TomlScanner::quoted(char quote) {
  const std::string three(3, quote);
  if (ahead(three)) {
    at_ += 3;
    while (!at_end() && !ahead(three)) at_ += now() == '\\' && quote == '"' ? 2 : 1;
    if (at_end()) return false;
    at_ += 3;
    while (now() == quote) ++at_;  // up to two quotes may end the text itself
    return true;
  }
  ++at_;
  while (!at_end() && now() != quote && now() != '\n') at_ += now() == '\\' && quote == '"' ? 2 : 1;
  if (now() != quote) return false;
  ++at_;
  return true;
}

bool TomlScanner::value(const std::string& path, int depth) {
  if (depth > kDeepest || at_end()) return false;
  if (now() == '"' || now() == '\'') return quoted(now());
  if (now() == '[') return list(path, depth);
  if (now() == '{') return inline_table(path, depth);
  const std::size_t begin = at_;
  while (!at_end() && std::string_view(",]}#\n\r").find(now()) == std::string_view::npos) ++at_;
  while (at_ > begin && (text_[at_ - 1] == ' ' || text_[at_ - 1] == '\t')) --at_;
  return at_ > begin;
}

bool TomlScanner::list(const std::string& path, int depth) {
  ++at_;
  int count = 0, tables = 0;
  while (true) {
    blanks_and_lines();
    if (at_end()) return false;
    if (now() == ']') break;
    const std::string own = path + "[" + std::to_string(count++) + "]";
    const std::size_t begin = at_;
    const bool table = now() == '{';
    const std::size_t mine =
        note({table ? Place::Kind::inline_table : Place::Kind::value, {begin, begin}, {begin, begin}, 0, own});
    tables += table ? 1 : 0;
    if (!value(own, depth + 1)) return false;
    places_.places_[mine].value = places_.places_[mine].entry = {begin, at_};
    blanks_and_lines();
    if (now() == ',') {
      ++at_;
    } else if (now() != ']') {
      return false;
    }
  }
  ++at_;
  if (tables > 0) places_.counts_[path] = count;
  return true;
}

bool TomlScanner::inline_table(const std::string& path, int depth) {
  ++at_;
  while (true) {
    blanks_and_lines();
    if (at_end()) return false;
    if (now() == '}') break;
    const std::size_t begin = at_;
    const std::vector<std::string> parts = key();
    blanks();
    if (parts.empty() || now() != '=') return false;
    ++at_;
    blanks();
    std::string own = path;
    for (const std::string& part : parts) own = below(own, part);
    const std::size_t start = at_;
    const bool table = now() == '{';
    const std::size_t mine =
        note({table ? Place::Kind::inline_table : Place::Kind::value, {start, start}, {begin, start}, 0, own});
    if (!value(own, depth + 1)) return false;
    places_.places_[mine].value = {start, at_};
    places_.places_[mine].entry = {begin, at_};
    blanks_and_lines();
    if (now() == ',') {
      ++at_;
    } else if (now() != '}') {
      return false;
    }
  }
  ++at_;
  return true;
}

}  // namespace breccia::gui
