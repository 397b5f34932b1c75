#pragma once

#include "core/toml_places.hpp"

namespace breccia::gui {

/// Walks over the text once and notes every place. What it cannot read it passes over to the end of the line.
class TomlScanner {
 public:
  explicit TomlScanner(TomlPlaces& places) : places_(places), text_(places.text_) {}
  void scan();

 private:
  void header();
  void entry(const std::string& section, std::size_t stop_owner);
  /// Reads a value; of tables and lists in it notes the places below `path`. Returns false when it makes no sense.
  bool value(const std::string& path, int depth);
  bool inline_table(const std::string& path, int depth);
  bool list(const std::string& path, int depth);
  bool quoted(char quote);
  [[nodiscard]] std::vector<std::string> key();
  [[nodiscard]] std::string key_part();
  /// Path of a header's table; a new entry of a list when `list`.
  [[nodiscard]] std::string resolved(const std::vector<std::string>& parts, bool list);
  std::size_t note(Place place);

  void blanks();            // spaces and tabs
  void blanks_and_lines();  // and comments and line ends
  void to_line_end();
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char now() const { return at_end() ? '\0' : text_[at_]; }
  [[nodiscard]] bool ahead(std::string_view what) const {
    return std::string_view(text_).substr(at_).starts_with(what);
  }
  [[nodiscard]] int line_of(std::size_t at);

  static constexpr int kDeepest = 64;
  TomlPlaces& places_;
  const std::string& text_;
  std::size_t at_ = 0;
  std::size_t counted_to_ = 0;
  int line_ = 1;
};

}  // namespace breccia::gui
