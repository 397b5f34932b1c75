#include "widgets/property_form.hpp"

#include <QDir>
#include <QEvent>
#include <QFileDialog>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSignalBlocker>
#include <algorithm>
#include <functional>

#include "core/case_outline.hpp"
#include "core/geometry_import.hpp"
#include "core/value_text.hpp"
#include "widgets/escape_key.hpp"
#include "widgets/function_dialog.hpp"
#include "widgets/group_box.hpp"

namespace breccia::gui {
namespace {

using case_::Key;
using case_::ValueType;

/// What the text of an editor is typed into; nullptr: it is chosen.
QLineEdit* line_in(QWidget* editor) {
  auto* box = qobject_cast<QComboBox*>(editor);
  return box != nullptr ? box->lineEdit() : qobject_cast<QLineEdit*>(editor);
}

/// Words to choose from; empty: the value is typed.
QStringList words_of(const Key& key) {
  if (key.type == ValueType::boolean) return {"true", "false"};
  const bool one = key.type == ValueType::choice || key.type == ValueType::integer;
  QStringList words;
  if (one)
    for (const std::string& word : key.choice_list()) words << QString::fromStdString(word);
  return words;
}

/// Names of groups and words that are not allowed may be of any length: the form does not grow with them.
void limit_width(QComboBox& box) {
  box.setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box.setMinimumContentsLength(8);
}

QFormLayout* new_form(QVBoxLayout& column) {
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->setRowWrapPolicy(QFormLayout::WrapLongRows);
  column.addLayout(form);
  return form;
}

bool stands_at(const std::string& key, const std::string& path) {
  return key == path || key.starts_with(path + "[") || key.starts_with(path + ".");
}

}  // namespace

PropertyForm::PropertyForm(Document& document, QWidget* parent) : QScrollArea(parent), document_(document) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setObjectName("property_form");
  setAccessibleName(tr("Properties"));
  setFocusPolicy(Qt::NoFocus);
  connect(&document_, &Document::changed, this, &PropertyForm::refresh);
}

QString PropertyForm::path_of(const Key& key) const {
  const QString name = text_of(key.name());
  return section_.isEmpty() ? name : section_ + "." + name;
}

void PropertyForm::show_section(const QString& path) {
  section_ = path;
  fields_.clear();
  if (!picks_for_.isEmpty()) {
    picks_for_.clear();
    emit pick_wanted(false);
  }
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  const std::string pattern = case_::pattern_of(path.toStdString());
  heading_ = new QLabel(page);
  heading_->setWordWrap(true);
  heading_->setObjectName("section_help");
  column->addWidget(heading_);
  QFormLayout* const form = new_form(*column);
  parameter_rows_ = parameter_rows(parameters_, document_.places());
  more_ = nullptr;
  const std::vector<const Key*> keys = keys_in(pattern);
  const auto comes_first = [&](const Key* key) {
    return key->level == case_::Level::basic || key->required || !document_.value(path_of(*key)).isEmpty();
  };
  const auto folded = std::count_if(keys.begin(), keys.end(), std::not_fn(comes_first));
  const bool folds = folded > 0 && folded < static_cast<std::ptrdiff_t>(keys.size());
  QFormLayout* const rest = folds ? add_folded_rows(*column, static_cast<int>(folded)) : form;
  for (const Key* key : keys) {
    QFormLayout& rows = comes_first(key) ? *form : *rest;
    const bool as_rows = key->type == ValueType::parameters && !holds_no_table(*key);
    as_rows ? add_parameters(*key, rows) : add_field(*key, rows);
  }
  column->addStretch();
  setWidget(page);  // deletes the one before
  refresh();
}

QFormLayout* PropertyForm::add_folded_rows(QVBoxLayout& column, int keys) {
  more_ = new QToolButton;
  more_->setObjectName("expert_keys");
  more_->setText(tr("%n more for experts", nullptr, keys));
  more_->setToolTip(tr("Keys that most cases leave at their defaults"));
  more_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  more_->setAutoRaise(true);
  more_->setCheckable(true);
  more_->setFocusPolicy(Qt::StrongFocus);
  folded_ = new QWidget;
  QToolButton* const more = more_;
  QWidget* const rows = folded_;
  const auto show = [more, rows](bool on) {
    more->setArrowType(on ? Qt::DownArrow : Qt::RightArrow);
    rows->setVisible(on);
  };
  column.addWidget(more_);
  column.addWidget(folded_);
  connect(more_, &QToolButton::toggled, this, show);
  connect(more_, &QToolButton::clicked, this, [this](bool on) { unfolded_ = on; });
  more_->setChecked(unfolded_);
  show(unfolded_);
  auto* inner = new QVBoxLayout(folded_);
  inner->setContentsMargins(0, 0, 0, 0);
  return new_form(*inner);
}

