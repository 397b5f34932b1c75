#include "case/schema.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "case/nearest.hpp"

namespace breccia::case_ {
namespace {

std::string short_number(double x) {
  std::array<char, 32> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, std::chars_format::general, 6);
  return {buffer.data(), end};
}

std::string quantity_words(const Key& key) {
  return key.unit == "1" ? "a number" : "a number in " + std::string(key.unit) + " or text with a unit";
}

std::string type_words(const Key& key) {
  switch (key.type) {
    case ValueType::section:
      return "a table, " + header_of(key);
    case ValueType::section_list:
      return "one or more tables, " + header_of(key);
    case ValueType::notation:
      return "";
    case ValueType::number:
      return quantity_words(key);
    case ValueType::integer:
      return "an integer";
    case ValueType::boolean:
      return "true or false";
    case ValueType::text:
      return "text";
    case ValueType::text_or_list:
      return "text, or a list of texts";
    case ValueType::choice:
      return "one of";
    case ValueType::path:
      return "a file name";
    case ValueType::column:
      return "the name of a column or its number, from 1";
    case ValueType::axes:
      return "letters out of \"xyz\"";
    case ValueType::text_list:
      return "a list of texts";
    case ValueType::text_pair:
      return "a list of two texts";
    case ValueType::number_pair:
      return "a list of two, each " + quantity_words(key);
    case ValueType::vector:
      return "a list of three, each " + quantity_words(key);
    case ValueType::vector_or_number:
      return "a list of three, each " + quantity_words(key) + ", or one for all";
    case ValueType::integers_or_one:
      return "a list of three integers, or one for all";
    case ValueType::function:
      return "a function of time: " + quantity_words(key) + ", or a table of constant, linear, sine, table, ramp, csv";
    case ValueType::function_vector:
      return "a list of three functions of time, each " + quantity_words(key) +
             ", or a table of constant, linear, sine, table, ramp, csv";
    case ValueType::axis_functions:
      return "a table of functions of time, in " + std::string(key.unit) + ", for some of x, y, z";
    case ValueType::parameters:
      return "a table of numbers, or texts with units, under names of your choice";
    case ValueType::settings:
      return "a table of numbers, texts with units, or texts, under names of your choice";
    case ValueType::points:
      return "a list of points [time, value], times increasing";
  }
  return "";
}

// "." separates the parts of a path, but no name contains one.
std::string_view last_part(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

}  // namespace

std::string Range::text() const {
  const bool has_lower = lower != -std::numeric_limits<double>::infinity();
  const bool has_upper = upper != std::numeric_limits<double>::infinity();
  std::string low = std::string(lower_open ? "> " : ">= ") + short_number(lower);
  std::string high = std::string(upper_open ? "< " : "<= ") + short_number(upper);
  if (has_lower && has_upper) return low + " and " + high;
  if (has_lower) return low;
  return has_upper ? high : "";
}

std::vector<std::string> Key::choice_list() const {
  std::vector<std::string> out;
  for (std::string_view rest = choices; !rest.empty();) {
    const std::size_t bar = rest.find('|');
    out.emplace_back(rest.substr(0, bar));
    rest = bar == std::string_view::npos ? std::string_view{} : rest.substr(bar + 1);
  }
  return out;
}

std::string_view Key::name() const {
  const std::string_view part = last_part(path);
  return part.ends_with("[]") ? part.substr(0, part.size() - 2) : part;
}

std::string_view Key::section() const {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

const Key* find_key(std::string_view pattern) {
  static const std::map<std::string_view, const Key*> index = [] {
    std::map<std::string_view, const Key*> out;
    for (const Key& key : schema()) out.emplace(key.path, &key);
    return out;
  }();
  const auto it = index.find(pattern);
  return it == index.end() ? nullptr : it->second;
}

std::string start_rule(const Key& key) {
  const std::string_view why = fixed_by_state(key.path);
  return why.empty() ? "" : "as in the run that it starts from: " + std::string(why);
}

Level level_of(const Key& key) {
  if (!key.is_section()) return key.level;
  const auto below = [&](const Key& row) {
    return row.level == Level::basic && row.path.size() > key.path.size() && row.path.starts_with(key.path) &&
           row.path[key.path.size()] == '.';
  };
  const std::span<const Key> rows = schema();
  return std::any_of(rows.begin(), rows.end(), below) ? Level::basic : Level::expert;
}

std::string_view fixed_by_state(std::string_view pattern) {
  for (std::string_view at = pattern; !at.empty(); at = key_of(at).section()) {
    const std::string_view why = key_of(at).fixed_by_state;
    if (!why.empty()) return why == may_change ? std::string_view{} : why;
  }
  return {};
}

const Key& key_of(std::string_view pattern) {
  const Key* key = find_key(pattern);
  DEMAND(key != nullptr, std::string(pattern));
  return *key;
}

std::string pattern_of(std::string_view path) {
  std::string out;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) out += c;
    if (c == '[') inside = true;
  }
  return out;
}

