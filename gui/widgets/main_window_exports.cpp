#include <QBuffer>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QProcess>
#include <QStandardPaths>
#include <QStatusBar>
#include <QUrl>
#include <algorithm>
#include <array>
#include <utility>

#include "core/report_maker.hpp"
#include "core/written_file.hpp"
#include "widgets/animation_export.hpp"
#include "widgets/frame_loader.hpp"
#include "widgets/main_window.hpp"
#include "widgets/paraview_results.hpp"
#include "widgets/plots_panel.hpp"
#include "widgets/results_panel.hpp"
#include "widgets/study_panel.hpp"
#include "widgets/view3d.hpp"

namespace breccia::gui {
namespace {

QString name_of(const SolverRun& run) { return QFileInfo(run.record().folder).fileName(); }

}  // namespace

void MainWindow::compare(const std::vector<SolverRun*>& others) {
  compared_ = others;
  for (SolverRun* run : compared_) run->read_history();
  show_curves();
}

void MainWindow::show_curves() {
  std::vector<std::pair<QString, const History*>> others;
  for (const SolverRun* run : compared_)
    if (run != run_) others.emplace_back(name_of(*run), &run->history());
  static const History none;
  results_->set_has_curves(run_ != nullptr || !compared_.empty());
  plots_->show_history(run_ == nullptr ? none : run_->history(), others);
}

void MainWindow::export_curves() {
  if (run_ == nullptr && compared_.empty()) return;
  curves_file_ = table_name(tr("Export the curves as"), "curves.csv");
  write_curves();
}

/// A long history is read in pieces: the table is written once all are whole, and the window lives meanwhile.
void MainWindow::write_curves() {
  if (curves_file_.isEmpty()) return;
  std::vector<SolverRun*> all = compared_;
  if (run_ != nullptr) {
    all.erase(std::remove(all.begin(), all.end(), run_), all.end());
    all.insert(all.begin(), run_);
  }
  bool more = false;
  for (SolverRun* run : all) more = run->read_more_history() || more;
  if (more) {
    statusBar()->showMessage(tr("the histories are read..."), 2000);
    QTimer::singleShot(0, this, &MainWindow::write_curves);
    return;
  }
  std::vector<std::pair<QString, const History*>> runs;
  for (const SolverRun* run : all) runs.emplace_back(name_of(*run), &run->history());
  write_table(std::exchange(curves_file_, {}), histories_csv(runs));
}

void MainWindow::export_study() {
  if (const std::optional<Study>& study = study_panel_->study(); study)
    write_table(table_name(tr("Export the study as"), "study.csv"), study_csv(*study, study_panel_->results()));
}

QString MainWindow::table_name(const QString& title, const QString& suggested) {
  return QFileDialog::getSaveFileName(this, title, QDir(document_.folder()).filePath(suggested), tr("Tables (*.csv)"));
}

void MainWindow::write_table(const QString& name, const QByteArray& text) {
  if (name.isEmpty()) return;
  if (const QString error = written(name, text); !error.isEmpty()) QMessageBox::warning(this, tr("Breccia"), error);
}

/// Without ffmpeg there are numbered pictures, of which other programs make films. Empty: nothing is to be written.
QString MainWindow::film_name() {
  const bool can_film = !AnimationExport::program().isEmpty();
  const QString pictures = tr("Numbered pictures (*.png)"), films = tr("Films (*.mp4)");
  const QString suffix = can_film ? ".mp4" : ".png";
  QString name = QFileDialog::getSaveFileName(
      this,
      can_film ? tr("Save the animation as") : tr("Save the animation as pictures (ffmpeg, for films, is missing)"),
      document_.folder() + "/animation" + suffix, can_film ? films + ";;" + pictures : pictures);
  const bool is_known = name.endsWith(".png", Qt::CaseInsensitive) || (can_film && !QFileInfo(name).suffix().isEmpty());
  if (!name.isEmpty() && !is_known) name += suffix;
  return name;
}

void MainWindow::save_animation() {
  if (run_ == nullptr || run_->frames().empty() || animation_ != nullptr) return;
  const QString name = film_name();
  if (name.isEmpty()) return;
  results_->stop_playing();
  results_->set_follow(false);
  animation_ = new AnimationExport(run_->frames(), name, this);
  connect(animation_, &AnimationExport::frame_wanted, loader_, &FrameLoader::load);
  connect(animation_, &AnimationExport::progress, this,
          [this](const QString& words) { statusBar()->showMessage(words, 5000); });
  connect(animation_, &AnimationExport::done, this, [this, name](const QString& error) {
    end_animation();
    statusBar()->showMessage(error.isEmpty() ? tr("%1 is written").arg(name) : QString(), 15000);
    if (!error.isEmpty()) QMessageBox::warning(this, tr("Breccia"), tr("The film could not be made: %1").arg(error));
  });
  view_->scene().hold_range(true);
  animation_->begin();
}

void MainWindow::end_animation() {
  animation_->disconnect(this);
  animation_->deleteLater();
  animation_ = nullptr;
  view_->scene().hold_range(false);
}

/// ParaView waits for a run of this case that is started with --live.
void MainWindow::watch_live() {
  if (!document_.is_open()) return;
  if (QStandardPaths::findExecutable("paraview").isEmpty()) {
    QMessageBox::information(this, tr("Breccia"), tr("ParaView is not installed (Debian: paraview)."));
    return;
  }
  if (document_.modified() && !save()) return;
  if (QProcess::startDetached(places_.launch.program, {"live", document_.file()}, document_.folder())) {
    statusBar()->showMessage(tr("ParaView starts; a case with [insitu.live] is seen there while it runs"), 15000);
  } else {
    QMessageBox::warning(this, tr("Breccia"), tr("%1 could not be started.").arg(places_.launch.program));
  }
}

void MainWindow::open_paraview() {
  if (run_ == nullptr) return;
  const QString program = QStandardPaths::findExecutable("paraview");
  if (program.isEmpty()) {
    QMessageBox::information(
        this, tr("Breccia"),
        tr("ParaView is not installed (Debian: paraview). The frames are in %1/frames.").arg(run_->record().folder));
    return;
  }
  statusBar()->showMessage(tr("ParaView starts..."), 15000);
  const std::array<double, 3>& up = view_->scene().up();
  const auto axis = std::find_if(up.begin(), up.end(), [](double x) { return x != 0; });
  const QString words = QString(*axis < 0 ? "-" : "") + "xyz"[axis - up.begin()];
  paraview_->open(program, run_->record().folder, words, places_.state);
}

void MainWindow::save_picture() {
  const QString name = QFileDialog::getSaveFileName(this, tr("Save the picture as"),
                                                    document_.folder() + "/picture.png", tr("Pictures (*.png)"));
  if (name.isEmpty()) return;
  QBuffer png;
  view_->picture().save(&png, "PNG");
  if (const QString error = written(name, png.data()); !error.isEmpty())
    QMessageBox::warning(this, tr("Breccia"), error);
}

/// The solver makes the report of a run; ParaView draws for it, which takes a while.
void MainWindow::make_report() {
  if (run_ == nullptr || report_->busy()) return;
  const QString suggested = QDir(run_->record().folder).filePath("report.html");
  QString name = QFileDialog::getSaveFileName(this, tr("Write the report as"), suggested, tr("Pages (*.html)"));
  if (name.isEmpty()) return;
  if (QFileInfo(name).suffix().isEmpty()) name += ".html";
  results_->set_reporting(true);
  statusBar()->showMessage(tr("the report is written, with pictures by ParaView..."));
  report_->make(places_.launch.program, run_->record().folder, name);
}

void MainWindow::report_made(const QString& file, const QString& error, const QString& notes) {
  results_->set_reporting(false);
  statusBar()->clearMessage();
  if (!error.isEmpty()) {
    QMessageBox::warning(this, tr("Breccia"), tr("The report could not be written: %1").arg(error));
    return;
  }
  const bool seen = QDesktopServices::openUrl(QUrl::fromLocalFile(file));
  QString words = tr("%1 is written").arg(file);
  if (!seen) words += tr("; no browser is there to show it");
  if (!notes.isEmpty()) words += tr(", without pictures: %1").arg(notes);
  statusBar()->showMessage(words, 15000);
}

}  // namespace breccia::gui
