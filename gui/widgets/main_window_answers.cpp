#include <QJsonArray>
#include <QLabel>

#include "core/mesh_parameters.hpp"
#include "core/run_case.hpp"
#include "core/value_text.hpp"
#include "widgets/animation_export.hpp"
#include "widgets/case_tree.hpp"
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
  const QJsonObject groups = json["groups"].toObject();
  SurfaceGroups surfaces;
  surfaces.names = names_of(groups["surfaces"].toArray());
  surfaces.curves = names_of(groups["curves_and_points"].toArray());
  for (const QJsonValue& group : json["faces"].toArray()) {
    std::vector<std::int64_t>& faces = surfaces.faces.emplace_back();
    for (const QJsonValue& face : group.toArray()) faces.push_back(static_cast<std::int64_t>(face.toDouble()));
  }
  for (const QJsonValue& group : json["places"].toArray()) {
    auto& places = surfaces.places.emplace_back();
    for (const QJsonValue& x : group.toArray())
      places.push_back({x.toArray()[0].toDouble(), x.toArray()[1].toDouble(), x.toArray()[2].toDouble()});
  }
  return surfaces;
}

/// A problem in the geometry is one of the key that the solver names, else of the one that names the file.
void place_in_case(Problem& p, const Document& document) {
  const std::string own = document.file().toStdString();
  if (p.file.empty() || p.file == own) return;
  const std::string key = p.key.empty() ? "mesh.file" : p.key;
  const Place* place = document.places().find(key);
  if (place == nullptr) return;
  p.what = p.file + (p.line > 0 ? ":" + std::to_string(p.line) : std::string()) + ": " + p.what;
  p.key = key;
  p.file = own;
  p.line = place->line;
}

}  // namespace

void MainWindow::query_succeeded(Query what) {
  messages_->set_trouble(words_of(what), {});
  if (what != Query::check && what != Query::mesh) return;
  const bool told = !told_.empty();
  told_.clear();
  validate();
  if (!told) return;
  if (what == Query::mesh) {
    ask_estimate();  // the mesh is good; the rest needs a check
  } else if (preview_frame_.skin == nullptr && mesh_file_.isEmpty()) {
    ask_mesh();
  }
}

void MainWindow::show_check(const QJsonObject& json) {
  query_succeeded(Query::check);
  const double seconds = json["seconds"].toDouble(), most = json["most_seconds"].toDouble();
  QString words =
      tr("%1, %2<br>stable step %3; step used %4<br>%5 to %6<br>about %7 on one core")
          .arg(counted(json["elements"].toDouble(), tr("element"), tr("elements")))
          .arg(counted(json["joints"].toDouble(), tr("joint"), tr("joints")))
          .arg(quantity_words(json["stable_step"].toDouble(), "s"), quantity_words(json["step"].toDouble(), "s"))
          .arg(counted(json["steps"].toDouble(), tr("step"), tr("steps")))
          .arg(quantity_words(json["end"].toDouble(), "s"), duration_words(seconds));
  if (most > seconds)
    words += tr(" while little breaks or meets, up to %1 where everything does").arg(duration_words(most));
  words += tr("<br>memory %1, about %3 on disk for %2, more where joints break")
               .arg(quantity_words(json["memory"].toDouble(), "B"))
               .arg(counted(json["frames"].toDouble(), tr("frame"), tr("frames")))
               .arg(quantity_words(json["disk"].toDouble(), "B"));
  QStringList advice;
  for (const QJsonValue& one : json["advice"].toArray()) advice << one["text"].toString();
  if (!advice.isEmpty()) words += tr("<br>⚠ advice in the messages below: %1").arg(advice.size());
  run_panel_->set_estimate(words);
  messages_->set_advice(advice);
}

