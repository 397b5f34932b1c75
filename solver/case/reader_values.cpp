#include "case/reader_values.hpp"

#include <algorithm>
#include <cmath>

#include "case/nearest.hpp"
#include "case/reader.hpp"
#include "case/units.hpp"

namespace breccia::case_ {
namespace {

/// 1 for a length, 2 for an area, ...; 0 for what is no power of a length.
int power_of_length(const Dimension& dimension) {
  const auto& [metre, kilogram, second, radian] = dimension.powers;
  return kilogram == 0 && second == 0 && radian == 0 ? metre : 0;
}

}  // namespace

std::string indexed(const std::string& path, std::size_t i) { return path + "[" + std::to_string(i) + "]"; }

void ValueReader::problem(const Node& node, const std::string& path, const std::string& what,
                          const std::string& allowed, const std::string& given) {
  problems_.push_back({node.file, node.line, path, what, allowed, given});
}

void ValueReader::wrong_type(const Key& key, const Node& node, const std::string& path) {
  problem(node, path, "is " + std::string(node.kind_name()), allowed_text(key), node.shown());
}

void ValueReader::unknown_key(const Node& node, const std::string& path, const std::string& pattern) {
  const std::size_t dot = pattern.rfind('.');
  const std::string section = dot == std::string::npos ? "" : pattern.substr(0, dot);
  // Those of the same section come first; a key of another one may not stand here.
  const std::vector<std::string> similar = similar_keys(pattern, 1);
  std::string what = "unknown key";
  if (!similar.empty() && key_of(similar.front()).section() == section)
    what += "; did you mean \"" + std::string(key_of(similar.front()).name()) + "\"?";
  problem(node, path, what, joined(names_in(section)), "");
}

void ValueReader::missing_key(const Key& key, const Node& table, const std::string& path) {
  problem(table, path, "is missing", allowed_text(key), "");
}

bool ValueReader::number(const Key& key, const Node& node, const std::string& path, double& out) {
  double value = 0;
  if (node.is(Node::Kind::integer) || node.is(Node::Kind::number)) {
    value = node.number;
  } else if (node.is(Node::Kind::text)) {
    if (!key.word.empty() && node.text == key.word) {
      out = 0;
      return true;
    }
    try {
      value = to_si(node.text, key.unit);
    } catch (const UnitError& e) {
      problem(node, path, e.what(), e.allowed + (key.word.empty() ? "" : ", or \"" + std::string(key.word) + "\""),
              node.shown());
      return false;
    }
  } else {
    wrong_type(key, node, path);
    return false;
  }
  if (value != 0 && std::abs(value) < smallest_magnitude) {
    problem(node, path, "is a number outside the range of double precision", magnitudes_help(), node.shown());
    return false;
  }
  if (!std::isfinite(value) || !key.range.contains(value)) {
    problem(node, path, std::isfinite(value) ? "is out of range" : "is not finite", allowed_text(key), node.shown());
    return false;
  }
  out = value;
  return true;
}

bool ValueReader::whole(const Key& key, const Node& node, const std::string& path, std::int64_t& out) {
  if (!node.is(Node::Kind::integer)) {
    wrong_type(key, node, path);
    return false;
  }
  const std::vector<std::string> choices = key.choice_list();
  const bool chosen =
      choices.empty() || std::find(choices.begin(), choices.end(), std::to_string(node.integer)) != choices.end();
  if (!chosen || !key.range.contains(node.number)) {
    problem(node, path, "is out of range", allowed_text(key), node.shown());
    return false;
  }
  out = node.integer;
  return true;
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, double& out) {
  number(key, node, path, out);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::int64_t& out) {
  whole(key, node, path, out);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, int& out) {
  std::int64_t value = 0;
  if (!whole(key, node, path, value)) return;
  DEMAND(value == static_cast<int>(value), path);  // the schema's range or choices keep it small
  out = static_cast<int>(value);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::uint64_t& out) {
  std::int64_t value = 0;
  if (whole(key, node, path, value)) out = static_cast<std::uint64_t>(value);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, bool& out) {
  if (node.is(Node::Kind::boolean))
    out = node.boolean;
  else
    wrong_type(key, node, path);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::string& out) {
  // Lists of names have become one entry each.
  if (key.type == ValueType::text_or_list && node.is(Node::Kind::list))
    return problem(node, path, node.items.empty() ? "is an empty list" : "is a list with entries that are no names",
                   allowed_text(key), node.shown());
  if (!node.is(Node::Kind::text)) return wrong_type(key, node, path);
  // Only texts with a default may be empty: the others name a group.
  if (node.text.empty() && (key.fallback.empty() || key.type == ValueType::column))
    return problem(node, path, "is empty", allowed_text(key), "");
  out = node.text;
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::filesystem::path& out) {
  std::string name;
  read(key, node, path, name);
  if (!name.empty()) out = (folder_ / name).lexically_normal();
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, FileColumn& out) {
  constexpr std::int64_t kMostColumns = 100000;
  if (node.is(Node::Kind::integer)) {
    if (node.integer < 1 || node.integer > kMostColumns)
      return problem(node, path, "is out of range", allowed_text(key), node.shown());
    out.number = static_cast<int>(node.integer);
  } else {
    read(key, node, path, out.name);
  }
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::vector<std::string>& out) {
  if (!node.is(Node::Kind::list)) return wrong_type(key, node, path);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    if (!item.is(Node::Kind::text))
      wrong_type(key, item, indexed(path, i));
    else if (item.text.empty())
      problem(item, indexed(path, i), "is empty", allowed_text(key), "");
    else
      texts.push_back(item.text);
  }
  if (texts.size() == node.items.size()) out = std::move(texts);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::array<std::string, 2>& out) {
  std::vector<std::string> texts;
  if (node.is(Node::Kind::list) && node.items.size() != 2) return wrong_type(key, node, path);
  read(key, node, path, texts);
  if (texts.size() == 2) out = {texts[0], texts[1]};
}

