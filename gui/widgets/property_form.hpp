#pragma once

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMap>
#include <QScrollArea>
#include <QToolButton>

#include "case/schema.hpp"
#include "core/document.hpp"

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
  /// Words that a group field offers.
  void set_groups(const QStringList& groups);
  /// A face was clicked on in the view. True: a field waits for it, and has taken the group that it can name: a surface
  /// for loads and constraints, where the face is in one, else the volume.
  bool take_pick(const QString& volume, const QStringList& surfaces);
  /// Puts the cursor into the field of a path, if it is here.
  void focus_field(const QString& path);
  /// Takes over what stands in the field with the cursor: keys and buttons that act on the case leave no field.
  void take_typed();

 signals:
  /// A field that names groups got one: the view shows it.
  void group_entered(const QString& group);
  /// A field waits, or waits no more, for a click in the view.
  void pick_wanted(bool on);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Field {
    const case_::Key* key = nullptr;
    QWidget* editor = nullptr;
    QLabel* mark = nullptr;
    QString label;
  };
  void add_field(const case_::Key& key, QFormLayout& layout);
  void add_picker(const QString& path, const QString& label, QHBoxLayout& cells);
  [[nodiscard]] QWidget* editor_of(const case_::Key& key, const QString& path);
  void take_over(const QString& path, const case_::Key& key, const QString& typed);
  void refresh();
  void mark_problems();
  [[nodiscard]] QString path_of(const case_::Key& key) const;

  Document& document_;
  QString section_;
  QMap<QString, Field> fields_;  // by path
  std::vector<Problem> problems_;
  QStringList groups_;
  QString picks_for_;  ///< path of the field that waits for a click
};

}  // namespace breccia::gui
