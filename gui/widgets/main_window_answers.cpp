#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QLabel>

#include "widgets/animation_export.hpp"
#include "widgets/domains_panel.hpp"
#include "widgets/frame_loader.hpp"
#include "widgets/histogram_panel.hpp"
#include "widgets/main_window.hpp"
#include "widgets/problems_panel.hpp"
#include "widgets/property_form.hpp"
#include "widgets/run_panel.hpp"
#include "widgets/view3d.hpp"

// What is done with the solver's answers about the case.

namespace breccia::gui {
namespace {

/// Name of a volume group of the answer of `mesh --json`.
std::vector<std::string> names_of(const QJsonArray& groups) {
  std::vector<std::string> names;
  for (const QJsonValue& g : groups) names.push_back(g.toObject()["name"].toString().toStdString());
  return names;
}

/// The surface groups of the answer of `mesh --json` with their faces.
SurfaceGroups surfaces_of(const QJsonObject& json) {
  SurfaceGroups surfaces{names_of(json["groups"].toObject()["surfaces"].toArray()), {}};
  for (const QJsonValue& group : json["faces"].toArray()) {
    std::vector<std::int64_t>& faces = surfaces.faces.emplace_back();
    for (const QJsonValue& face : group.toArray()) faces.push_back(static_cast<std::int64_t>(face.toDouble()));
  }
  return surfaces;
}

}  // namespace

void MainWindow::claim_case() {
  const QByteArray name =
      QCryptographicHash::hash(document_.file().toUtf8(), QCryptographicHash::Sha1).toHex().left(16);
  const QString lock = document_.is_open() ? QString("%1/open-%2.lock").arg(places_.state, QString(name)) : QString();
  if (lock != claimed_) claim_ = lock.isEmpty() ? nullptr : std::make_unique<QLockFile>(lock);
  claimed_ = lock;
  QString other;
  if (claim_ != nullptr && !claim_->isLocked()) {
    claim_->setStaleLockTime(0);  // however long it is open; that of a process that is gone does not count
    qint64 process = 0;
    QString host, program;
    if (!claim_->tryLock(0) && claim_->error() == QLockFile::LockFailedError &&
        claim_->getLockInfo(&process, &host, &program))
      other = tr("process %1 on %2 has %3 open").arg(process).arg(host, document_.file());
  }
  tell_trouble("elsewhere", tr("This case is open in another window as well, and what is saved last stays"), other);
}

void MainWindow::show_check(const QJsonObject& json) {
  const double seconds = json["seconds"].toDouble(), most = json["most_seconds"].toDouble();
  QString words =
      tr("%1 elements, %2 joints<br>stable step %3; step used %4<br>%5 steps to %6<br>"
         "about %7 on one core")
          .arg(json["elements"].toInt())
          .arg(json["joints"].toInt())
          .arg(quantity_words(json["stable_step"].toDouble(), "s"), quantity_words(json["step"].toDouble(), "s"))
          .arg(json["steps"].toDouble(), 0, 'f', 0)
          .arg(quantity_words(json["end"].toDouble(), "s"), duration_words(seconds));
  if (most > seconds)
    words += tr(" while little breaks or meets, up to %1 where everything does").arg(duration_words(most));
  words += tr("<br>memory %1, about %3 on disk for %2 frames, more where joints break")
               .arg(quantity_words(json["memory"].toDouble(), "B"))
               .arg(json["frames"].toDouble(), 0, 'f', 0)
               .arg(quantity_words(json["disk"].toDouble(), "B"));
  QStringList advice;
  for (const QJsonValue& line : json["advice"].toArray()) advice << line.toString();
  if (!advice.isEmpty()) words += tr("<br>⚠ advice in the messages below: %1").arg(advice.size());
  run_panel_->set_estimate(words);
  messages_->set_advice(advice);
}

void MainWindow::show_mesh(const QJsonObject& json, const QString& elements_file) {
  const QJsonObject groups = json["groups"].toObject();
  QStringList words;
  for (const char* kind : {"volumes", "surfaces"})
    for (const std::string& name : names_of(groups[kind].toArray())) words << QString::fromStdString(name);
  form_->set_groups(words);
  groups_ = names_of(groups["volumes"].toArray());
  name_groups();
  view_->scene().set_surfaces(surfaces_of(json));
  const bool one = json["bodies"].toInt() == 1;
  mesh_words_->setText((one ? tr("%1 elements, %2 nodes, %3 body") : tr("%1 elements, %2 nodes, %3 bodies"))
                           .arg(json["elements"].toInt())
                           .arg(json["nodes"].toInt())
                           .arg(json["bodies"].toInt()));
  owner_.clear();
  preview_frame_ = {};
  if (!showing_results_) histogram_->set_frame({}, false);
  mesh_file_ = elements_file;
  if (!showing_results_) load_mesh();
}

/// Frames number the groups: their names are those of the case in hand, if that is what the run that is shown began
/// with.
void MainWindow::name_groups() {
  const auto is_of_case = [this] {
    if (case_of(*run_) == document_.file()) return true;
    QFile copy(QDir(run_->record().folder).filePath("case.toml"));
    return copy.open(QIODevice::ReadOnly) && copy.readAll() == document_.text();
  };
  view_->scene().set_groups(!showing_results_ || is_of_case() ? groups_ : std::vector<std::string>());
}

void MainWindow::load_mesh() {
  if (animation_ != nullptr) animation_->give_up(tr("the view shows something else"));
  loader_->start_model();
  view_->clear({});
  loader_->load(mesh_file_, 0);
}

/// Of a bar of the histogram.
void MainWindow::show_elements(vtkPolyData* faces, const QString& words) { view_->mark(faces, words); }

void MainWindow::show_division(const QJsonObject& json) {
  domains_->show_division(json);
  owner_.clear();
  for (const QJsonValue& rank : json["owner"].toArray()) owner_.push_back(rank.toInt());
  if (preview_frame_.skin == nullptr || showing_results_) return;
  set_ranks(*preview_frame_.skin, owner_);
  view_->set_colouring(Colouring::rank);
  view_->show_frame(preview_frame_,
                    tr("mesh at rest, as %1 ranks would share it").arg(json["domains"].toArray().size()));
}

void MainWindow::query_failed(const QString& what, const QString& text, const std::vector<Problem>& problems) {
  if (!text.isEmpty()) messages_->add_message(tr("%1: %2").arg(what, text));
  for (const Problem& p : problems) messages_->add_message(tr("%1: %2").arg(what, QString::fromStdString(p.text())));
  if (what == tr("check")) run_panel_->set_estimate(tr("The check found problems; see the messages below."));
  if (what == tr("mesh") && !showing_results_ && preview_frame_.skin == nullptr)
    view_->clear(tr("no mesh: see the messages"));
  show_dock("dock_messages");
}

}  // namespace breccia::gui
