#include "widgets/run_panel.hpp"

#include <QApplication>
#include <QClipboard>
#include <QDateTime>
#include <QFileInfo>
#include <QFontDatabase>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QThread>
#include <QVBoxLayout>
#include <array>
#include <cmath>

#include "core/value_text.hpp"
#include "widgets/named_button.hpp"

namespace breccia::gui {

QString run_words(int problems) {
  if (problems == 0) return RunPanel::tr("R&un");
  return problems == 1 ? RunPanel::tr("R&un (1 problem)") : RunPanel::tr("R&un (%1 problems)").arg(problems);
}

QString duration_words(double seconds) {
  if (!(seconds >= 0)) return RunPanel::tr("unknown");
  const auto s = static_cast<qint64>(std::llround(seconds));
  if (s < 60) return RunPanel::tr("%1 s").arg(seconds < 10 ? QString::number(seconds, 'g', 2) : QString::number(s));
  if (s < 3600) return RunPanel::tr("%1 min %2 s").arg(s / 60).arg(s % 60);
  return RunPanel::tr("%1 h %2 min").arg(s / 3600).arg(s / 60 % 60);
}

QString to_go_words(const RunStatus& status) {
  constexpr double kShare = 0.01, kWall = 20;  // s; the first steps, with reading and meshing, are not representative
  return status.share < kShare && status.wall < kWall ? RunPanel::tr("not known yet") : duration_words(status.eta);
}

QString to_go_words(const SolverRun& run) {
  return run.alive() && run.state() == "running" ? to_go_words(run.status()) : QString("-");
}

QString quantity_words(double value, const QString& unit) {
  static const std::array<std::pair<double, const char*>, 9> prefixes{
      {{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}, {1e-12, "p"}}};
  for (const auto& [factor, prefix] : prefixes)
    if (std::abs(value) >= 0.9995 * factor)
      return QString::number(value / factor, 'g', 3) + " " + prefix + shown_unit(unit);
  return QString::number(value, 'g', 3) + " " + shown_unit(unit);
}

RunPanel::RunPanel(QWidget* parent)
    : QWidget(parent),
      ranks_(new QSpinBox),
      oversubscribe_(new QCheckBox(tr("Run more ranks than cores"))),
      run_(named_button(tr("R&un"), "run", tr("Save the case and start the run (F5)"))),
      queue_(named_button(tr("Add to &queue"), "queue_run",
                          tr("Queue the present case; it starts in order when cores are free (Ctrl+Shift+F5)"))),
      pause_(named_button(tr("&Pause"), "pause", tr("Wait between two steps; press again to continue"))),
      checkpoint_(named_button(tr("Check&point"), "checkpoint",
                               tr("Write the whole state now; the run can be resumed from there"))),
      stop_(named_button(tr("&Stop"), "stop",
                         tr("End after the present step with everything written; processes that do not end in time are "
                            "killed"))),
      go_on_(named_button(tr("Resu&me from checkpoint"), "go_on",
                          tr("Continue the run, on as many ranks as are set above; results are bitwise identical"))),
      check_(named_button(tr("Chec&k"), "check", tr("Stable step, run time, memory and disk, with advice (F7)"))),
      results_(named_button(tr("&Open results"), "open_results", tr("Walk through the recorded frames of this run"))),
      command_(new QLineEdit),
      go_on_command_(new QLineEdit),
      estimate_(new QLabel),
      state_(new QLabel),
      warning_(new QLabel),
      checkpoints_(new QLabel),
      progress_(new QProgressBar),
      failure_(new QPlainTextEdit) {
  setObjectName("run_panel");
  checkpoints_->setWordWrap(true);
  checkpoints_->setObjectName("checkpoints");
  estimate_->setWordWrap(true);
  estimate_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  estimate_->setObjectName("estimate");
  estimate_->setText(tr("Not checked yet."));
  state_->setWordWrap(true);
  state_->setObjectName("run_state");
  progress_->setRange(0, 1000);
  progress_->setObjectName("progress");
  progress_->setAccessibleName(tr("Progress of the run"));
  progress_->setToolTip(tr("Share of the simulated time"));
  failure_->setReadOnly(true);
  failure_->setObjectName("failure");
  failure_->setAccessibleName(tr("Why the run failed"));
  failure_->setToolTip(tr("Message of the solver"));
  failure_->setTabChangesFocus(true);
  failure_->hide();

  auto* column = new QVBoxLayout(this);
  make_ranks(*column);
  make_buttons(*column);
  column->addWidget(progress_);
  column->addWidget(state_);
  column->addWidget(failure_);
  column->addWidget(checkpoints_);
  column->addWidget(go_on_);
  go_on_row_ = command_row(go_on_command_, "go_on_command", tr("Command line that resumes the run"));
  column->addWidget(go_on_row_);
  column->addWidget(results_);
  auto* head = new QHBoxLayout;
  head->addWidget(new QLabel(tr("<b>Estimate</b>")), 1);
  head->addWidget(check_);
  column->addLayout(head);
  column->addWidget(estimate_);
  column->addWidget(new QLabel(tr("<b>Command line</b>")));
  column->addWidget(command_row(command_, "command_line", tr("Command line")));
  column->addStretch();
  connect(run_, &QPushButton::clicked, this, &RunPanel::run_wanted);
  connect(queue_, &QPushButton::clicked, this, &RunPanel::queue_wanted);
  connect(pause_, &QPushButton::clicked, this, &RunPanel::pause_wanted);
  connect(stop_, &QPushButton::clicked, this, &RunPanel::stop_wanted);
  connect(checkpoint_, &QPushButton::clicked, this, &RunPanel::checkpoint_wanted);
  connect(go_on_, &QPushButton::clicked, this, &RunPanel::go_on_wanted);
  connect(check_, &QPushButton::clicked, this, &RunPanel::check_wanted);
  connect(results_, &QPushButton::clicked, this, &RunPanel::results_wanted);
  show_run(nullptr);
}

void RunPanel::make_ranks(QVBoxLayout& column) {
  constexpr int kMostOnACore = 16;
  const int cores = QThread::idealThreadCount();
  ranks_->setRange(1, kMostOnACore * cores);
  ranks_->setValue(cores);
  ranks_->setObjectName("ranks");
  ranks_->setAccessibleName(tr("Ranks"));
  ranks_->setToolTip(
      tr("Processes that share the model; this machine has %1 cores, at most %2 ranks are started on each")
          .arg(cores)
          .arg(kMostOnACore));
  warning_->setText(tr("⚠ more ranks than the %1 cores of this machine: oversubscription slows the run "
                       "down")
                        .arg(cores));
  warning_->setWordWrap(true);
  oversubscribe_->setObjectName("oversubscribe");
  oversubscribe_->setAccessibleName(oversubscribe_->text());
  oversubscribe_->setToolTip(tr("Without this tick no run is started on more ranks than the %1 cores").arg(cores));
  for (QWidget* widget : {static_cast<QWidget*>(warning_), static_cast<QWidget*>(oversubscribe_)}) widget->hide();
  auto* form = new QFormLayout;
  auto* label = new QLabel(tr("Ra&nks"));
  label->setBuddy(ranks_);
  form->addRow(label, ranks_);
  column.addLayout(form);
  column.addWidget(warning_);
  column.addWidget(oversubscribe_);
  connect(ranks_, qOverload<int>(&QSpinBox::valueChanged), this, [this, cores](int n) {
    oversubscribe_->setChecked(false);  // one agrees to a number
    warning_->setVisible(n > cores);
    oversubscribe_->setVisible(n > cores);
    set_problems(problems_);
    emit ranks_changed(n);
  });
  connect(oversubscribe_, &QCheckBox::toggled, this, [this] { set_problems(problems_); });
}

/// A run in progress is visible without scrolling; its former estimate is below.
void RunPanel::make_buttons(QVBoxLayout& column) {
  auto* grid = new QGridLayout;
  grid->addWidget(run_, 0, 0);
  grid->addWidget(queue_, 0, 1);
  grid->addWidget(pause_, 1, 0);
  grid->addWidget(stop_, 1, 1);
  grid->addWidget(checkpoint_, 2, 0);
  column.addLayout(grid);
}

bool RunPanel::accepts_ranks() const {
  return ranks_->value() <= QThread::idealThreadCount() || oversubscribe_->isChecked();
}

QWidget* RunPanel::command_row(QLineEdit* line, const QString& name, const QString& title) {
  line->setReadOnly(true);
  line->setObjectName(name);
  line->setAccessibleName(title);
  line->setToolTip(tr("The same from a terminal"));
  QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
  line->setFont(font);
  QPushButton* copy = named_button(tr("Copy"), "copy_" + name, tr("Copy the command line: %1").arg(title));
  copy->setAccessibleName(tr("Copy: %1").arg(title));
  connect(copy, &QPushButton::clicked, this, [line] { QApplication::clipboard()->setText(line->text()); });
  auto* row = new QWidget(this);
  auto* cells = new QHBoxLayout(row);
  cells->setContentsMargins(0, 0, 0, 0);
  cells->addWidget(line, 1);
  cells->addWidget(copy);
  return row;
}

void RunPanel::set_command(const QStringList& command, const QStringList& go_on) {
  const auto show = [](QLineEdit* line, const QStringList& words) {
    if (line->text() == shell_line(words)) return;  // what the user has selected stays selected
    line->setText(shell_line(words));
    line->setCursorPosition(0);
  };
  show(command_, command);
  show(go_on_command_, go_on);
}

void RunPanel::set_problems(int count) {
  problems_ = count;
  run_->setText(run_words(count));
  run_->setAccessibleName(count == 0 ? tr("Run") : tr("Run, %1").arg(counted(count, tr("problem"), tr("problems"))));
  const bool agreed = accepts_ranks();
  run_->setEnabled(count == 0 && !running_ && agreed);
  run_->setToolTip(
      count > 0 ? tr("The case has %1; F8 goes to the next one").arg(counted(count, tr("problem"), tr("problems")))
      : agreed  ? tr("Save the case and start the run (F5)")
                : tr("There are more ranks than cores: that needs the tick below them"));
  check_->setEnabled(count == 0);
  queue_->setEnabled(count == 0 && agreed);
  go_on_->setEnabled(agreed);
}

void RunPanel::set_estimate(const QString& html) { estimate_->setText(html); }

void RunPanel::set_state_words(const SolverRun& run) {
  const RunStatus& s = run.status();
  QString words = "<b>" + run.state().toHtmlEscaped() + "</b>";
  if (!s.state.isEmpty()) {
    words += tr("<br>step %1 of about %2<br>time %3 of %4")
                 .arg(s.step, 0, 'f', 0)
                 .arg(s.steps_total, 0, 'f', 0)
                 .arg(quantity_words(s.time, "s"), quantity_words(s.end, "s"));
    if (run.alive()) words += tr("<br>time to go %1").arg(to_go_words(run));
    words += tr("<br>wall time %1").arg(duration_words(s.wall));
    words += tr("<br>broken joints %1, fragments %2").arg(s.broken_joints, 0, 'f', 0).arg(s.fragments, 0, 'f', 0);
    words += tr("<br>unaccounted energy %1 %").arg(100 * s.residual, 0, 'g', 2);
    if (run.record().ranks > 1) words += tr("<br>imbalance %1").arg(s.imbalance, 0, 'f', 3);
  }
  state_->setText(words);
}

void RunPanel::show_checkpoints(const SolverRun& run) {
  const std::vector<RunCheckpoint>& list = run.checkpoints();
  checkpoints_->setVisible(!list.empty());
  if (list.empty()) return;
  const QFileInfo latest(list.front().file);
  checkpoints_->setText(
      tr("checkpoints: %1, the latest at step %2 (%3, %4)")
          .arg(list.size())
          .arg(list.front().step)
          .arg(quantity_words(static_cast<double>(latest.size()), "B"), latest.lastModified().toString("HH:mm:ss")));
}

void RunPanel::show_run(const SolverRun* run) {
  running_ = run != nullptr && run->alive();
  for (QPushButton* b : {pause_, stop_, checkpoint_}) b->setVisible(running_);
  stop_->setEnabled(running_ && run->state() != "stopping");
  checkpoint_->setEnabled(running_ && (run->state() == "running" || run->state() == "paused"));
  const bool can_go_on = run != nullptr && run->can_go_on();
  go_on_->setVisible(can_go_on);
  go_on_row_->setVisible(can_go_on);
  results_->setEnabled(run != nullptr && !run->frames().empty());
  const QString state = run != nullptr ? run->state() : QString();
  const bool paused = state == "paused" || state == "resuming";
  pause_->setEnabled(running_ && state != "pausing" && state != "resuming" && state != "stopping");
  pause_->setText(paused ? tr("Resu&me") : tr("&Pause"));
  pause_->setAccessibleName(paused ? tr("Resume") : tr("Pause"));
  set_problems(problems_);
  if (run == nullptr) {
    state_->setText(tr("No run yet."));
    progress_->setValue(0);
    failure_->hide();
    checkpoints_->hide();
    return;
  }
  show_checkpoints(*run);
  set_state_words(*run);
  progress_->setValue(static_cast<int>(1000 * run->status().share));
  const bool failed = run->state() == "failed" || run->state() == "interrupted";
  failure_->setVisible(failed);
  if (failed) failure_->setPlainText(run->failure());
}

}  // namespace breccia::gui
