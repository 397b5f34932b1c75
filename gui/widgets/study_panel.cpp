#include "widgets/study_panel.hpp"

#include <QCompleter>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QtConcurrent>
#include <algorithm>

#include "core/value_text.hpp"
#include "widgets/named_button.hpp"

namespace breccia::gui {
namespace {

constexpr int kUpdateInterval = 2000;  // ms
const QString kFirstColumn = "broken joints";
constexpr int kWidestBox = 300;  // pixels

/// Gives it room for its words. Qt does not work out the least width of a box anew when words are added.
void fit(QComboBox& box) { box.setMinimumWidth(std::min(kWidestBox, box.sizeHint().width())); }

/// Start of a study, which distinguishes those of one case.
QString words_of_study(const QString& folder) {
  static const QRegularExpression started(R"((\d{4})(\d\d)(\d\d)-(\d\d)(\d\d)(\d\d)(-\d+)?-study$)");
  const QString name = QFileInfo(folder).fileName();
  const QRegularExpressionMatch at = started.match(name);
  if (!at.hasMatch()) return name;
  return QString("%1-%2-%3 %4:%5:%6%7")
      .arg(at.captured(1), at.captured(2), at.captured(3), at.captured(4), at.captured(5), at.captured(6),
           at.captured(7));
}

}  // namespace

StudyPanel::StudyPanel(const Document& document, const RunQueue& queue, QWidget* parent)
    : QWidget(parent), document_(document), queue_(queue) {
  setObjectName("study");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2, 2, 2, 2);
  auto *setup = new QVBoxLayout, *results = new QVBoxLayout;
  make_setup(*setup);
  make_results(*results);
  chart_ = new LineChart;
  chart_->setObjectName("study_chart");
  chart_->setAccessibleName(tr("Plot of the study"));
  chart_->setToolTip(tr("The chosen result over the first key, a line for each value of the second one"));
  row->addLayout(setup, 2);
  row->addLayout(results, 3);
  row->addWidget(chart_, 4);
  connect(&timer_, &QTimer::timeout, this, &StudyPanel::look);
  connect(&reader_, &QFutureWatcher<std::vector<StudyResult>>::finished, this, &StudyPanel::take_results);
  timer_.start(kUpdateInterval);
  connect(&document_, &Document::changed, this, [this] {
    if (isVisible()) fill_keys();
  });
  count_runs();
}

void StudyPanel::make_setup(QVBoxLayout& column) {
  auto* form = new QFormLayout;
  const QStringList names{tr("Key"), tr("Second key")};
  for (int i = 0; i < 2; ++i) {
    keys_[i] = new QComboBox;
    keys_[i]->setEditable(true);
    keys_[i]->setInsertPolicy(QComboBox::NoInsert);
    keys_[i]->completer()->setCompletionMode(QCompleter::PopupCompletion);
    keys_[i]->completer()->setFilterMode(Qt::MatchContains);
    keys_[i]->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    keys_[i]->setMinimumContentsLength(22);
    keys_[i]->setObjectName(QString("study_key_%1").arg(i + 1));
    keys_[i]->setAccessibleName(names[i]);
    keys_[i]->lineEdit()->setAccessibleName(names[i]);  // which has the focus
    keys_[i]->setToolTip(
        tr("A key of the case such as material[0].young, a number of the geometry such as mesh.parameters.h, or ranks; "
           "empty: none"));
    values_[i] = new QLineEdit;
    values_[i]->setObjectName(QString("study_values_%1").arg(i + 1));
    values_[i]->setAccessibleName(tr("Values of %1").arg(names[i]));
    values_[i]->setToolTip(tr("Values with their units, a semicolon between them: 70 GPa; 75 GPa"));
    values_[i]->setPlaceholderText(tr("e.g. 70 GPa; 75 GPa"));
    form->addRow(names[i], keys_[i]);
    form->addRow(tr("Values"), values_[i]);
    connect(keys_[i], &QComboBox::editTextChanged, this, &StudyPanel::take_edit);
    connect(values_[i], &QLineEdit::textChanged, this, &StudyPanel::take_edit);
  }
  start_ = named_button(tr("Add to the queue"), "study_start",
                        tr("Queue a run of the present case for every combination of the values"));
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setObjectName("study_words");
  column.addLayout(form);
  column.addWidget(start_, 0, Qt::AlignLeft);
  column.addWidget(words_);
  column.addStretch();
  connect(start_, &QPushButton::clicked, this, [this] { emit start_wanted(parameters()); });
}

void StudyPanel::make_results(QVBoxLayout& column) {
  studies_ = new QComboBox;
  studies_->setObjectName("studies");
  studies_->setAccessibleName(tr("Study"));
  studies_->setToolTip(tr("Studies of this case, the latest first"));
  studies_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  studies_->setMaximumWidth(kWidestBox);
  column_ = new QComboBox;
  column_->setObjectName("study_column");
  column_->setAccessibleName(tr("Result"));
  column_->setToolTip(tr("Quantity of the plot and the last column, with its unit, at the end of each run"));
  column_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  column_->setMaximumWidth(kWidestBox);
  export_ = named_button(tr("Export CSV..."), "study_export", tr("All results of all runs as one table"));
  table_ = new QTableWidget;
  table_->setObjectName("study_table");
  table_->setAccessibleName(tr("Runs of the study"));
  table_->setToolTip(tr("The runs of the study; Enter or a double click opens the results of one"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setTabKeyNavigation(false);
  table_->verticalHeader()->hide();
  // Two rows: in one the words of the plot beside it are cut at 1280 pixels.
  auto* choice = new QFormLayout;
  auto* row = new QHBoxLayout;
  row->addWidget(column_, 1);
  row->addWidget(export_);
  choice->addRow(tr("Study"), studies_);
  choice->addRow(tr("Result"), row);
  static_cast<QLabel*>(choice->labelForField(row))->setBuddy(column_);
  column.addLayout(choice);
  column.addWidget(table_, 1);
  connect(studies_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this] { show_study(studies_->currentData().toString()); });
  connect(column_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    show_table();
    show_plot();
  });
  connect(export_, &QPushButton::clicked, this, &StudyPanel::export_wanted);
  connect(table_, &QTableWidget::cellActivated, this, [this](int chosen, int) {
    if (study_) emit run_chosen(study_->runs[static_cast<std::size_t>(chosen)].folder);
  });
}

