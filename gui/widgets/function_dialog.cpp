#include "widgets/function_dialog.hpp"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QGroupBox>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QShortcut>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "core/case_outline.hpp"
#include "core/value_text.hpp"
#include "widgets/named_button.hpp"

namespace breccia::gui {
namespace {

const case_::Key* key_of_kind(const QString& kind) {
  const std::string pattern = "<function>." + kind.toStdString();
  const case_::Key* key = case_::find_key(pattern);
  return key != nullptr ? key : case_::find_key(pattern + "[]");
}

}  // namespace

QString words_of_kind(const QString& kind) {
  if (kind == "constant") return FunctionDialog::tr("constant");
  if (kind == "linear") return FunctionDialog::tr("linear, from 0 at time 0");
  if (kind == "table") return FunctionDialog::tr("table of points");
  if (kind == "csv") return FunctionDialog::tr("points of a file (CSV)");
  if (kind == "ramp") return FunctionDialog::tr("ramp");
  return kind == "sine" ? FunctionDialog::tr("sine") : kind;
}

FunctionDialog::FunctionDialog(Document& document, const QString& path, QWidget* parent)
    : QDialog(parent),
      document_(document),
      edit_(document, path),
      component_(new QComboBox),
      kind_(new QComboBox),
      add_(named_button(tr("&Add a part"), "function_add", tr("The parts of a function add up"))),
      area_(new QScrollArea),
      chart_(new LineChart),
      words_(new QLabel) {
  setObjectName("function_dialog");
  setWindowTitle(tr("Function of time: %1").arg(words_of(path, document.places())));
  auto* column = new QVBoxLayout(this);
  auto* help = new QLabel(text_of(edit_.key().help));
  help->setWordWrap(true);
  column->addWidget(help);
  auto* head = new QFormLayout;
  make_head(*head);
  column->addLayout(head);
  area_->setWidgetResizable(true);
  area_->setFrameShape(QFrame::NoFrame);
  area_->setFocusPolicy(Qt::NoFocus);
  column->addWidget(area_, 3);
  chart_->setObjectName("function_chart");
  chart_->setAccessibleName(tr("The function over the run"));
  chart_->setToolTip(tr("As the solver reads it, over the whole run; dashed: ends of the stages"));
  column->addWidget(chart_, 2);
  words_->setObjectName("function_problem");
  words_->setWordWrap(true);
  words_->setTextFormat(Qt::PlainText);
  column->addWidget(words_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setToolTip(tr("Into the case, as one edit that can be undone"));
  buttons->button(QDialogButtonBox::Cancel)->setToolTip(tr("The case stays as it was"));
  for (QAbstractButton* button : buttons->buttons()) button->setAccessibleName(button->text().remove('&'));
  connect(buttons, &QDialogButtonBox::accepted, this, &FunctionDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &FunctionDialog::reject);
  column->addWidget(buttons);
  buttons->button(QDialogButtonBox::Ok)->setDefault(true);  // not the first of the parts
  resize(620, 640);
  show_parts();
}

void FunctionDialog::make_head(QFormLayout& head) {
  component_->setObjectName("function_component");
  component_->setAccessibleName(tr("Axis"));
  component_->setToolTip(tr("Each axis has a function of its own"));
  component_->addItems(edit_.components());
  kind_->setObjectName("function_kind");
  kind_->setAccessibleName(tr("Kind of function"));
  kind_->setToolTip(tr("Shape of the value over time; the present value is kept"));
  auto* axis = new QLabel(tr("A&xis"));
  axis->setBuddy(component_);
  if (component_->count() > 1) {
    head.addRow(axis, component_);
  } else {
    for (QWidget* unused : {static_cast<QWidget*>(axis), static_cast<QWidget*>(component_)}) {
      unused->setParent(this);
      unused->hide();
    }
  }
  auto* cells = new QHBoxLayout;
  cells->addWidget(kind_, 1);
  cells->addWidget(add_);
  auto* label = new QLabel(tr("&Kind"));
  label->setBuddy(kind_);
  head.addRow(label, cells);
  auto* menu = new QMenu(add_);
  for (const QString& kind : FunctionEdit::kinds())
    menu->addAction(words_of_kind(kind), this,
                    [this, kind] {
                      edit_.add(component(), kind);
                      show_parts();
                    })
        ->setObjectName("add:" + kind);
  add_->setMenu(menu);
  connect(component_, qOverload<int>(&QComboBox::activated), this, [this] { show_parts(); });
  connect(kind_, qOverload<int>(&QComboBox::activated), this, [this] {
    const QVariant kind = kind_->currentData();
    if (!kind.isValid()) return;
    edit_.choose(component(), kind.toString());
    show_parts();
  });
}

/// A sum of several stands in the list only while it is one.
void FunctionDialog::show_kind() {
  const std::vector<FunctionPart> parts = edit_.parts(component());
  const QSignalBlocker quiet(kind_);
  kind_->clear();
  if (edit_.may_be_missing()) kind_->addItem(tr("not prescribed"), QString());
  for (const QString& kind : FunctionEdit::kinds()) kind_->addItem(words_of_kind(kind), kind);
  if (parts.size() > 1) kind_->addItem(tr("sum of %1 parts").arg(parts.size()));
  kind_->setCurrentIndex(parts.size() > 1 ? kind_->count() - 1
                                          : kind_->findData(parts.empty() ? QString("") : parts.front().kind));
  kind_->setEnabled(edit_.is_readable());
  add_->setEnabled(edit_.is_readable());
  for (QAction* action : add_->menu()->actions()) {
    const QString kind = action->objectName().section(':', 1);
    const bool is_there = std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return part.kind == kind; });
    action->setEnabled(FunctionEdit::may_be_several(kind) || !is_there);
  }
}