void PropertyForm::unfold_for(const QWidget* editor) {
  if (more_ != nullptr && folded_->isAncestorOf(editor)) more_->setChecked(true);
}

/// It names the entry, which an edit or an undo may have given another name.
void PropertyForm::write_heading() {
  if (heading_ == nullptr) return;
  const Key* section = case_::find_key(case_::pattern_of(section_.toStdString()));
  const QString words = section == nullptr ? tr("<b>The case</b>")
                                           : "<b>" + words_of(section_, document_.places()).toHtmlEscaped() + "</b>  " +
                                                 QString::fromStdString(case_::header_of(*section)).toHtmlEscaped() +
                                                 "<br>" + text_of(section->help).toHtmlEscaped();
  if (heading_->text() != words) heading_->setText(words);
}

void PropertyForm::add_field(const Key& key, QFormLayout& layout) {
  const QString path = path_of(key);
  auto* row = new QWidget;
  auto* cells = new QHBoxLayout(row);
  cells->setContentsMargins(0, 0, 0, 0);
  Field field;
  field.key = &key;
  field.editor = editor_of(key, path);
  field.mark = new QLabel;
  const QString symbol = symbol_of(key);
  field.label = label_of(key) + (symbol.isEmpty() ? "" : " " + symbol);
  const QString unit = key.unit == "1" ? QString() : " [" + shown_unit(text_of(key.unit)) + "]";
  field.label += unit;
  field.tip = tooltip_of(key);
  field.editor->setObjectName("field:" + path);
  field.editor->setToolTip(field.tip);
  field.editor->setAccessibleName(label_of(key) + unit);
  field.editor->setAccessibleDescription(text_of(key.help));
  cells->addWidget(field.editor, 1);
  if (group_kind(key) != GroupKind::none) add_picker(path, label_of(key), *cells);
  if (key.type == ValueType::path) add_browser(path, key, *cells);
  if (FunctionEdit::takes_functions(key)) add_function(path, label_of(key), *cells);
  finish_row(path, field, *cells);
  auto* label = new QLabel(field.label + (key.required ? " *" : ""));
  label->setToolTip(tooltip_of(key));
  label->setBuddy(field.editor);
  layout.addRow(label, row);
}

/// What every row has beside what its kind of value needs.
void PropertyForm::finish_row(const QString& path, const Field& field, QHBoxLayout& cells) {
  for (QObject* typed : {static_cast<QObject*>(field.editor), static_cast<QObject*>(line_in(field.editor))})
    if (typed != nullptr) typed->installEventFilter(this);
  if (line_in(field.editor) != nullptr) on_escape(*field.editor, [this] { refresh(); });
  cells.addWidget(field.mark);
  field.mark->setObjectName("mark:" + path);
  field.mark->hide();
  fields_.insert(path, field);
}

void PropertyForm::add_picker(const QString& path, const QString& label, QHBoxLayout& cells) {
  auto* pick = new QToolButton;
  pick->setText(tr("Pick"));
  pick->setCheckable(true);
  pick->setFocusPolicy(Qt::StrongFocus);
  pick->setObjectName("pick:" + path);
  pick->setAccessibleName(tr("Pick: %1").arg(label));
  pick->setToolTip(tr("Then click on a face or a body in the 3D view; once more ends it"));
  connect(pick, &QToolButton::toggled, this, [this, path](bool on) {
    if (!on && picks_for_ != path) return;
    for (auto* other : findChildren<QToolButton*>())
      if (on && other->isChecked() && other->objectName() != "pick:" + path) other->setChecked(false);
    picks_for_ = on ? path : QString();
    emit pick_wanted(on);
  });
  cells.addWidget(pick);
}