std::vector<StudyParameter> StudyPanel::parameters() const {
  std::vector<StudyParameter> list;
  for (int i = 0; i < 2; ++i)
    if (const QString key = keys_[i]->currentText().trimmed(); !key.isEmpty())
      list.push_back({key, study_values(values_[i]->text())});
  return list;
}

/// What was wrong with the study was wrong with what stood there before.
void StudyPanel::take_edit() {
  words_->clear();
  count_runs();
}

void StudyPanel::count_runs() {
  qsizetype runs = 1;
  const std::vector<StudyParameter> list = parameters();
  for (const StudyParameter& p : list) runs *= p.values.size();
  if (list.empty()) runs = 0;
  start_->setEnabled(runs > 0);
  start_->setText(runs > 0 ? tr("Add %1 to the queue").arg(counted(static_cast<double>(runs), tr("run"), tr("runs")))
                           : tr("Add to the queue"));
  start_->setAccessibleName(start_->text());
}

void StudyPanel::fill_keys() {
  const QStringList list = QStringList(QString()) + study_keys(document_);
  for (QComboBox* box : keys_) {
    const QString text = box->currentText();
    const QSignalBlocker quiet(box);
    box->clear();
    box->addItems(list);
    box->setEditText(text);
  }
}

void StudyPanel::showEvent(QShowEvent* event) {
  fill_keys();
  look();
  QWidget::showEvent(event);
}

void StudyPanel::show_problems(const QStringList& problems) { words_->setText(problems.join("\n")); }

void StudyPanel::set_studies(const QStringList& folders) {
  const QSignalBlocker quiet(studies_);
  studies_->clear();
  for (const QString& folder : folders) {
    studies_->addItem(words_of_study(folder), folder);
    studies_->setItemData(studies_->count() - 1, folder, Qt::ToolTipRole);
  }
  fit(*studies_);
  show_study(folders.isEmpty() ? QString() : folders.front());
}

void StudyPanel::show_study(const QString& folder) {
  study_ = folder.isEmpty() ? std::optional<Study>() : load_study(folder);
  results_.clear();
  if (study_) results_.resize(study_->runs.size());
  export_->setEnabled(study_.has_value());
  show_table();
  show_plot();
  look();
}

/// Results are read beside: a study may have hundreds of runs.
void StudyPanel::look() {
  if (!study_ || !isVisible() || reader_.isRunning()) return;
  read_folder_ = study_->folder;
  reader_.setFuture(
      QtConcurrent::run([study = *study_, queue = queue_.load()] { return study_results(study, queue); }));
}

void StudyPanel::take_results() {
  if (!study_ || study_->folder != read_folder_) return look();
  results_ = reader_.result();
  QStringList columns;
  for (const StudyResult& result : results_) columns += result.columns;
  columns.removeDuplicates();
  if (columns.size() != column_->count()) {
    const QSignalBlocker quiet(column_);
    const QString chosen = column_->count() == 0 ? kFirstColumn : column_->currentText();
    column_->clear();
    column_->addItems(columns);
    fit(*column_);
    column_->setCurrentIndex(std::max(0, static_cast<int>(columns.indexOf(chosen))));
  }
  show_table();
  show_plot();
}

void StudyPanel::show_table() {
  const int parameters = study_ ? static_cast<int>(study_->parameters.size()) : 0;
  QStringList head;
  for (int p = 0; p < parameters; ++p) head << study_->parameters[static_cast<std::size_t>(p)].name();
  head << tr("state") << column_->currentText();
  table_->setColumnCount(static_cast<int>(head.size()));
  table_->setHorizontalHeaderLabels(head);
  table_->setRowCount(static_cast<int>(results_.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const StudyResult& result = results_[static_cast<std::size_t>(row)];
    QStringList cells = study_->runs[static_cast<std::size_t>(row)].values;
    const std::optional<double> value = result.value(column_->currentText());
    cells << result.state << (value ? QString::number(*value, 'g', 6) : QString());
    for (int c = 0; c < cells.size(); ++c) {
      if (table_->item(row, c) == nullptr) table_->setItem(row, c, new QTableWidgetItem);
      table_->item(row, c)->setText(cells[c]);
    }
  }
  table_->resizeColumnsToContents();
}

void StudyPanel::show_plot() {
  if (!study_) return chart_->show_lines({}, {}, {});
  StudyPlot plot = study_plot(*study_, results_, column_->currentText());
  chart_->show_lines(std::move(plot.lines), plot.x_title, column_->currentText(), plot.x_words);
}

}  // namespace breccia::gui
