#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The one table of every key of the case file. Reader, range checks, writer and `breccia explain` are driven by it: no
/// key's unit, default, range or choice stands anywhere else.
namespace breccia::case_ {

enum class ValueType {
  section,       ///< [path]
  section_list,  ///< [[path]]; its path ends with []
  notation,      ///< heading of keys that may stand inside other values (a function of time), no section of its own
  number,        ///< with a unit
  integer,
  boolean,
  text,
  text_or_list,  ///< a text, or a list of texts: the entry around it stands for one entry each
  choice,        ///< one of a few words
  path,          ///< file, relative to the case file
  column,        ///< of a file: its name, or its number from 1
  axes,          ///< letters of "xyz"
  text_list,
  text_pair,
  number_pair,       ///< with a unit
  vector,            ///< three numbers with a unit
  vector_or_number,  ///< three numbers with a unit, or one for all three
  integers_or_one,   ///< three integers, or one for all three
  function,          ///< of time; a quantity or a table of <function> keys
  function_vector,   ///< three functions of time
  axis_functions,    ///< table with a function of time for some of x, y, z
  parameters,        ///< table of numbers under names of the user's choice
  settings,          ///< table of numbers and texts under names of the user's choice
  points             ///< list of pairs [time, value]
};

/// Interval of allowed numbers, for every component of a vector or list. Open ends are not allowed themselves.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  [[nodiscard]] bool contains(double x) const {
    return (lower_open ? x > lower : x >= lower) && (upper_open ? x < upper : x <= upper);
  }
  [[nodiscard]] bool limited() const { return *this != Range{}; }
  /// "> 0", "between -1 and 0.5, both excluded", ... ; empty when unlimited.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Range&, const Range&) = default;
};

/// Who needs a key: any user, or one who knows why.
enum class Level { expert, basic };

/// One row of the table.
struct Key {
  std::string_view path{};      ///< pattern: "material[].density"; [] stands for any index
  Level level = Level::expert;  ///< of a key, see level_of(); basic ones come first where keys are listed
  ValueType type = ValueType::section;
  std::string_view unit =
      "1";  ///< SI, as units.hpp reads it; "1": none; in <function> keys "*" is the unit of the value
  std::string_view fallback{};  ///< default as it would be written; "= key": that of another key; empty: none
  bool required = false;        ///< missing is an error; section_list: at least one
  Range range{};
  std::string_view choices{};  ///< "a|b|c", for choice and integer, in the order of the enumeration they stand for
  std::string_view word{};     ///< a word that may stand instead of a number and means 0, e.g. "auto"
  std::string_view help{};     ///< one or two sentences
  std::string_view example{};  ///< value as it would be written
  /// Why a run that starts from the state of another has this as the other had it, for a section and all in it; empty:
  /// as the section around it; may_change: it may change there.
  std::string_view fixed_by_state{};

  [[nodiscard]] std::vector<std::string> choice_list() const;
  /// Last part of the path: "density".
  [[nodiscard]] std::string_view name() const;
  /// Path without the last part: "material[]"; empty at the top.
  [[nodiscard]] std::string_view section() const;
  [[nodiscard]] bool is_section() const {
    return type == ValueType::section || type == ValueType::section_list || type == ValueType::notation;
  }
};

inline constexpr std::string_view may_change = "-";

/// Why what stands at a pattern cannot change in a run that starts from the state of another; empty: it can.
[[nodiscard]] std::string_view fixed_by_state(std::string_view pattern);

/// The level of a section is that of its keys and sections: basic where one of them is.
[[nodiscard]] Level level_of(const Key& key);

/// The same as a text: "as in the run that it starts from: " and why; empty: it can change.
[[nodiscard]] std::string start_rule(const Key& key);

/// All rows, sections before their keys, in the order of a case file.
[[nodiscard]] std::span<const Key> schema();

/// The row of a pattern, or nullptr. O(log rows).
[[nodiscard]] const Key* find_key(std::string_view pattern);

/// The row of what stands at a path of a case, also inside a function of time: that of <function>.ramp[].to for
/// stage[0].gravity[2].ramp.to. nullptr: none. O(rows).
[[nodiscard]] const Key* row_at(std::string_view path);

/// The row of a pattern that must be there. Throws InternalError if it is not.
[[nodiscard]] const Key& key_of(std::string_view pattern);

/// "stage[0].constraint[12].fixed" -> "stage[].constraint[].fixed"
[[nodiscard]] std::string pattern_of(std::string_view path);

/// Path as it is typed, without [], indices and <>: "stage.constraint.fixed".
[[nodiscard]] std::string plain_path(std::string_view path);

/// A section as it is written in a case file: "[mesh.raster]", "[[stage.constraint]]"; a notation by its name.
[[nodiscard]] std::string header_of(const Key& section);

/// Names of the keys and sub-sections of a section ("" for the top), without [].
[[nodiscard]] std::vector<std::string> names_in(std::string_view section);

/// What may stand at a key, in words: type, unit, range, choices.
[[nodiscard]] std::string allowed_text(const Key& key);

/// Patterns of keys whose name resembles that of an unknown one, at most `count`: those of the same section first, then
/// by distance of the names, then of the whole paths.
[[nodiscard]] std::vector<std::string> similar_keys(std::string_view pattern, std::size_t count);

}  // namespace breccia::case_
