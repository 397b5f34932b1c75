#include "core/toml_places.hpp"

#include <algorithm>

#include "core/toml_scanner.hpp"

namespace breccia::gui {
namespace {

bool stands_below(std::string_view path, std::string_view above) {
  if (above.empty()) return true;
  return path.size() > above.size() && path.starts_with(above) &&
         (path[above.size()] == '.' || path[above.size()] == '[');
}

/// "stage[0].constraint[1]" as it stands in a header: "stage.constraint".
std::string header_path(std::string_view path) {
  std::string out;
  bool inside = false;
  for (const char c : path) {
    if (c == '[') inside = true;
    if (!inside) out += c;
    if (c == ']') inside = false;
  }
  return out;
}

}  // namespace

std::string parent_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string() : std::string(path.substr(0, dot));
}

std::string leaf_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return std::string(dot == std::string_view::npos ? path : path.substr(dot + 1));
}

std::string toml_key(const std::string& name) {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? name : '"' + name + '"';
}

TomlPlaces::TomlPlaces(std::string text) : text_(std::move(text)) { TomlScanner(*this).scan(); }

const Place* TomlPlaces::find(std::string_view path) const {
  const auto it = index_.find(path);
  return it == index_.end() ? nullptr : &places_[it->second];
}

std::string_view TomlPlaces::value(std::string_view path) const {
  const Place* place = find(path);
  if (place == nullptr) return {};
  return std::string_view(text_).substr(place->value.begin, place->value.size());
}

int TomlPlaces::count(std::string_view list) const {
  const auto it = counts_.find(list);
  return it == counts_.end() ? 0 : it->second;
}

