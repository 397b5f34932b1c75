#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace breccia::case_ {

/// A value as it stands in a case file, with the place where it was written.
struct Node {
  enum class Kind { boolean, integer, number, text, list, table, other };

  Node();  // not here: of a class that lies within itself in a pair, clang 14 cannot make it

  Kind kind = Kind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;  ///< of an integer too
  std::string text;
  std::vector<Node> items;                            ///< of a list
  std::vector<std::pair<std::string, Node>> entries;  ///< of a table, in the order of the file
  std::string file;                                   ///< as the user named it, or "--set"
  int line = 0;
  int place = -1;  ///< of an entry of a list that was expanded: its index as it was written

  [[nodiscard]] const Node* find(std::string_view name) const;
  [[nodiscard]] Node* find(std::string_view name);
  [[nodiscard]] bool is(Kind k) const { return kind == k; }
  /// "a table", "text", ...
  [[nodiscard]] std::string_view kind_name() const;
  /// The value as one would write it, shortened.
  [[nodiscard]] std::string shown() const;
};

/// Parses a TOML file. Throws InputError: file absent, not readable, or not TOML (with the line).
[[nodiscard]] Node parse_toml_file(const std::filesystem::path& path);

/// Parses the text of a TOML file. @param name  of the file, for messages. Throws InputError: not TOML (with the line).
[[nodiscard]] Node parse_toml_text(std::string_view text, const std::string& name);

/// Parses one value as in `key = value`; a text that is no TOML value and does not begin as a list, table or quoted
/// text is taken as the text itself ("ms_slices", "70 GPa"). `source` names the place in messages. Throws InputError.
[[nodiscard]] Node parse_toml_value(std::string_view text, const std::string& source);

}  // namespace breccia::case_