void FunctionDialog::show_parts() {
  show_kind();
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  const std::vector<FunctionPart> parts = edit_.parts(component());
  for (const FunctionPart& part : parts) column->addWidget(box_of(part, parts.size() == 1));
  column->addStretch();
  if (QWidget* before = area_->takeWidget(); before != nullptr)
    before->deleteLater();  // one of its buttons may be in hand
  area_->setWidget(page);
  show_curves();
}

QWidget* FunctionDialog::box_of(const FunctionPart& part, bool alone) {
  auto* box = new QGroupBox(words_of_kind(part.kind));
  auto* form = new QFormLayout(box);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  if (const case_::Key* key = key_of_kind(part.kind); key != nullptr) {
    box->setToolTip(text_of(key->help));
    box->setAccessibleDescription(text_of(key->help));
  }
  if (part.kind == "table") {
    add_table(part, *form);
  } else {
    for (const FunctionNumber& number : edit_.numbers(part)) add_number(part, number, *form);
  }
  if (alone) return box;
  auto* remove = named_button(tr("Remove this part"), "remove:" + part.path, tr("Takes it out of the sum"));
  connect(remove, &QPushButton::clicked, this, [this, part] {
    edit_.remove(component(), part);
    show_parts();
  });
  form->addRow(remove);
  return box;
}

void FunctionDialog::add_number(const FunctionPart& part, const FunctionNumber& number, QFormLayout& form) {
  auto* line = new QLineEdit(edit_.number(number));
  const QString name = part.kind == "linear"     ? tr("Growth")
                       : part.kind == "constant" ? tr("Value")
                                                 : label_of(*number.row);
  const bool has_unit = number.row->type == case_::ValueType::number && number.unit != "1";
  const QString label = has_unit ? QString("%1 [%2]").arg(name, shown_unit(number.unit)) : name;
  line->setObjectName("number:" + number.path);
  line->setAccessibleName(label);
  line->setAccessibleDescription(text_of(number.row->help));
  line->setPlaceholderText(number.row->required ? tr("must be given") : shown_default(*number.row));
  const QString fallback = number.row->required ? tr("none, must be given") : shown_default(*number.row);
  line->setToolTip(has_unit ? tr("%1 Unit: %2; others are typed behind the number. Default: %3")
                                  .arg(text_of(number.row->help), shown_unit(number.unit), fallback)
                            : tr("%1 Default: %2").arg(text_of(number.row->help), fallback));
  connect(line, &QLineEdit::editingFinished, this, [this, line, number] {
    edit_.set_number(number, line->text());
    show_curves();
  });
  auto* words = new QLabel(label + (number.row->required ? " *" : ""));
  words->setToolTip(line->toolTip());
  words->setBuddy(line);
  form.addRow(words, line);
}