const Key* row_at(std::string_view path) {
  const std::string pattern = pattern_of(path);
  if (const Key* key = find_key(pattern)) return key;
  for (const Key& key : schema()) {
    const bool is_function = key.type == ValueType::function || key.type == ValueType::function_vector ||
                             key.type == ValueType::axis_functions;
    if (!is_function || !pattern.starts_with(key.path)) continue;
    std::string rest = pattern.substr(key.path.size());
    if (key.type != ValueType::function) rest.erase(0, std::min<std::size_t>(2, rest.size()));  // "[]", ".x"
    const std::size_t end = rest.find('.', 1);
    if (const Key* row = find_key("<function>" + rest)) return row;
    if (end != std::string::npos)
      if (const Key* row = find_key("<function>" + rest.substr(0, end) + "[]" + rest.substr(end))) return row;
  }
  return nullptr;
}

std::string plain_path(std::string_view path) {
  std::string out;
  bool inside = false;
  for (const char c : path) {
    inside = (inside || c == '[') && c != ']';
    if (!inside && c != ']' && c != '<' && c != '>') out += c;
  }
  return out;
}

std::string header_of(const Key& section) {
  std::string name = plain_path(section.path);
  if (section.path.starts_with('<')) return name;
  return section.type == ValueType::section_list ? "[[" + name + "]]" : "[" + name + "]";
}

std::vector<std::string> names_in(std::string_view section) {
  std::vector<std::string> out;
  for (const Key& key : schema())
    if (key.section() == section && key.type != ValueType::notation) out.emplace_back(key.name());
  return out;
}

std::string allowed_text(const Key& key) {
  std::string out = type_words(key);
  if (!key.choices.empty()) out += (out == "one of" ? " " : ", one of ") + joined(key.choice_list());
  if (key.range.limited()) out += ", " + key.range.text();
  if (!key.word.empty()) out += ", or \"" + std::string(key.word) + "\"";
  return out;
}

std::vector<std::string> similar_keys(std::string_view pattern, std::size_t count) {
  const std::size_t dot = pattern.rfind('.');
  const std::string_view section = dot == std::string_view::npos ? std::string_view{} : pattern.substr(0, dot);
  std::string_view name = last_part(pattern);
  if (name.ends_with("[]")) name.remove_suffix(2);

  struct Ranked {
    bool elsewhere;
    std::size_t by_name, by_path;
    const Key* key;
  };
  std::vector<Ranked> ranked;
  const std::size_t allowed = std::max<std::size_t>(1, name.size() / 3);
  for (const Key& key : schema()) {
    const std::size_t by_name = edit_distance(name, key.name());
    if (by_name <= allowed)
      ranked.push_back({key.section() != section, by_name, edit_distance(pattern, key.path), &key});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return std::tuple(a.elsewhere, a.by_name, a.by_path) < std::tuple(b.elsewhere, b.by_name, b.by_path);
  });
  std::vector<std::string> out;
  for (const Ranked& r : ranked)
    if (out.size() < count) out.emplace_back(r.key->path);
  return out;
}

}  // namespace breccia::case_