void MainWindow::show_mesh(const QJsonObject& json, const QString& elements_file) {
  const QJsonObject groups = json["groups"].toObject();
  groups_ = names_of(groups["volumes"].toArray());
  mesh_groups_ =
      MeshGroups{groups_, names_of(groups["surfaces"].toArray()), names_of(groups["curves_and_points"].toArray()),
                 json["bodies"].toInt(), names_of(groups["sets"].toArray())};
  groups_of_ = mesh_asked_;
  form_->set_groups(mesh_groups_);
  tree_->set_groups(mesh_groups_);
  query_succeeded(Query::mesh);
  name_groups();
  view_->scene().set_surfaces(surfaces_of(json));
  mesh_words_->setText(QStringList{counted(json["elements"].toDouble(), tr("element"), tr("elements")),
                                   counted(json["nodes"].toDouble(), tr("node"), tr("nodes")),
                                   counted(json["bodies"].toDouble(), tr("body"), tr("bodies"))}
                           .join(", "));
  owner_.clear();
  preview_frame_ = {};
  if (!showing_results_) histogram_->set_frame({}, false);
  mesh_file_ = elements_file;
  if (!showing_results_) load_mesh();
}

/// Frames number the groups: their names are those of the case in hand, if that is what the run that is shown began
/// with.
void MainWindow::name_groups() {
  const bool has_its_names = !showing_results_ || is_run_with(run_->record(), document_.file(), document_.text());
  view_->scene().set_groups(has_its_names ? groups_ : std::vector<std::string>());
}

void MainWindow::load_mesh() {
  if (animation_ != nullptr) animation_->give_up(tr("the view shows something else"));
  loader_->start_model();
  view_->clear({});
  loader_->load(mesh_file_, 0);
}

/// Of a bar of the histogram.
void MainWindow::show_elements(vtkPolyData* faces, const QString& words) { view_->mark(faces, words); }

void MainWindow::show_laws(const QJsonObject& json) {
  query_succeeded(Query::joints);
  laws_ = json["laws"].toArray();
  laws_of_ = laws_asked_;
  laws_error_.clear();
  show_joint_law();
}

void MainWindow::show_parameters(const QJsonObject& json) {
  query_succeeded(Query::parameters);
  form_->set_parameters(mesh_parameters(json));
}

void MainWindow::show_division(const QJsonObject& json) {
  query_succeeded(Query::domains);
  domains_->show_division(json);
  owner_.clear();
  for (const QJsonValue& rank : json["owner"].toArray()) owner_.push_back(rank.toInt());
  if (preview_frame_.skin == nullptr || showing_results_) return;
  set_ranks(preview_frame_, owner_);
  view_->set_colouring(Colouring::rank);
  view_->show_frame(preview_frame_,
                    tr("mesh at rest, as %1 ranks would share it").arg(json["domains"].toArray().size()));
}

/// A problem with a place in the case is one of the case, at its field; others are shown until the query succeeds.
void MainWindow::query_failed(Query what, const QString& text, const std::vector<Problem>& problems,
                              const QByteArray& asked) {
  QStringList words{text};
  std::vector<Problem> placed;
  for (Problem p : problems) {
    place_in_case(p, document_);
    p.key.empty() ? static_cast<void>(words << QString::fromStdString(p.text())) : placed.push_back(p);
  }
  words.removeAll({});
  const QString trouble = words.isEmpty() ? QString() : tr("%1: %2").arg(words_of(what), words.join('\n'));
  const bool changed = messages_->set_trouble(words_of(what), trouble);
  const std::size_t known = problems_.size();
  told_.take(asked, placed);
  if (what == Query::joints) {
    laws_ = {};
    laws_of_ = laws_asked_;
    laws_error_ = words.join(' ');
  }
  validate();
  if (what == Query::check) run_panel_->set_estimate(tr("The check found problems; see the messages below."));
  if (what == Query::mesh && !showing_results_ && preview_frame_.skin == nullptr)
    view_->clear(tr("no mesh: see the messages"));
  const bool news = (changed && !words.isEmpty()) || problems_.size() > known;
  if (news) offer_dock("dock_messages");  // not each time that an edit leaves a problem as it is
}

}  // namespace breccia::gui