template <class T, std::size_t N>
void ValueReader::read_list(const Key& key, const Node& node, const std::string& path, bool one_for_all,
                            std::array<T, N>& out) {
  const std::size_t before = problems_.size();
  std::array<T, N> values{};
  if (node.is(Node::Kind::list)) {
    if (node.items.size() != N)
      return problem(node, path, "is a list of " + std::to_string(node.items.size()), allowed_text(key), node.shown());
    for (std::size_t i = 0; i < N; ++i) read(key, node.items[i], indexed(path, i), values[i]);
  } else {
    if (!one_for_all) return wrong_type(key, node, path);
    read(key, node, path, values[0]);
    values.fill(values[0]);
  }
  if (problems_.size() == before) out = values;
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::array<double, 2>& out) {
  read_list(key, node, path, false, out);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, Vec3& out) {
  std::array<double, 3> values{out.x(), out.y(), out.z()};
  read_list(key, node, path, key.type == ValueType::vector_or_number, values);
  out = Vec3(values[0], values[1], values[2]);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::array<int, 3>& out) {
  read_list(key, node, path, true, out);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::array<TimeFunction, 3>& out) {
  read_list(key, node, path, false, out);
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::map<std::string, double>& out) {
  lengths_.erase(path);
  if (!node.is(Node::Kind::table)) return wrong_type(key, node, path);
  out.clear();
  for (const auto& [name, value] : node.entries) {
    const std::string own = path + "." + name;
    if (!value.is(Node::Kind::text)) {
      number(key, value, own, out[name]);
      continue;
    }
    try {
      const Quantity quantity = parse_quantity(value.text);
      out[name] = quantity.value;
      if (const int power = power_of_length(quantity.dimension); power != 0) lengths_[path][name] = power;
    } catch (const UnitError& e) {
      problem(value, own, e.what(), e.allowed, value.shown());
    }
  }
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::map<std::string, Setting>& out) {
  if (!node.is(Node::Kind::table)) return wrong_type(key, node, path);
  out.clear();
  for (const auto& [name, value] : node.entries) {
    const std::string own = path + "." + name;
    Setting& setting = out[name];
    if (!value.is(Node::Kind::text)) {
      double given = 0;
      if (number(key, value, own, given)) setting.number = given;
      continue;
    }
    if (value.text.find('\0') != std::string::npos) {
      problem(value, own, "holds a character 0", allowed_text(key), "");
      continue;
    }
    setting = read_setting(value.text);
  }
}

void ValueReader::read(const Key& key, const Node& node, const std::string& path, std::array<bool, 3>& axes) {
  if (!node.is(Node::Kind::text)) return wrong_type(key, node, path);
  std::array<bool, 3> found{};
  for (const char c : node.text) {
    const std::size_t axis = std::string_view("xyz").find(c);
    if (axis == std::string_view::npos || found[axis])
      return problem(node, path, "names no axis, or one twice", allowed_text(key), node.shown());
    found[axis] = true;
  }
  if (node.text.empty()) return problem(node, path, "names no axis", allowed_text(key), node.shown());
  axes = found;
}

std::optional<std::size_t> ValueReader::read_choice(const Key& key, const Node& node, const std::string& path) {
  const std::vector<std::string> choices = key.choice_list();
  if (!node.is(Node::Kind::text)) {
    wrong_type(key, node, path);
    return {};
  }
  const auto it = std::find(choices.begin(), choices.end(), node.text);
  if (it != choices.end()) return static_cast<std::size_t>(it - choices.begin());
  const std::string meant = likely_meant(node.text, choices);
  problem(node, path, "is none of the choices" + (meant.empty() ? "" : "; did you mean \"" + meant + "\"?"),
          allowed_text(key), node.shown());
  return {};
}

}  // namespace breccia::case_
