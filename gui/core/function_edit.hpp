#pragma once

#include <QString>
#include <QStringList>
#include <array>
#include <vector>

#include "base/time_function.hpp"
#include "case/schema.hpp"
#include "core/document.hpp"
#include "core/plot_line.hpp"

namespace breccia::gui {

/// A summand of a function of time.
struct FunctionPart {
  QString kind;  ///< "constant", "linear", "table", "csv", "ramp" or "sine", as the table of keys has them
  QString path;  ///< where it stands
};

/// A number of a summand.
struct FunctionNumber {
  QString path;  ///< where it stands, or would
  const case_::Key* row = nullptr;
  QString unit;  ///< in which a bare number of it is read
};

/// A function of time of a case that is being edited beside the case. What is not edited stays as it is written; the
/// case gets all of it at once, as one edit.
class FunctionEdit {
 public:
  /// @param path  of a value whose key takes functions: "stage[0].pressure[0].value"
  FunctionEdit(const Document& document, QString path);

  [[nodiscard]] static bool takes_functions(const case_::Key& key);
  [[nodiscard]] static const QStringList& kinds();
  /// Whether a function may have several summands of a kind, each with numbers of its own.
  [[nodiscard]] static bool may_be_several(const QString& kind);
  [[nodiscard]] const case_::Key& key() const { return *key_; }
  [[nodiscard]] const QString& path() const { return path_; }
  /// The text of the case as it is edited here.
  [[nodiscard]] const std::string& text() const { return places_.text(); }
  /// Gives the case what was edited.
  void give_to(Document& document) const;

  /// "x", "y", "z"; one without a name where the value has no direction.
  [[nodiscard]] const QStringList& components() const { return components_; }
  /// Whether a component may be missing: it is then not prescribed.
  [[nodiscard]] bool may_be_missing() const { return key_->type == case_::ValueType::axis_functions; }
  /// Whether its components can be distinguished in the text.
  [[nodiscard]] bool is_readable() const;
  [[nodiscard]] std::vector<FunctionPart> parts(int component) const;
  [[nodiscard]] std::vector<FunctionNumber> numbers(const FunctionPart& part) const;

  /// A component becomes one summand. What it has of a value is kept; its end is that of its stage.
  /// @param kind  empty: the component is taken out
  void choose(int component, const QString& kind);
  void add(int component, const QString& kind);
  void remove(int component, const FunctionPart& part);

  /// As people type a number.
  [[nodiscard]] QString number(const FunctionNumber& number) const;
  void set_number(const FunctionNumber& number, const QString& typed);

  /// Time and value of each point of a table, as people type them.
  using Row = std::array<QString, 2>;
  [[nodiscard]] std::vector<Row> points(const FunctionPart& table) const;
  void set_point(const FunctionPart& table, int row, int column, const QString& typed);
  void set_points(const FunctionPart& table, const std::vector<Row>& rows);
  /// Rows of a table that was copied elsewhere: two columns apart by comma, semicolon, tab or blanks. Of a head, the
  /// units in brackets are those of the numbers that have none.
  [[nodiscard]] static std::vector<Row> rows_of(const QString& csv);

  /// Problems that the solver's reader reports for the value.
  [[nodiscard]] std::vector<Problem> problems() const;
  /// Of each component over the run, as the solver reads it. Empty where it does not, and of one that is missing.
  [[nodiscard]] std::vector<PlotLine> curves() const;
  /// Ends of the stages, s, until one cannot be read.
  [[nodiscard]] std::vector<double> stage_ends() const;
  /// That the value belongs to, from 0.
  [[nodiscard]] int stage() const;

 private:
  struct Reading;
  [[nodiscard]] QString component_path(int component) const;
  [[nodiscard]] QString at(const QString& path) const;  ///< TOML text there
  void set(const QString& path, const QString& toml);
  [[nodiscard]] Reading read() const;
  /// TOML text of a new summand.
  [[nodiscard]] QString made(const QString& kind, const QString& value) const;
  /// TOML text of the value that a component has, or comes to.
  [[nodiscard]] QString value_of(int component) const;

  const case_::Key* key_;
  QString path_;
  std::string file_;
  TomlPlaces places_;
  QStringList components_;
};

}  // namespace breccia::gui
