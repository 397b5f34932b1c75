#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Places of the values of a case in its text. Nothing is interpreted beyond that, so a text with mistakes has places
/// as well; the solver's reader finds the mistakes.
namespace breccia::gui {

struct Span {
  std::size_t begin = 0, end = 0;  ///< bytes [begin, end)
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Something that a path of the case names: "material[0].young", "stage[0].constraint[1]", "mesh.raster".
struct Place {
  enum class Kind {
    value,  ///< scalar or list: `key = value`
    inline_table,
    section  ///< [header] or [[header]]
  };
  Kind kind = Kind::value;
  Span value;        ///< text of the value; section: its header
  Span entry;        ///< from the key to the end of the value; section: from the header to the end of its last entry
  int line = 0;      ///< first line, 1-based
  std::string path;  ///< own path
};

/// One replacement of a piece of text; its reverse is another.
struct TextChange {
  std::size_t at = 0;
  std::string removed, inserted;
  [[nodiscard]] bool empty() const { return removed == inserted; }
};

class TomlPlaces {
 public:
  TomlPlaces() = default;
  explicit TomlPlaces(std::string text);

  [[nodiscard]] const std::string& text() const { return text_; }
  /// nullptr: nothing stands there.
  [[nodiscard]] const Place* find(std::string_view path) const;
  [[nodiscard]] std::string_view value(std::string_view path) const;
  /// Number of entries of a list of tables: "stage[0].constraint".
  [[nodiscard]] int count(std::string_view list) const;
  /// Names directly below a path, in the order of the file, indices left out.
  [[nodiscard]] std::vector<std::string> names_below(std::string_view path) const;
  /// Path of what stands at a line: the value or the header that begins there, else the section around it.
  [[nodiscard]] std::string path_at_line(int line) const;
  [[nodiscard]] const std::vector<Place>& all() const { return places_; }

  /// Puts `value`, TOML text, at a path: in place of the old value, or as a new line at the end of the section, which
  /// is made when it does not stand there. @pre lists on the way have the entry.
  [[nodiscard]] TextChange set(std::string_view path, std::string_view value) const;
  /// Takes a value and its line away, or a section with all below it. Empty change: nothing stands there.
  [[nodiscard]] TextChange remove(std::string_view path) const;
  /// A new [[list]] entry with its lines (`key = value\n`...), after the last one.
  [[nodiscard]] TextChange add_entry(std::string_view list, std::string_view lines) const;

 private:
  friend class TomlScanner;
  /// End of the section and of all sections below it that follow without a gap.
  [[nodiscard]] std::size_t end_with_children(std::string_view path) const;
  [[nodiscard]] std::size_t line_end(std::size_t at) const;
  [[nodiscard]] std::size_t line_begin(std::size_t at) const;
  [[nodiscard]] std::string newline() const;
  /// New section at the right place: after its relatives.
  [[nodiscard]] TextChange insert_section(std::string_view parent, const std::string& header,
                                          std::string_view lines) const;

  std::string text_;
  std::vector<Place> places_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::map<std::string, int, std::less<>> counts_;
};

/// The smallest single replacement that makes `after` of `before`.
[[nodiscard]] TextChange difference(const std::string& before, const std::string& after);
[[nodiscard]] std::string applied(std::string text, const TextChange& change);
[[nodiscard]] TextChange reversed(const TextChange& change);

/// Path without indices in the last part's list, and the like.
[[nodiscard]] std::string parent_of(std::string_view path);
[[nodiscard]] std::string leaf_of(std::string_view path);
/// A name as it is written in front of its value: in quotes where it has other signs than letters, digits, - and _.
[[nodiscard]] std::string toml_key(const std::string& name);

}  // namespace breccia::gui