QTableWidget* FunctionDialog::table_of(const FunctionPart& part) {
  auto* table = new QTableWidget(0, 2);
  table->setObjectName("points");
  table->setAccessibleName(tr("Points of the table"));
  table->setToolTip(tr("Time and value of each point; Ctrl+V puts a table in their place"));
  table->setHorizontalHeaderLabels(
      {tr("time [s]"), tr("value [%1]").arg(shown_unit(edit_.numbers(part).front().unit))});
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table->verticalHeader()->hide();
  table->setTabKeyNavigation(false);
  const std::vector<FunctionEdit::Row> rows = edit_.points(part);
  table->setRowCount(static_cast<int>(rows.size()));
  for (int r = 0; r < table->rowCount(); ++r)
    for (int c = 0; c < 2; ++c)
      table->setItem(r, c, new QTableWidgetItem(rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)]));
  connect(table, &QTableWidget::itemChanged, this, [this, part](const QTableWidgetItem* item) {
    edit_.set_point(part, item->row(), item->column(), item->text());
    show_curves();
  });
  return table;
}

void FunctionDialog::add_table(const FunctionPart& part, QFormLayout& form) {
  QTableWidget* table = table_of(part);
  form.addRow(table);
  auto* row = new QHBoxLayout;
  const auto button = [&](const QString& text, const QString& name, const QString& tip) {
    QPushButton* made = named_button(text, name, tip);
    row->addWidget(made);
    return made;
  };
  QPushButton* add = button(tr("Add &point"), "point_add", tr("A copy of the chosen point, behind it"));
  QPushButton* remove = button(tr("&Remove point"), "point_remove", tr("Takes the chosen point out"));
  QPushButton* paste_it = button(tr("Pa&ste"), "points_paste",
                                 tr("Puts a copied table (CSV, two columns: time and value) in place of the points"));
  form.addRow(row);
  const auto chosen = [table] { return table->currentRow() < 0 ? table->rowCount() - 1 : table->currentRow(); };
  connect(add, &QPushButton::clicked, this, [this, part, chosen] {
    std::vector<FunctionEdit::Row> rows = edit_.points(part);
    const FunctionEdit::Row copy =
        rows.empty() ? FunctionEdit::Row{"0", "0"} : rows[static_cast<std::size_t>(chosen())];
    rows.insert(rows.begin() + (rows.empty() ? 0 : chosen() + 1), copy);
    edit_.set_points(part, rows);
    show_parts();
  });
  connect(remove, &QPushButton::clicked, this, [this, part, chosen] {
    std::vector<FunctionEdit::Row> rows = edit_.points(part);
    if (rows.empty()) return;
    rows.erase(rows.begin() + chosen());
    edit_.set_points(part, rows);
    show_parts();
  });
  connect(paste_it, &QPushButton::clicked, this, [this, part] { paste(part); });
  auto* keys = new QShortcut(QKeySequence::Paste, table, nullptr, nullptr, Qt::WidgetShortcut);
  connect(keys, &QShortcut::activated, this, [this, part] { paste(part); });
}

void FunctionDialog::paste(const FunctionPart& part) {
  const std::vector<FunctionEdit::Row> rows = FunctionEdit::rows_of(QGuiApplication::clipboard()->text());
  if (rows.empty()) {
    words_->setText("⚠ " + tr("The clipboard holds no table of two columns: time and value."));
    return;
  }
  edit_.set_points(part, rows);
  show_parts();
}

void FunctionDialog::show_curves() {
  QStringList words;
  for (Problem p : edit_.problems()) {
    p.file.clear();
    words << "⚠ " + QString::fromStdString(p.text());
  }
  if (!edit_.is_readable()) words << tr("It is written in a way that can only be edited in the text.");
  words_->setText(words.join('\n'));
  std::vector<ChartMark> marks;
  const std::vector<double> ends = edit_.stage_ends();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool own = static_cast<int>(i) == edit_.stage();
    marks.push_back({ends[i], own ? tr("end of its stage") : tr("end of stage %1").arg(i + 1)});
  }
  chart_->set_marks(std::move(marks));
  chart_->show_lines(edit_.curves(), tr("time [s]"),
                     QString("%1 [%2]").arg(label_of(edit_.key()), text_of(edit_.key().unit)));
}

void FunctionDialog::accept() {
  edit_.give_to(document_);
  QDialog::accept();
}

}  // namespace breccia::gui
