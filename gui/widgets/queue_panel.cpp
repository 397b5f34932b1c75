#include "widgets/queue_panel.hpp"

#include <QFileInfo>
#include <QHeaderView>
#include <QProgressBar>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/named_button.hpp"
#include "widgets/run_panel.hpp"

namespace breccia::gui {
namespace {

constexpr int kUpdateInterval = 1000;  // ms
constexpr int kProgress = 2;           // column
constexpr int kWhole = 1000;           // of a bar
constexpr qint64 kStarting = 5000;     // ms that a worker needs at most before it holds its lock

}  // namespace

QueuePanel::QueuePanel(const RunQueue& queue, QWidget* parent)
    : QWidget(parent),
      queue_(queue),
      table_(new QTableWidget),
      earlier_(named_button(tr("Ear&lier"), "queue_earlier", tr("Before the run above it"))),
      later_(named_button(tr("L&ater"), "queue_later", tr("After the run below it"))),
      stop_(named_button(tr("Stop"), "queue_stop", tr("End this run after its present step; the next one follows"))),
      remove_(named_button(tr("Re&move"), "queue_remove", tr("Take a run that waits or has ended off this list"))),
      clear_(named_button(tr("Clear ended"), "queue_clear", tr("Take all runs that have ended off this list"))),
      cores_(new QSpinBox),
      held_(new QCheckBox(tr("Hol&d"))),
      why_(new QLabel) {
  setObjectName("queue");
  make_table();
  auto* row = new QHBoxLayout;
  make_buttons(*row);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  column->addWidget(table_, 1);
  why_->setObjectName("queue_why");
  why_->setWordWrap(true);
  why_->setTextFormat(Qt::PlainText);
  why_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(why_);
  column->addLayout(row);
  connect(&timer_, &QTimer::timeout, this, &QueuePanel::look);
  timer_.start(kUpdateInterval);
  contents_ = queue_.load();
  show_contents();
}

void QueuePanel::make_table() {
  table_->setObjectName("queue_table");
  table_->setAccessibleName(tr("Queue of runs"));
  table_->setToolTip(
      tr("Runs start in this order as cores become free, also while no window is open; Enter or a double click shows "
         "a run that has started"));
  table_->setColumnCount(6);
  table_->setHorizontalHeaderLabels({tr("run"), tr("state"), tr("progress"), tr("ranks"), tr("case"), tr("folder")});
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setTabKeyNavigation(false);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setStretchLastSection(true);
  connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
    show_buttons();
    show_why();
  });
  connect(table_, &QTableWidget::cellActivated, this, [this] {
    if (const QueuedRun* run = chosen(); run != nullptr && !run->waits()) emit run_chosen(run->record.folder);
  });
}

void QueuePanel::make_buttons(QHBoxLayout& row) {
  for (QPushButton* b : {earlier_, later_, stop_, remove_, clear_}) row.addWidget(b);
  row.addStretch();
  cores_->setRange(1, 4096);
  cores_->setObjectName("queue_cores");
  cores_->setAccessibleName(tr("Cores for runs"));
  cores_->setToolTip(tr("Largest number of ranks in use, runs started by hand included; 1: one run after another"));
  held_->setObjectName("queue_hold");
  held_->setAccessibleName(tr("Hold the queue"));
  held_->setToolTip(tr("No further runs are started; those in progress continue"));
  auto* label = new QLabel(tr("C&ores"));
  label->setBuddy(cores_);
  row.addWidget(label);
  row.addWidget(cores_);
  row.addWidget(held_);
  connect(earlier_, &QPushButton::clicked, this, [this] { move(-1); });
  connect(later_, &QPushButton::clicked, this, [this] { move(1); });
  connect(remove_, &QPushButton::clicked, this, [this] {
    if (const QueuedRun* run = chosen(); run != nullptr) changed_with(queue_.remove(run->record.folder));
  });
  connect(stop_, &QPushButton::clicked, this, [this] {
    if (const QueuedRun* run = chosen(); run != nullptr)
      emit stop_wanted(QString(run->record.folder));  // a copy: the list is read anew
  });
  connect(clear_, &QPushButton::clicked, this, [this] { changed_with(queue_.remove_ended()); });
  connect(cores_, qOverload<int>(&QSpinBox::valueChanged), this, [this](int n) { changed_with(queue_.set_cores(n)); });
  connect(held_, &QCheckBox::toggled, this, [this](bool on) { changed_with(queue_.hold(on)); });
}

const QueuedRun* QueuePanel::chosen() const {
  const int row = table_->currentRow();
  return row >= 0 && row < static_cast<int>(contents_.runs.size()) ? &contents_.runs[static_cast<std::size_t>(row)]
                                                                   : nullptr;
}

void QueuePanel::changed_with(const QString& error) {
  emit change_tried(error);
  if (!error.isEmpty()) show_contents();
  look();
}

