#include <QAction>
#include <QApplication>
#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>
#include <QSystemTrayIcon>
#include <algorithm>
#include <limits>

#include "core/report_maker.hpp"
#include "core/run_case.hpp"
#include "widgets/animation_export.hpp"
#include "widgets/case_tree.hpp"
#include "widgets/domains_panel.hpp"
#include "widgets/frame_loader.hpp"
#include "widgets/histogram_panel.hpp"
#include "widgets/main_window.hpp"
#include "widgets/plots_panel.hpp"
#include "widgets/property_form.hpp"
#include "widgets/queue_panel.hpp"
#include "widgets/results_panel.hpp"
#include "widgets/run_panel.hpp"
#include "widgets/runs_panel.hpp"
#include "widgets/view3d.hpp"

namespace breccia::gui {
namespace {

constexpr std::size_t kMostWatched = 20;

int run_stage() { return static_cast<int>(work_stages().size()) - 2; }
int results_stage() { return static_cast<int>(work_stages().size()) - 1; }

}  // namespace

QString MainWindow::new_run_folder() const {
  const QFileInfo file(document_.file());
  const QString name = file.completeBaseName() + QDateTime::currentDateTime().toString("-yyyyMMdd-HHmmss");
  const QFileInfo beside(file.dir().filePath("runs"));
  const bool writable = beside.exists() ? beside.isWritable() : QFileInfo(file.absolutePath()).isWritable();
  const QString folder = QDir(writable ? file.absolutePath() : places_.projects).filePath("runs/" + name);
  QStringList waiting;
  for (const QueuedRun& run : queue_panel_->contents().runs) waiting << run.record.folder;
  QString free = folder;
  for (int i = 2; QFileInfo::exists(free) || waiting.contains(free); ++i) free = folder + QString("-%1").arg(i);
  return free;
}

QStringList MainWindow::command_line() const {
  if (!document_.is_open()) return {};
  return SolverRun::command_line(places_.launch, document_.file(), new_run_folder(), run_panel_->ranks());
}

void MainWindow::remember_run(const RunRecord& record) {
  tell_trouble("runs", tr("The run continues, but later windows will not list it (File > Open results)"),
               registry_.add(record));
}

bool MainWindow::ranks_are_accepted() {
  if (run_panel_->accepts_ranks()) return true;
  tree_->select(run_stage(), {});
  run_panel_->ask_for_agreement();
  statusBar()->showMessage(tr("There are more ranks than cores: that needs the tick below them"), 15000);
  return false;
}

void MainWindow::start_run() {
  form_->take_typed();
  if (!document_.is_open() || !ranks_are_accepted()) return;
  if (!agrees_with_disk()) return;
  validate();
  const bool saved = !problems_.empty() || !document_.modified() || save();
  validate();  // the text of another program may have been loaded
  if (!saved || !problems_.empty()) {
    show_dock("dock_messages");
    return;
  }
  QString error;
  SolverRun* run =
      SolverRun::start(places_.launch, document_.file(), new_run_folder(), run_panel_->ranks(), &error, this);
  if (run == nullptr) {
    QMessageBox::warning(this, tr("Breccia"), tr("The run could not be started: %1").arg(error));
    return;
  }
  remember_run(run->record());
  take_run(run);
  tree_->select(run_stage(), {});
  watch(run);
  run_panel_->set_command(run->record().command, {});
  show_dock("dock_plots");
}

bool MainWindow::resumes_as_it_was_run() {
  form_->take_typed();
  const RunRecord& record = run_->record();
  if (!document_.is_open() || record.case_file != document_.file() ||
      !was_run_with_another(record.folder, document_.text()))
    return true;
  QMessageBox box(QMessageBox::Question, tr("Breccia"),
                  tr("%1\nhas been edited since this run was started. Resuming uses the case without these edits. A "
                     "new run uses them, from the start.")
                      .arg(document_.file()),
                  QMessageBox::Yes | QMessageBox::No | QMessageBox::Cancel, this);
  box.button(QMessageBox::Yes)->setText(tr("Resume as it was &run"));
  box.button(QMessageBox::No)->setText(tr("Start a &new run"));
  box.setDefaultButton(QMessageBox::Cancel);
  const int answer = box.exec();
  if (answer == QMessageBox::No) start_run();
  return answer == QMessageBox::Yes;
}

void MainWindow::go_on_with_run() {
  if (run_ == nullptr || !run_->can_go_on() || !ranks_are_accepted() || !resumes_as_it_was_run()) return;
  QString error;
  SolverRun* ended = run_;
  SolverRun* run = SolverRun::go_on(places_.launch, ended->record(), run_panel_->ranks(), &error, this);
  if (run == nullptr) {
    QMessageBox::warning(this, tr("Breccia"), tr("The run could not be resumed: %1").arg(error));
    return;
  }
  for (std::vector<SolverRun*>* list : {&runs_, &compared_})
    list->erase(std::remove(list->begin(), list->end(), ended), list->end());
  ended->disconnect(this);
  ended->deleteLater();
  remember_run(run->record());
  take_run(run);
  tree_->select(run_stage(), {});
  watch(run);
  show_dock("dock_plots");
}

void MainWindow::pause_or_resume() {
  if (run_ == nullptr || !run_->alive() || run_->state() == "pausing" || run_->state() == "resuming") return;
  run_->state() == "paused" ? run_->resume() : run_->pause();
}

void MainWindow::show_commands() {
  const bool can = run_ != nullptr && run_->can_go_on();
  run_panel_->set_command(
      run_ != nullptr && run_->alive() ? run_->record().command : command_line(),
      can ? SolverRun::resume_line(places_.launch, run_->record().folder, run_panel_->ranks()) : QStringList());
}

void MainWindow::take_run(SolverRun* run) {
  runs_.insert(runs_.begin(), run);
  connect(run, &SolverRun::status_changed, this, &MainWindow::run_changed);
  connect(run, &SolverRun::history_grew, this, [this, run] {
    if (run == run_ || std::find(compared_.begin(), compared_.end(), run) != compared_.end()) show_curves();
  });
  connect(run, &SolverRun::frames_changed, this, [this, run] {
    if (run == run_) results_->set_frames(run->frames());
  });
  connect(run, &SolverRun::ended, this, [this, run] { run_ended(run); });
  runs_panel_->show_runs(runs_);
}

void MainWindow::find_runs() {
  std::vector<RunRecord> found = registry_.load();
  if (found.size() > kMostWatched) found.resize(kMostWatched);
  for (auto it = found.rbegin(); it != found.rend(); ++it) take_run(new SolverRun(*it, this));
}

/// Results are seen beside the case that they are of: another one that is open is left for it, if that may be.
bool MainWindow::open_case_of(const RunRecord& record) {
  if (document_.is_open() && is_run_of(record, document_.file(), document_.text())) return true;
  const QString file = case_of_run(record);
  if (!may_leave_case()) return false;
  if (!file.isEmpty()) {
    open_case(file);
    return document_.is_open() && QFileInfo(file).absoluteFilePath() == document_.file();
  }
  if (document_.is_open()) document_.close();
  return true;
}

void MainWindow::open_run(const QString& path) {
  const QString folder = QDir::cleanPath(QFileInfo(path).absoluteFilePath());  // as runs that are watched are named
  if (!is_run_folder(folder)) {
    QMessageBox::warning(this, tr("Breccia"), tr("%1 is not the folder of a run.").arg(folder));
    return;
  }
  SolverRun* chosen = run_in(folder);
  if (!open_case_of(chosen->record())) return;
  show_workspace();
  watch(chosen);
  tree_->select(chosen->alive() ? run_stage() : results_stage(), {});
  show_dock("dock_plots");
}

SolverRun* MainWindow::run_in(const QString& folder) {
  for (SolverRun* run : runs_)
    if (run->record().folder == folder) return run;
  take_run(new SolverRun({folder, {}, 1, {}, {}}, this));
  return runs_.front();
}

void MainWindow::open_other_run() {
  const QString from = document_.is_open() ? document_.folder() : places_.projects;
  const QString name = QFileDialog::getExistingDirectory(this, tr("Open the folder of a run"), from);
  if (!name.isEmpty()) open_path(name);
}

void MainWindow::find_runs_of_case() {
  beside_ = document_.is_open() ? runs_beside(document_.file()) : std::vector<RunOrigin>();
  for (const SolverRun* run : runs_) {
    const QString folder = run->record().folder;
    const bool is_listed =
        std::any_of(beside_.begin(), beside_.end(), [&](const RunOrigin& one) { return one.folder == folder; });
    if (!is_listed && (run == run_ || run->record().case_file == document_.file()))
      beside_.push_back(origin_of(folder));
  }
  // One that has just been started has no status yet.
  const auto when = [](const RunOrigin& one) {
    return one.started.isValid() ? one.started.toMSecsSinceEpoch() : std::numeric_limits<qint64>::max();
  };
  std::stable_sort(beside_.begin(), beside_.end(), [&](const auto& a, const auto& b) { return when(a) > when(b); });
  states_.clear();
  for (const RunOrigin& one : beside_)
    states_[one.folder] = is_held(one.folder) ? tr("running") : outcome_of(one.folder).state;
  list_runs_of_case();
}

/// Monitored runs show their progress.
void MainWindow::list_runs_of_case() {
  std::vector<RunChoice> choices;
  for (const RunOrigin& one : beside_) {
    const auto watched = std::find_if(runs_.begin(), runs_.end(),
                                      [&](const SolverRun* run) { return run->record().folder == one.folder; });
    const QString state = watched != runs_.end() ? (*watched)->state() : states_.value(one.folder);
    QStringList words{QFileInfo(one.folder).fileName(), state};
    if (one.started.isValid()) words << one.started.toLocalTime().toString("yyyy-MM-dd HH:mm");
    words << (one.ranks == 1 ? tr("1 rank") : tr("%1 ranks").arg(one.ranks));
    choices.push_back({one.folder, words.join(", ")});
  }
  results_->set_choices(choices);
}

/// Selects the latest run of the case by default; one in progress comes before all others.
void MainWindow::attach_newest_run() {
  find_runs_of_case();
  if (beside_.empty()) return;
  const auto alive =
      std::find_if(beside_.begin(), beside_.end(), [](const RunOrigin& one) { return is_held(one.folder); });
  watch(run_in((alive != beside_.end() ? *alive : beside_.front()).folder));
}

void MainWindow::watch(SolverRun* run) {
  if (animation_ != nullptr) end_animation();
  run_ = run;
  using Kind = WorkStage::Kind;
  showing_results_ = run != nullptr && work_stages()[static_cast<std::size_t>(tree_->stage())].kind != Kind::sections;
  name_groups();
  loader_->start_model();
  view_->show_results(showing_results_);
  if (showing_results_ || run == nullptr) histogram_->set_frame({}, false);
  if (run != nullptr) run->read_history();
  if (run != nullptr && run->alive() && !run->record().command.isEmpty()) run_panel_->set_ranks(run->record().ranks);
  show_curves();
  find_runs_of_case();
  results_->set_run(run == nullptr ? QString() : run->record().folder);
  results_->set_reporting(report_->busy());
  if (showing_results_) {
    view_->clear(no_frame_words());
    show_run_frames();
  } else if (run != nullptr) {
    results_->set_frames(run->frames());
  }
  run_changed();
}

void MainWindow::show_run_frames() {
  if (run_->frames().empty()) view_->clear(no_frame_words());
  results_->set_frames(run_->frames());
  if (!results_->follows() && !run_->frames().empty()) load_frame_of_run(run_->frames().back());
}

/// Displacements count from the first frame of the run, which is the model at rest.
void MainWindow::load_frame_of_run(const RunFrame& frame) {
  loader_->set_deformation(view_->deformation(), run_->frames().front().file);
  loader_->load(frame.file, frame.time);
}

/// The joints of a frame are there before its elements.
QString MainWindow::no_frame_words() const {
  const bool has_joints = !read_series(run_->record().folder, "joints").empty();
  if (has_joints && (!run_->alive() || !writes_elements(run_->record().folder)))
    return tr("the frames of this run have joints but no elements (output.elements of its case): nothing to draw");
  return run_->alive() ? tr("waiting for the first frame...") : tr("this run has left no frame");
}

void MainWindow::run_changed() {
  run_panel_->show_run(run_);
  show_commands();
  runs_panel_->show_runs(runs_);
  list_runs_of_case();
  run_bar_->setVisible(run_ != nullptr && run_->alive());
  show_actions();
  if (run_ == nullptr) {
    run_words_->clear();
    return;
  }
  offer_fragments();
  const bool nothing_to_see = showing_results_ && run_->frames().empty();
  if (nothing_to_see && view_->caption() != no_frame_words()) view_->clear(no_frame_words());
  const RunStatus& s = run_->status();
  run_bar_->setValue(static_cast<int>(1000 * s.share));
  run_words_->setText(run_->state() == "running" ? tr("%1, to go: %2").arg(run_->state(), to_go_words(*run_))
                                                 : run_->state());
  domains_->show_measured(s, run_->record().ranks);
}

void MainWindow::run_ended(const SolverRun* run) {
  run_changed();
  if (run->record().command.isEmpty()) return;  // only its results were opened
  const QString words = tr("Run %1: %2").arg(QFileInfo(run->record().folder).fileName(), run->state());
  statusBar()->showMessage(words, 15000);
  QApplication::alert(this);
  if (QSystemTrayIcon::isSystemTrayAvailable()) {
    auto* tray = new QSystemTrayIcon(windowIcon(), this);
    tray->show();
    tray->showMessage(tr("Breccia"), words);
    QTimer::singleShot(10000, tray, &QObject::deleteLater);
  }
}

/// For broken models fragments are of interest at the end, and cracks during the run.
void MainWindow::offer_fragments() {
  if (!showing_results_ || run_ == nullptr) return;
  if (run_->alive()) {
    view_->offer_colouring(Colouring::group);
  } else if (view_->scene().has_data() && view_->scene().is_broken()) {
    view_->offer_colouring(colouring_by(Quantity::fragment_size));
  }
}

void MainWindow::show_frame(const FrameData& frame) {
  if (animation_ != nullptr && (frame.skin == nullptr || !showing_results_)) {
    animation_->give_up(frame.skin == nullptr
                            ? tr("the frame at %1 cannot be read").arg(quantity_words(frame.time, "s"))
                            : tr("the view shows something else"));
  }
  if (frame.skin == nullptr) return;
  if (!showing_results_) {
    mesh_file_.clear();
    preview_frame_ = frame;
    if (!owner_.empty()) set_ranks(preview_frame_, owner_);
    view_->show_frame(preview_frame_, tr("mesh at rest"));
    histogram_->set_frame(preview_frame_, false);
    return;
  }
  view_->show_frame(frame, tr("time %1").arg(quantity_words(frame.time, "s")));
  offer_fragments();
  histogram_->set_frame(frame, true);
  if (animation_ != nullptr) animation_->take(frame.time, view_->picture());
}

}  // namespace breccia::gui
