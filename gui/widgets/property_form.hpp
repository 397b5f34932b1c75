#pragma once

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMap>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

#include "case/schema.hpp"
#include "core/document.hpp"
#include "core/group_names.hpp"
#include "core/mesh_parameters.hpp"

namespace breccia::gui {

/// The form of one section of the case, made from the table of keys: label, field, mark of what is wrong. A value that
/// the case does not give is an empty field with the default in grey.
class PropertyForm final : public QScrollArea {
  Q_OBJECT
 public:
  explicit PropertyForm(Document& document, QWidget* parent = nullptr);

  /// @param path  "material[0]", "mesh"; "" the top
  void show_section(const QString& path);
  [[nodiscard]] const QString& section() const { return section_; }
  void set_problems(const std::vector<Problem>& problems);
  /// What fields that name groups offer.
  void set_groups(const std::optional<MeshGroups>& groups);
  /// Parameters of the geometry for mesh.parameters; none: not reported yet.
  void set_parameters(const std::optional<std::vector<MeshParameter>>& parameters);
  /// A face was clicked on in the view. True: a field waits for it, and has taken the group that it can name, a surface
  /// before a volume where both can be. A list gets one more, and continues to wait.
  bool take_pick(const QString& volume, const QStringList& surfaces);
  /// Puts the cursor into the field of a path, if it is here.
  void focus_field(const QString& path);
  /// Commits the text of the focused field: keys and buttons that act on the case do not move the focus.
  void take_typed();

 signals:
  /// A field that names groups got one: the view shows it.
  void group_entered(const QString& group);
  /// A field waits, or waits no more, for a click in the view.
  void pick_wanted(bool on);

 protected:
  void changeEvent(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Field {
    const case_::Key* key = nullptr;
    QWidget* editor = nullptr;
    QLabel* mark = nullptr;
    QString label, tip;
    bool is_box = false;  ///< around fields of its own
  };
  void add_field(const case_::Key& key, QFormLayout& layout);
  /// A box with a row for each number of the geometry, in place of one field for the table of all of them.
  void add_parameters(const case_::Key& key, QFormLayout& layout);
  void add_parameter(const ParameterRow& row, QFormLayout& layout);
  /// Where the numbers of the geometry or of the case are others than those of the rows.
  void follow_parameters();
  void show_again();
  /// A button and, below it, the rows for experts, which it shows.
  [[nodiscard]] QFormLayout* add_folded_rows(QVBoxLayout& column, int keys);
  /// A field that is folded away is shown.
  void unfold_for(const QWidget* editor);
  void finish_row(const QString& path, const Field& field, QHBoxLayout& cells);
  /// What stands at a key of a table is none.
  [[nodiscard]] bool holds_no_table(const case_::Key& key) const;
  void add_picker(const QString& path, const QString& label, QHBoxLayout& cells);
  void add_function(const QString& path, const QString& label, QHBoxLayout& cells);
  void add_browser(const QString& path, const case_::Key& key, QHBoxLayout& cells);
  [[nodiscard]] QWidget* editor_of(const case_::Key& key, const QString& path);
  [[nodiscard]] QComboBox* box_of_words(const case_::Key& key, const QString& path, const QStringList& words);
  [[nodiscard]] QComboBox* box_of_groups(const case_::Key& key, const QString& path);
  [[nodiscard]] QLineEdit* line_of(const case_::Key& key, const QString& path);
  /// Something is typed there that the case does not have yet.
  [[nodiscard]] bool holds_typed(const QObject* editor) const;
  void take_over(const QString& path, const case_::Key& key, const QString& typed);
  void take_group(const QString& path, const case_::Key& key, const QString& group);
  void refresh();
  void write_heading();
  void mark_problems();
  [[nodiscard]] QString path_of(const case_::Key& key) const;

  Document& document_;
  QString section_;
  QLabel* heading_ = nullptr;
  QMap<QString, Field> fields_;  // by path
  std::vector<Problem> problems_;
  std::optional<MeshGroups> groups_;
  std::optional<std::vector<MeshParameter>> parameters_;
  std::vector<ParameterRow> parameter_rows_;  ///< that are shown
  QString picks_for_;                         ///< path of the field that waits for a click
  QToolButton* more_ = nullptr;               ///< shows the fields for experts; nullptr: there are none
  QWidget* folded_ = nullptr;                 ///< around these fields
  bool unfolded_ = false;                     ///< as the user left the button, for the next section too
};

}  // namespace breccia::gui
