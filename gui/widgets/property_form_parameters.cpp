#include <QGroupBox>
#include <QLineEdit>
#include <QTimer>

#include "core/value_text.hpp"
#include "widgets/property_form.hpp"

// The rows of mesh.parameters.

namespace breccia::gui {
namespace {

/// One of them is typed as any quantity is; what dimension it has, the geometry alone knows.
constexpr case_::Key kParameter{.path = "mesh.parameters.*", .type = case_::ValueType::number};

QString tip_of(const ParameterRow& row) {
  const auto line = [](const QString& name, const QString& text) {
    return text.isEmpty() ? QString() : QString("<br><i>%1</i> %2").arg(name, text.toHtmlEscaped());
  };
  const QString words = row.is_known ? row.words : PropertyForm::tr("The geometry has no such number.");
  return "<b>" + row.path().toHtmlEscaped() + "</b><br>" + words.toHtmlEscaped() +
         line(PropertyForm::tr("Unit:"), PropertyForm::tr("that in which the geometry counts; with a unit, in SI")) +
         line(PropertyForm::tr("Default:"), row.fallback);
}

}  // namespace

bool PropertyForm::holds_no_table(const case_::Key& key) const {
  const Place* place = document_.places().find(path_of(key).toStdString());
  return place != nullptr && place->kind == Place::Kind::value;
}

void PropertyForm::add_parameters(const case_::Key& key, QFormLayout& layout) {
  auto* box = new QGroupBox(tr("Numbers of the geometry"));
  box->setObjectName("field:" + path_of(key));
  box->setToolTip(tooltip_of(key));
  box->setAccessibleName(box->title());
  auto* rows = new QFormLayout(box);
  rows->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  for (const ParameterRow& row : parameter_rows_) add_parameter(row, *rows);
  if (parameter_rows_.empty()) {
    auto* none = new QLabel(parameters_ ? tr("This mesh has none that can be set.") : tr("Waiting for the solver..."));
    none->setWordWrap(true);
    rows->addRow(none);
  }
  const Field field{&key, box, new QLabel, box->title(), box->toolTip(), true};
  field.mark->setObjectName("mark:" + path_of(key));
  field.mark->hide();
  rows->addRow(field.mark);
  fields_.insert(path_of(key), field);
  layout.addRow(box);
}

void PropertyForm::add_parameter(const ParameterRow& row, QFormLayout& layout) {
  auto* cell = new QWidget;
  auto* cells = new QHBoxLayout(cell);
  cells->setContentsMargins(0, 0, 0, 0);
  Field field{&kParameter, line_of(kParameter, row.path()), new QLabel, row.name, tip_of(row), false};
  auto* line = qobject_cast<QLineEdit*>(field.editor);
  line->setPlaceholderText(row.fallback);
  line->setObjectName("parameter:" + row.name);
  line->setToolTip(field.tip);
  line->setAccessibleName(tr("Number of the geometry: %1").arg(row.name));
  line->setAccessibleDescription(row.words);
  cells->addWidget(line, 1);
  finish_row(row.path(), field, *cells);
  auto* label = new QLabel(row.name);
  label->setToolTip(field.tip);
  label->setBuddy(line);
  layout.addRow(label, cell);
}

void PropertyForm::set_parameters(const std::optional<std::vector<MeshParameter>>& parameters) {
  if (parameters_ == parameters) return;
  parameters_ = parameters;
  if (section_ == "mesh") show_again();
}

/// An edit comes from one of the rows, which must outlive it.
void PropertyForm::follow_parameters() {
  if (section_ != "mesh" || parameter_rows_ == parameter_rows(parameters_, document_.places())) return;
  QTimer::singleShot(0, this, [this] {
    if (section_ == "mesh" && parameter_rows_ != parameter_rows(parameters_, document_.places())) show_again();
  });
}

/// The field with the cursor keeps it, and what is being typed there.
void PropertyForm::show_again() {
  QString path, typed;
  const QWidget* cursor = window()->focusWidget();
  for (auto it = fields_.begin(); it != fields_.end(); ++it)
    if (cursor != nullptr && !it->is_box && (it->editor == cursor || it->editor->isAncestorOf(cursor))) path = it.key();
  const auto line_at = [this](const QString& of) {
    return fields_.contains(of) ? qobject_cast<QLineEdit*>(fields_[of].editor) : nullptr;
  };
  if (const QLineEdit* line = line_at(path)) typed = line->text();
  if (!path.isEmpty()) fields_[path].editor->blockSignals(true);  // it goes, and is not left
  show_section(section_);
  if (path.isEmpty()) return;
  if (fields_.contains(path)) fields_[path].editor->setFocus(Qt::OtherFocusReason);
  if (QLineEdit* line = line_at(path)) line->setText(typed);
}

}  // namespace breccia::gui