void QueuePanel::move(int by) {
  const QueuedRun* run = chosen();
  if (run == nullptr) return;
  const QString folder = run->record.folder;
  changed_with(queue_.move(folder, by));
  for (int row = 0; row < table_->rowCount(); ++row)
    if (contents_.runs[static_cast<std::size_t>(row)].record.folder == folder) table_->setCurrentCell(row, 0);
}

void QueuePanel::look() {
  if (const QByteArray mark = queue_.mark(); mark != mark_) {
    mark_ = mark;
    contents_ = queue_.load();
    show_contents();
    emit changed();
  } else {
    show_progress();
  }
  const bool just_started = since_worker_.isValid() && since_worker_.elapsed() < kStarting;
  if (contents_.runs.empty() || just_started || !queue_.wants_worker()) return;
  since_worker_.start();
  emit worker_wanted();
}

void QueuePanel::show_contents() {
  const QSignalBlocker quiet_cores(cores_), quiet_held(held_);
  cores_->setValue(contents_.cores);
  held_->setChecked(contents_.held);
  table_->setRowCount(static_cast<int>(contents_.runs.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const QueuedRun& run = contents_.runs[static_cast<std::size_t>(row)];
    const QStringList cells{
        run.words,        run.state, {}, QString::number(run.record.ranks), QFileInfo(run.record.case_file).fileName(),
        run.record.folder};
    for (int c = 0; c < cells.size(); ++c) {
      if (table_->item(row, c) == nullptr) table_->setItem(row, c, new QTableWidgetItem);
      table_->item(row, c)->setText(cells[c]);
      table_->item(row, c)->setToolTip(run.message.isEmpty() ? shell_line(run.record.command) : run.message);
    }
  }
  show_progress();
  table_->resizeColumnsToContents();
  show_buttons();
  show_why();
}

void QueuePanel::show_progress() {
  std::erase_if(progress_, [this](const auto& one) {
    return std::none_of(contents_.runs.begin(), contents_.runs.end(),
                        [&](const QueuedRun& run) { return run.runs() && run.record.folder == one.first; });
  });
  for (int row = 0; row < table_->rowCount(); ++row) {
    const QueuedRun& run = contents_.runs[static_cast<std::size_t>(row)];
    auto* bar = qobject_cast<QProgressBar*>(table_->cellWidget(row, kProgress));
    if (!run.runs()) {
      if (bar != nullptr) table_->removeCellWidget(row, kProgress);
      continue;
    }
    if (bar == nullptr) {
      bar = new QProgressBar;
      bar->setRange(0, kWhole);
      bar->setMinimumWidth(bar->fontMetrics().horizontalAdvance("100 %, to go: 00 min 00 s") + 20);
      table_->setCellWidget(row, kProgress, bar);
      table_->setColumnWidth(kProgress, bar->minimumWidth());
    }
    const RunStatus& status =
        progress_.try_emplace(run.record.folder, RunProgress(run.record.folder)).first->second.look();
    bar->setValue(static_cast<int>(kWhole * status.share));
    const QString words = status.state.isEmpty() ? tr("begins...")
                          : status.state == "paused"
                              ? tr("paused at %1 %").arg(100 * status.share, 0, 'f', 0)
                              : tr("%1 %, to go: %2").arg(100 * status.share, 0, 'f', 0).arg(to_go_words(status));
    bar->setFormat(words);
    bar->setAccessibleName(tr("Progress of %1: %2").arg(run.words, words));
    bar->setToolTip(tr("Share of the simulated time, and time to go: %1").arg(words));
  }
}

void QueuePanel::show_why() {
  const QueuedRun* run = chosen();
  for (const QueuedRun& r : contents_.runs)
    if (chosen() == nullptr && !r.message.isEmpty()) run = &r;
  why_->setVisible(run != nullptr && !run->message.isEmpty());
  if (why_->isHidden()) return;
  constexpr int kLines = 3;  // the tooltip has all of them
  QStringList lines = run->message.split('\n', Qt::SkipEmptyParts);
  if (lines.size() > kLines) lines = lines.mid(0, kLines - 1) << tr("...");
  why_->setText(tr("%1 %2: %3").arg(run->words, run->state, lines.join('\n')));
  why_->setToolTip(run->message);
}

void QueuePanel::show_buttons() {
  const QueuedRun* run = chosen();
  const bool waits = run != nullptr && run->waits();
  earlier_->setEnabled(waits);
  later_->setEnabled(waits);
  stop_->setEnabled(run != nullptr && run->runs());
  remove_->setEnabled(run != nullptr && !run->runs());
  bool ended = false;
  for (const QueuedRun& r : contents_.runs) ended = ended || (!r.waits() && !r.runs());
  clear_->setEnabled(ended);
}

}  // namespace breccia::gui
