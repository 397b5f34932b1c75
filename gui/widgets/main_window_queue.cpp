#include <QFileInfo>
#include <QMessageBox>
#include <QProcess>
#include <algorithm>

#include "widgets/main_window.hpp"
#include "widgets/problems_panel.hpp"
#include "widgets/property_form.hpp"
#include "widgets/queue_panel.hpp"
#include "widgets/run_panel.hpp"
#include "widgets/study_panel.hpp"

namespace breccia::gui {

void MainWindow::queue_run() {
  form_->take_typed();
  if (!ranks_are_accepted() || !agrees_with_disk()) return;
  validate();
  if (!problems_.empty() || !document_.is_open()) {
    show_dock("dock_messages");
    return;
  }
  const QString folder = new_run_folder();
  const QString error =
      queue_.add(places_.launch, {{document_.file(), folder, document_.text(), run_panel_->ranks(), {}, {}}});
  if (!error.isEmpty()) QMessageBox::warning(this, tr("Breccia"), error);
  queue_panel_->look();
  show_dock("dock_queue");
}

void MainWindow::start_worker() {
  if (!QProcess::startDetached(places_.desktop, {"--work-queue", places_.state}, places_.state))
    messages_->add_message(tr("queue: %1 could not be started").arg(places_.desktop));
}

void MainWindow::start_study(const std::vector<StudyParameter>& parameters) {
  if (!document_.is_open() || !ranks_are_accepted()) return;
  Study study{new_run_folder() + "-study", document_.file(), run_panel_->ranks(), parameters, {}};
  QStringList problems;
  const std::vector<RunWish> wishes = plan_study(document_, study, &problems);
  QString error;
  if (problems.isEmpty()) error = save_study(study);
  if (problems.isEmpty() && error.isEmpty()) error = queue_.add(places_.launch, wishes);
  if (!error.isEmpty()) problems << error;
  study_panel_->show_problems(problems);
  if (!problems.isEmpty()) return;
  queue_panel_->look();
  show_studies();
}

void MainWindow::show_studies() {
  study_panel_->set_studies(find_studies(QFileInfo(new_run_folder()).absolutePath(), document_.file()));
}

/// Runs that the queue has started are watched as those that were started here.
void MainWindow::take_queue() {
  for (const QueuedRun& queued : queue_panel_->contents().runs) {
    const auto known = [&](const SolverRun* run) { return run->record().folder == queued.record.folder; };
    const bool started = queued.runs() || (!queued.waits() && waiting_.contains(queued.record.folder));
    if (started && std::none_of(runs_.begin(), runs_.end(), known)) take_run(new SolverRun(queued.record, this));
  }
  waiting_.clear();
  for (const QueuedRun& queued : queue_panel_->contents().runs)
    if (queued.waits()) waiting_ << queued.record.folder;
  show_commands();
}

}  // namespace breccia::gui
