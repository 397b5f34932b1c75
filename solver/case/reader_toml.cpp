#include "case/reader_toml.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/error.hpp"
#include "base/geometry_file.hpp"
#include "case/units.hpp"
#include "system/bounded_file.hpp"

namespace breccia::case_ {
namespace {

constexpr std::size_t longest_shown = 60;
/// Bytes of a case at most: that of thirty tables of 10,000 points. Its values take a hundred times as much memory.
constexpr std::uint64_t kLargestCase = 8'000'000;

Node converted(const toml::node& node, const std::string& file) {
  Node out;
  out.file = file;
  out.line = static_cast<int>(node.source().begin.line);
  if (const auto* table = node.as_table()) {
    out.kind = Node::Kind::table;
    for (const auto& [key, value] : *table) {
      out.entries.emplace_back(std::string(key.str()), converted(value, file));
      // A table made by a dotted key has no place of its own.
      if (out.entries.back().second.line == 0)
        out.entries.back().second.line = static_cast<int>(key.source().begin.line);
    }
    const auto earlier = [](const auto& a, const auto& b) { return a.second.line < b.second.line; };
    std::stable_sort(out.entries.begin(), out.entries.end(), earlier);
  } else if (const auto* list = node.as_array()) {
    out.kind = Node::Kind::list;
    for (const auto& item : *list) out.items.push_back(converted(item, file));
  } else if (const auto* text = node.as_string()) {
    out.kind = Node::Kind::text;
    out.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    out.kind = Node::Kind::integer;
    out.integer = integer->get();
    out.number = static_cast<double>(out.integer);
  } else if (const auto* number = node.as_floating_point()) {
    out.kind = Node::Kind::number;
    out.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    out.kind = Node::Kind::boolean;
    out.boolean = boolean->get();
  } else {
    out.kind = Node::Kind::other;
  }
  return out;
}

constexpr int deepest_key = 64;

// Passes over a text in quotes, simple or threefold, and counts its lines. @return  the place behind it
std::size_t behind_text(std::string_view toml, std::size_t at, int& line) {
  const std::string_view quote =
      toml.substr(at, 3) == std::string(3, toml[at]) ? toml.substr(at, 3) : toml.substr(at, 1);
  for (at += quote.size(); at < toml.size(); ++at) {
    if (toml[at] == '\n') {
      ++line;
      if (quote.size() == 1) return at + 1;  // the parser will complain
    } else if (toml[at] == '\\' && quote[0] == '"') {
      ++at;
    } else if (toml.substr(at, quote.size()) == quote) {
      return at + quote.size();
    }
  }
  return at;
}

// The parser and the tree it makes are as deep on the stack as a dotted key is: a.a.a... of 50,000 would end us.
void refuse_deep_keys(std::string_view toml, const std::string& file) {
  int line = 1, dots = 0;
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      at = behind_text(toml, at, line);
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '\n') ++line;
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    if (c == '.' && ++dots > deepest_key)
      throw InputError({file, line, "", "a key is too deep", "at most " + std::to_string(deepest_key) + " dots", ""});
    ++at;
  }
}

std::string_view line_of(std::string_view text, int number) {
  for (; number > 1 && !text.empty(); --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// Whether a value on this line is a number with a comma: "young = 0,2".
bool has_comma_in_number(std::string_view line) {
  const auto is_digit = [&](std::size_t i) {
    return i < line.size() && std::isdigit(static_cast<unsigned char>(line[i])) != 0;
  };
  for (std::size_t at = line.find('='); at != std::string_view::npos; at = line.find('=', at + 1)) {
    std::size_t i = std::min(line.find_first_not_of(" \t+-", at + 1), line.size());
    const std::size_t first = i;
    while (is_digit(i)) ++i;
    if (i > first && i < line.size() && line[i] == ',' && is_digit(i + 1)) return true;
  }
  return false;
}

}  // namespace

Node::Node() = default;

const Node* Node::find(std::string_view name) const {
  const auto it = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == name; });
  return it == entries.end() ? nullptr : &it->second;
}

Node* Node::find(std::string_view name) { return const_cast<Node*>(std::as_const(*this).find(name)); }

std::string_view Node::kind_name() const {
  switch (kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "text";
    case Kind::list:
      return "a list";
    case Kind::table:
      return "a table";
    case Kind::other:
      return "a date or time";
  }
  return "";
}

std::string Node::shown() const {
  std::string out;
  const auto append = [&](const std::string& part) {
    if (out.size() > 1) out += ", ";
    out += part;
  };
  switch (kind) {
    case Kind::boolean:
      return boolean ? "true" : "false";
    case Kind::integer:
      return std::to_string(integer);
    case Kind::number: {
      std::ostringstream stream;
      stream << number;
      return stream.str();
    }
    case Kind::text:
      out = "\"" + text + "\"";
      break;
    case Kind::list:
      out = "[";
      for (const Node& item : items)
        if (out.size() < longest_shown) append(item.shown());
      out += "]";
      break;
    case Kind::table:
      out = "{";
      for (const auto& [name, value] : entries)
        if (out.size() < longest_shown) append(name + " = " + value.shown());
      out += "}";
      break;
    case Kind::other:
      return std::string(kind_name());
  }
  return out.size() <= longest_shown ? out : out.substr(0, longest_shown - 3) + "...";
}

Node parse_toml_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored) && geometry_file(path) != GeometryFile::unknown)
    throw InputError({name, 0, "", "is a geometry or a mesh, not a case",
                      "a case (.toml) that names it: [mesh] with file = \"" + path.filename().string() + "\"", ""});
  const BoundedFile content = read_bounded(path, kLargestCase);
  if (content.problem == kDoesNotExist) throw InputError({name, 0, "", "the case file does not exist", "", ""});
  if (!content.problem.empty()) throw InputError({name, 0, "", "the case " + content.problem, "a TOML file", ""});
  return parse_toml_text(content.text, name);
}

Node parse_toml_text(std::string_view text, const std::string& name) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError({name, 1, "", "is UTF-16 text", "UTF-8 text", ""});
  refuse_deep_keys(text, name);
  try {
    Node root = converted(toml::parse(text, name), name);
    root.line = 0;
    return root;
  } catch (const toml::parse_error& e) {
    const int line = static_cast<int>(e.source().begin.line);
    if (has_comma_in_number(line_of(text, line)))
      throw InputError({name, line, "", "not TOML: a comma in a number", kDecimalPoint, ""});
    throw InputError({name, line, "", "not TOML: " + std::string(e.description()), "", ""});
  }
}

Node parse_toml_value(std::string_view text, const std::string& source) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  const std::string trimmed(
      first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1));
  Node out;
  refuse_deep_keys(trimmed, source);
  try {
    const toml::table table = toml::parse("value = " + trimmed);
    // A line break would smuggle in a second key.
    if (table.size() == 1)
      out = converted(*table.get("value"), source);
    else
      throw InputError({source, 0, "", "more than one value", "a TOML value", trimmed});
  } catch (const toml::parse_error& e) {
    constexpr std::string_view structured = "[{\"'";
    if (!trimmed.empty() && structured.find(trimmed.front()) != std::string_view::npos)
      throw InputError({source, 0, "", "not a TOML value: " + std::string(e.description()), "", trimmed});
    out.kind = Node::Kind::text;
    out.text = trimmed;
    out.file = source;
  }
  const auto forget_line = [](Node& node, const auto& self) -> void {
    node.line = 0;
    for (Node& item : node.items) self(item, self);
    for (auto& entry : node.entries) self(entry.second, self);
  };
  forget_line(out, forget_line);
  return out;
}

}  // namespace breccia::case_