void PropertyForm::add_function(const QString& path, const QString& label, QHBoxLayout& cells) {
  auto* open = new QToolButton;
  open->setText(tr("f(t)..."));
  open->setFocusPolicy(Qt::StrongFocus);
  open->setObjectName("function:" + path);
  open->setAccessibleName(tr("Function of time: %1").arg(label));
  open->setToolTip(tr("Constant, linear, ramp, sine, table or the points of a file, with a chart of it"));
  connect(open, &QToolButton::clicked, this, [this, path] {
    auto* dialog = new FunctionDialog(document_, path, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
  });
  cells.addWidget(open);
}

void PropertyForm::add_browser(const QString& path, const Key& key, QHBoxLayout& cells) {
  auto* browse = new QToolButton;
  browse->setText(tr("Browse..."));
  browse->setFocusPolicy(Qt::StrongFocus);
  browse->setObjectName("browse:" + path);
  browse->setAccessibleName(tr("Browse: %1").arg(label_of(key)));
  browse->setToolTip(tr("Choose it among the files of this machine"));
  connect(browse, &QToolButton::clicked, this, [this, path, &key] {
    const QDir folder(document_.folder());
    const QString name =
        key.path == "start.from"
            ? QFileDialog::getExistingDirectory(this, tr("Run to start from"), folder.path())
            : QFileDialog::getOpenFileName(this, tr("Mesh or geometry"), folder.path(),
                                           tr("Geometries (%1);;All files (*)").arg(geometry_patterns(true).join(' ')));
    if (name.isEmpty()) return;
    const QString relative = folder.relativeFilePath(name);
    take_over(path, key, relative.startsWith("../..") ? name : relative);
  });
  cells.addWidget(browse);
}

bool PropertyForm::take_pick(const QString& volume, const QStringList& surfaces) {
  const QString path = picks_for_;
  if (path.isEmpty() || !fields_.contains(path)) return false;
  const Key& key = *fields_[path].key;
  const GroupKind kind = group_kind(key);
  if (kind == GroupKind::surface && surfaces.isEmpty()) return true;  // continues to wait
  const QString group = kind != GroupKind::volume && !surfaces.isEmpty() ? surfaces.first() : volume;
  const bool many = names_many_groups(key);
  if (auto* pick = findChild<QToolButton*>("pick:" + path); pick != nullptr && !many) pick->setChecked(false);
  take_group(path, key, group);
  return true;
}

/// A list that names several gets one more.
void PropertyForm::take_group(const QString& path, const Key& key, const QString& group) {
  const QString value = document_.value(path);
  const bool more = names_many_groups(key) || names_in(value).size() > 1;
  const QString one = group.contains(',') ? quoted(group) : group;
  take_over(path, key, more ? with_group(shown_value(key, value), group) : one);
  refresh();  // a box shows what was chosen, not the list
  emit group_entered(group);
}

QWidget* PropertyForm::editor_of(const Key& key, const QString& path) {
  const QStringList words = words_of(key);
  if (!words.isEmpty()) return box_of_words(key, path, words);
  const bool names_one = group_kind(key) != GroupKind::none && !names_many_groups(key);
  return names_one ? static_cast<QWidget*>(box_of_groups(key, path)) : line_of(key, path);
}

QComboBox* PropertyForm::box_of_words(const Key& key, const QString& path, const QStringList& words) {
  auto* box = new QComboBox;
  const QString fallback = shown_default(key);
  box->addItem(fallback.isEmpty() ? tr("(not given)") : tr("%1 (default)").arg(fallback), QString());
  for (const QString& word : words) box->addItem(word, word);
  box->setMinimumWidth(box->sizeHint().width());
  connect(box, qOverload<int>(&QComboBox::activated), this,
          [this, box, path, &key] { take_over(path, key, box->currentData().toString()); });
  limit_width(*box);
  return box;
}

QComboBox* PropertyForm::box_of_groups(const Key& key, const QString& path) {
  auto* box = new GroupBox;
  box->addItems(groups_of_kind(group_kind(key), document_.places(), groups_));
  connect(box->lineEdit(), &QLineEdit::editingFinished, this,
          [this, box, path, &key] { take_over(path, key, box->currentText()); });
  connect(box, qOverload<int>(&QComboBox::activated), this, [this, box, path, &key](int chosen) {
    if (box->takes_choice()) take_group(path, key, box->itemText(chosen));
  });
  limit_width(*box);
  return box;
}

QLineEdit* PropertyForm::line_of(const Key& key, const QString& path) {
  auto* line = new QLineEdit;
  const QString fallback = shown_default(key);
  line->setPlaceholderText(!fallback.isEmpty()   ? fallback
                           : key.example.empty() ? QString()
                                                 : tr("e.g. %1").arg(shown_value(key, text_of(key.example))));
  line->setClearButtonEnabled(false);
  connect(line, &QLineEdit::editingFinished, this, [this, line, path, &key] { take_over(path, key, line->text()); });
  return line;
}

void PropertyForm::take_over(const QString& path, const Key& key, const QString& typed) {
  const QString before = document_.value(path);
  if (typed.trimmed() == shown_value(key, before)) return;  // as it was: the way it is written stays
  const QString toml = typed_value(key, typed);
  if (is_mesh_parameter(path)) {
    set_parameter(document_, path, toml);
  } else if (toml.isEmpty()) {
    document_.remove(path);
  } else {
    document_.set_value(path, toml);
  }
}

void PropertyForm::take_typed() {
  if (!document_.is_open()) return;
  const QWidget* cursor = window()->focusWidget();
  for (auto it = fields_.begin(); it != fields_.end(); ++it) {
    QWidget* editor = it->editor;
    if (cursor == nullptr || it->is_box || (editor != cursor && !editor->isAncestorOf(cursor))) continue;
    const QLineEdit* line = line_in(editor);
    const Field field = *it;  // an edit may change the form
    const QString path = it.key();
    if (line != nullptr) take_over(path, *field.key, line->text());
    return;
  }
}

void PropertyForm::refresh() {
  write_heading();
  for (auto it = fields_.begin(); it != fields_.end(); ++it) {
    const QString shown = shown_value(*it->key, document_.value(it.key()));
    const QSignalBlocker quiet(it->editor);
    if (auto* line = qobject_cast<QLineEdit*>(it->editor)) {
      if (line->text() == shown) continue;
      line->setText(shown);
      if (!line->hasFocus()) line->setCursorPosition(0);  // of a long one the beginning is seen
    } else if (auto* box = qobject_cast<QComboBox*>(it->editor)) {
      if (box->isEditable()) {
        box->setEditText(shown);
      } else {
        int index = shown.isEmpty() ? 0 : box->findData(shown);
        if (index < 0) {
          box->addItem(shown, shown);
          index = box->count() - 1;
        }
        box->setCurrentIndex(index);
      }
    }
  }
  mark_problems();
  follow_parameters();
}

void PropertyForm::set_problems(const std::vector<Problem>& problems) {
  problems_ = problems;
  mark_problems();
}

void PropertyForm::set_groups(const std::optional<MeshGroups>& groups) {
  groups_ = groups;
  for (const Field& field : fields_) {
    auto* box = qobject_cast<QComboBox*>(field.editor);
    if (box == nullptr || !box->isEditable()) continue;
    const QString text = box->currentText();
    const QSignalBlocker quiet(box);
    box->clear();
    box->addItems(groups_of_kind(group_kind(*field.key), document_.places(), groups_));
    box->setEditText(text);
  }
}

void PropertyForm::mark_problems() {
  for (auto it = fields_.begin(); it != fields_.end(); ++it) {
    QString words;
    for (const Problem& p : problems_)
      if (it->is_box ? p.key == it.key().toStdString() : stands_at(p.key, it.key().toStdString()))
        words = QString::fromStdString(p.text());
    it->mark->setVisible(!words.isEmpty());
    if (!words.isEmpty()) unfold_for(it->editor);
    it->mark->setText(words.isEmpty() ? QString() : "⚠");
    it->mark->setToolTip(words);
    it->mark->setAccessibleName(words.isEmpty() ? QString() : tr("Problem: %1").arg(words));
    it->editor->setProperty("wrong", !words.isEmpty());
    if (!it->is_box) it->editor->setStyleSheet(words.isEmpty() ? QString() : "border: 2px solid #d03030;");
    it->editor->setToolTip(words.isEmpty() ? it->tip : "<b>" + words.toHtmlEscaped() + "</b><hr>" + it->tip);
  }
}

/// A style sheet keeps the colours that it met: a field with a problem would stay light in a dark window.
void PropertyForm::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange)
    for (const Field& field : fields_) {
      const QString style = field.editor->styleSheet();
      field.editor->setStyleSheet({});
      field.editor->setStyleSheet(style);
    }
  QScrollArea::changeEvent(event);
}

bool PropertyForm::holds_typed(const QObject* editor) const {
  for (auto it = fields_.begin(); it != fields_.end(); ++it) {
    const QLineEdit* line = line_in(it->editor);
    if (line != nullptr && (editor == it->editor || editor == line))
      return line->text().trimmed() != shown_value(*it->key, document_.value(it.key()));
  }
  return false;
}

/// A field takes the keys of undo and redo for the letters typed into it; where all of them are in the case, they are
/// those of the case.
bool PropertyForm::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && !holds_typed(watched)) {
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo)) {
      event->ignore();
      return true;
    }
  }
  return QScrollArea::eventFilter(watched, event);
}

void PropertyForm::focus_field(const QString& path) {
  for (auto it = fields_.begin(); it != fields_.end(); ++it) {
    if (it->is_box || !stands_at(path.toStdString(), it.key().toStdString())) continue;
    unfold_for(it->editor);
    ensureWidgetVisible(it->editor);
    it->editor->setFocus(Qt::OtherFocusReason);
  }
}

}  // namespace breccia::gui