std::vector<std::string> TomlPlaces::names_below(std::string_view path) const {
  std::vector<std::string> names;
  for (const Place& place : places_) {
    if (!stands_below(place.path, path)) continue;
    std::string_view rest = std::string_view(place.path).substr(path.empty() ? 0 : path.size());
    if (rest.starts_with('[')) continue;
    if (rest.starts_with('.')) rest.remove_prefix(1);
    const std::string name(rest.substr(0, rest.find_first_of(".[")));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string TomlPlaces::path_at_line(int line) const {
  const Place* best = nullptr;
  for (const Place& place : places_) {
    if (place.line == line && (best == nullptr || best->line < line)) return place.path;
    if (place.kind == Place::Kind::section && place.line < line) best = &place;
  }
  return best == nullptr ? std::string() : best->path;
}

std::string TomlPlaces::newline() const { return text_.find("\r\n") == std::string::npos ? "\n" : "\r\n"; }

std::size_t TomlPlaces::line_end(std::size_t at) const {
  const std::size_t end = text_.find('\n', at);
  return end == std::string::npos ? text_.size() : end + 1;
}

std::size_t TomlPlaces::line_begin(std::size_t at) const {
  const std::size_t end = at == 0 ? std::string::npos : text_.rfind('\n', at - 1);
  return end == std::string::npos ? 0 : end + 1;
}

std::size_t TomlPlaces::end_with_children(std::string_view path) const {
  std::size_t end = 0;
  bool inside = false;
  for (const Place& place : places_) {
    if (place.kind != Place::Kind::section) continue;
    if (place.path == path || (inside && stands_below(place.path, path))) {
      inside = true;
      end = place.entry.end;
    } else if (inside) {
      break;
    }
  }
  return end;
}

TextChange TomlPlaces::insert_section(std::string_view parent, const std::string& header,
                                      std::string_view lines) const {
  const std::size_t behind = parent.empty() ? 0 : end_with_children(parent);
  const std::size_t at = behind == 0 ? text_.size() : line_end(behind);
  const std::string n = newline();
  std::string text;
  if (at > 0 && text_[at - 1] != '\n') text += n;
  if (at > 0) text += n;
  text += header + n;
  for (const char c : lines) {
    if (c == '\n') {
      text += n;
    } else {
      text += c;
    }
  }
  return {at, "", text};
}

TextChange TomlPlaces::set(std::string_view path, std::string_view value) const {
  if (const Place* place = find(path); place != nullptr && place->kind != Place::Kind::section)
    return {place->value.begin, text_.substr(place->value.begin, place->value.size()), std::string(value)};
  const std::string parent = parent_of(path), name = leaf_of(path), n = newline();
  const std::string line = toml_key(name) + " = " + std::string(value);
  const Place* section = find(parent);
  if (section != nullptr && section->kind == Place::Kind::inline_table) {
    std::size_t at = section->value.end - 1;  // the closing bracket
    while (at > section->value.begin + 1 && (text_[at - 1] == ' ' || text_[at - 1] == '\t')) --at;
    const bool none = at == section->value.begin + 1;
    return {at, "", (none ? " " : ", ") + line + (none && text_[at] == '}' ? " " : "")};
  }
  if (section != nullptr && section->kind == Place::Kind::section) {
    const std::size_t at = line_end(section->entry.end);
    const bool open = at > 0 && text_[at - 1] != '\n';
    return {at, "", (open ? n : "") + line + n};
  }
  if (parent.empty()) {
    std::size_t at = 0;  // keys of the top stand before the first section
    for (const Place& place : places_) {
      if (place.kind == Place::Kind::section) break;
      at = std::max(at, line_end(place.entry.end));
    }
    const bool open = at > 0 && text_[at - 1] != '\n';
    return {at, "", (open ? n : "") + line + n};
  }
  const std::string above = parent_of(parent);
  const auto is_dotted = [&](const Place& place) {  // parameters.h = 1 in [mesh]
    return place.kind != Place::Kind::section && parent_of(place.path) == parent;
  };
  if (const auto last = std::find_if(places_.rbegin(), places_.rend(), is_dotted); last != places_.rend()) {
    const std::size_t at = line_end(last->entry.end);
    const bool open = at > 0 && text_[at - 1] != '\n';
    const std::size_t begin = last->entry.begin;
    const std::string written = text_.substr(begin, text_.find('=', begin) - begin);
    return {at, "", (open ? n : "") + written.substr(0, written.rfind('.') + 1) + line + n};
  }
  // A section of which nothing is there yet.
  return insert_section(above, "[" + header_path(parent) + "]", line + "\n");
}

TextChange TomlPlaces::remove(std::string_view path) const {
  const Place* place = find(path);
  if (place == nullptr) return {};
  Span gone = place->entry;
  if (place->kind == Place::Kind::section) {
    gone.begin = line_begin(gone.begin);
    gone.end = line_end(end_with_children(path));
    while (gone.end < text_.size() && (text_[gone.end] == '\n' || text_[gone.end] == '\r')) ++gone.end;
  } else if (const Place* around = find(parent_of(path));
             around != nullptr && around->kind == Place::Kind::inline_table) {
    std::size_t after = gone.end, before = gone.begin;
    while (after < text_.size() && (text_[after] == ' ' || text_[after] == '\t')) ++after;
    while (before > 0 && (text_[before - 1] == ' ' || text_[before - 1] == '\t')) --before;
    if (text_[after] == ',') {
      gone.end = after + 1;
      while (text_[gone.end] == ' ') ++gone.end;
    } else if (before > 0 && text_[before - 1] == ',') {
      gone.begin = before - 1;
    }
  } else {
    gone = {line_begin(gone.begin), line_end(gone.end)};
  }
  return {gone.begin, text_.substr(gone.begin, gone.size()), ""};
}

TextChange TomlPlaces::add_entry(std::string_view list, std::string_view lines) const {
  const int n = count(list);
  const std::string header = "[[" + header_path(list) + "]]";
  std::string behind = n > 0 ? std::string(list) + "[" + std::to_string(n - 1) + "]" : parent_of(list);
  if (const Place* last = find(behind); last != nullptr && last->kind == Place::Kind::inline_table) {
    // constraint = [{...}, {...}]: the new one stands beside them.
    std::string row;
    for (std::size_t at = 0; at < lines.size();) {
      const std::size_t end = std::min(lines.find('\n', at), lines.size());
      if (end > at) row += (row.empty() ? "" : ", ") + std::string(lines.substr(at, end - at));
      at = end + 1;
    }
    return {last->value.end, "", ", { " + row + " }"};
  }
  return insert_section(behind, header, lines);
}

TextChange difference(const std::string& before, const std::string& after) {
  std::size_t front = 0, back = 0;
  const std::size_t most = std::min(before.size(), after.size());
  while (front < most && before[front] == after[front]) ++front;
  while (back < most - front && before[before.size() - 1 - back] == after[after.size() - 1 - back]) ++back;
  return {front, before.substr(front, before.size() - front - back), after.substr(front, after.size() - front - back)};
}

std::string applied(std::string text, const TextChange& change) {
  text.replace(change.at, change.removed.size(), change.inserted);
  return text;
}

TextChange reversed(const TextChange& change) { return {change.at, change.inserted, change.removed}; }

}  // namespace breccia::gui
