#include <QAction>
#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QInputDialog>
#include <QJsonArray>
#include <QMessageBox>
#include <QStatusBar>
#include <algorithm>
#include <array>

#include "core/contact_pairs.hpp"
#include "core/mesh_parameters.hpp"
#include "core/own_files.hpp"
#include "core/value_text.hpp"
#include "widgets/animation_export.hpp"
#include "widgets/case_text.hpp"
#include "widgets/case_tree.hpp"
#include "widgets/condition_glyphs.hpp"
#include "widgets/conditions_panel.hpp"
#include "widgets/domains_panel.hpp"
#include "widgets/frame_loader.hpp"
#include "widgets/histogram_panel.hpp"
#include "widgets/joint_plot.hpp"
#include "widgets/library_dialog.hpp"
#include "widgets/main_window.hpp"
#include "widgets/problems_panel.hpp"
#include "widgets/property_form.hpp"
#include "widgets/results_panel.hpp"
#include "widgets/run_panel.hpp"
#include "widgets/start_page.hpp"
#include "widgets/view3d.hpp"

namespace breccia::gui {
namespace {

constexpr int kPreviewDelay = 1000;  // ms after the last edit

}  // namespace

void MainWindow::open_template(int number, bool run_it) {
  const std::vector<Template> list = templates(places_);
  if (number < 0 || number >= static_cast<int>(list.size()) || !may_leave_case()) return;
  QString error;
  const QString file = copy_template(list[static_cast<std::size_t>(number)], places_, &error);
  if (file.isEmpty()) {
    QMessageBox::warning(this, tr("Breccia"), error);
    return;
  }
  open_case(file);
  if (run_it) start_run();
}

void MainWindow::open_path(const QString& path) {
  if (QFileInfo(path).isDir()) {
    open_run(path);
  } else if (may_leave_case()) {
    open_case(path);
  }
}

void MainWindow::open_case(const QString& file) {
  if (const QString error = document_.open(file); !error.isEmpty()) {
    QMessageBox::warning(this, tr("Breccia"), error);
    return;
  }
  remove_orphans({document_.folder()});
  remember_file();
  look_at_disk();
  watch(nullptr);
  preview_frame_ = {};
  owner_.clear();
  mesh_text_.clear();
  mesh_file_.clear();
  groups_.clear();
  mesh_groups_.reset();
  form_->set_groups(mesh_groups_);
  tree_->set_groups(mesh_groups_);
  geometry_.reset();
  form_->set_parameters({});
  told_.clear();
  laws_ = {};
  laws_of_.clear();
  run_panel_->set_estimate(tr("Not checked yet."));
  estimated_.clear();
  messages_->set_advice({});
  view_->clear(tr("meshing..."));
  view_->forget_colours();
  show_workspace();
  tree_->select(0, {});
  stage_selected(tree_->stage(), tree_->path());
  validate();
  show_studies();
  attach_newest_run();
  offer_recovery(document_.file());
}

void MainWindow::show_title() {
  const QFileInfo file(document_.file());
  setWindowTitle(document_.is_open() ? tr("%1 (%2)[*] - Breccia").arg(file.fileName(), file.dir().dirName())
                                     : tr("Breccia"));
  setWindowModified(document_.is_open() && document_.modified());
  show_commands();
  show_actions();
}

void MainWindow::case_changed() {
  validation_.start();
  if (form_->section().startsWith("joint[")) law_.start();
}

void MainWindow::validate() {
  validation_.stop();
  if (!document_.is_open()) return;
  if (geometry_ != script_of(document_)) ask_parameters();
  problems_ = document_.problems();
  const bool readable = problems_.empty();
  if (readable) add_problems_of_mesh();
  tree_->set_problems(problems_);
  form_->set_problems(problems_);
  text_->set_problems(problems_);
  messages_->set_problems(problems_);
  run_panel_->set_problems(static_cast<int>(problems_.size()));
  show_actions();
  run_action_->setText(run_words(static_cast<int>(problems_.size())));
  if (readable) {
    loads_ = conditions_of(document_);
    conditions_->show_conditions(loads_);
    view_->scene().set_up(up_of(document_, loads_));
    show_loads();
  }
  if (side_->currentIndex() == 1 && !estimated_.isEmpty()) renew_estimate();
  if (readable && told_.are_of_another_text(document_)) estimate_.start(kPreviewDelay);
  if (form_->section().startsWith("joint[")) {
    if (problems_.empty() && laws_of_ != document_.text()) law_.start();
    show_joint_law();
  }
  if (!readable && mesh_text_.isEmpty() && !showing_results_)
    view_->clear(tr("no mesh yet: the case has problems, see the messages"));
  // The preview follows what the mesh is made of.
  if (const QString source = mesh_source(); readable && source != mesh_text_) {
    const bool first = mesh_text_.isEmpty();
    if (first && !showing_results_) view_->clear(tr("meshing..."));
    mesh_text_ = source;
    preview_.start(first ? 0 : kPreviewDelay);
  }
}

void MainWindow::add_problems_of_mesh() {
  if (mesh_groups_ && groups_of_ == mesh_source()) problems_ = document_.problems(mesh_groups_);
  const std::vector<Problem> others = told_.beside(problems_, document_);
  problems_.insert(problems_.end(), others.begin(), others.end());
}

QString MainWindow::mesh_source() const {
  QString source;
  for (const Place& place : document_.places().all())
    if (place.path.starts_with("mesh"))
      source += QString::fromStdString(place.path + "=" + std::string(document_.places().value(place.path)) + "\n");
  return source;
}

void MainWindow::ask_parameters() {
  geometry_ = script_of(document_);
  if (geometry_->isEmpty()) form_->set_parameters(std::vector<MeshParameter>());
  queries_.parameters();
}

void MainWindow::ask_mesh() {
  ask_parameters();  // the geometry may have been edited
  mesh_asked_ = mesh_source();
  queries_.mesh();
}

void MainWindow::ask_estimate() {
  estimate_.stop();
  estimated_ = document_.text();
  queries_.check();
}

/// Where it is of another text than that of the case.
void MainWindow::renew_estimate() {
  if (estimated_ == document_.text()) return;
  if (!estimated_.isEmpty())
    run_panel_->set_estimate(problems_.empty() ? tr("The case was edited: updating the estimate...")
                                               : tr("The case was edited, and has problems."));
  if (!problems_.empty()) return estimate_.stop();
  estimate_.start(estimated_.isEmpty() ? 0 : kPreviewDelay);
}

void MainWindow::stage_selected(int stage, const QString& path) {
  const WorkStage& chosen = work_stages()[static_cast<std::size_t>(stage)];
  using Kind = WorkStage::Kind;
  side_->setCurrentIndex(chosen.kind == Kind::sections ? 0 : chosen.kind == Kind::run ? 1 : 2);
  if (chosen.kind == Kind::sections) {
    form_->show_section(path);
    form_->set_problems(problems_);
    // The group that the section is about lights up.
    const QString key = document_.value(path + ".group").isEmpty() ? ".surface" : ".group";
    const QStringList names = names_in(document_.value(path + key));
    if (!names.isEmpty() && !showing_results_) view_->set_colouring(Colouring::group);
    show_groups(names);
    const bool domains = path == "domains";
    domains_->setVisible(domains);
    if (domains && owner_.empty() && problems_.empty()) queries_.domains(run_panel_->ranks());
    show_extras(path);
  }
  if (chosen.kind == Kind::run) {
    show_commands();
    if (run_ == nullptr || !run_->alive() || !estimated_.isEmpty()) renew_estimate();
    if (run_ != nullptr) show_dock("dock_plots");
  }
  show_loads();
  if (chosen.kind == Kind::results) {  // a terminal may have started one since
    run_ == nullptr&& document_.is_open() ? attach_newest_run() : find_runs_of_case();
  }
  const bool results = run_ != nullptr && chosen.kind != Kind::sections;
  if (results == showing_results_) return;
  showing_results_ = results;
  view_->show_results(results);
  name_groups();
  view_->scene().mark(nullptr);
  if (animation_ != nullptr) animation_->give_up(tr("the view shows something else"));
  loader_->start_model();
  if (results) {
    show_run_frames();
  } else if (!mesh_file_.isEmpty()) {
    load_mesh();
  } else if (preview_frame_.skin != nullptr) {
    view_->show_frame(preview_frame_, tr("mesh at rest"));
    histogram_->set_frame(preview_frame_, false);
  } else {
    view_->clear(queries_.busy() || preview_.isActive() ? tr("meshing...") : tr("no mesh: see the messages"));
    histogram_->set_frame({}, false);
  }
}

/// What belongs to a section beside its form.
void MainWindow::show_extras(const QString& path) {
  const QString section = QString::fromStdString(case_::pattern_of(path.toStdString()));
  const bool law = section.startsWith("joint[]");
  library_bar_->setVisible(section == "material[]");
  if (section == "contact[]") offer_dock("dock_contacts");
  if (section.startsWith("stage[]") || section == "initial_velocity[]") {
    offer_dock("dock_conditions");
    conditions_->choose(path);
  }
  if (!law) return;
  offer_dock("dock_law");
  law_.start();
  show_joint_law();
}

/// Where the entry of the joints in the form stood in the text that the curves are of; empty: it is new.
QString MainWindow::key_of_law() const {
  const std::string path = form_->section().section('.', 0, 0).toStdString();
  const TomlPlaces then(laws_of_.toStdString()), &now = document_.places();
  for (int i = 0; i < then.count("joint"); ++i) {
    const std::string before = "joint[" + std::to_string(i) + "]";
    const auto alike = [&](const char* key) { return then.value(before + key) == now.value(path + key); };
    if (alike(".group") && alike(".between")) return QString::fromStdString(before);
  }
  return {};
}

void MainWindow::show_joint_law() {
  const QString key = key_of_law();
  for (const QJsonValue& law : laws_)
    if (law.toObject()["key"].toString() == key) return joint_plot_->show_law(law.toObject(), {});
  joint_plot_->show_law({}, no_law_words());
}

QString MainWindow::no_law_words() const {
  if (!problems_.empty()) return tr("The curves follow once the problems of the case are solved (F8).");
  if (laws_of_ != document_.text()) return tr("the solver works out the curves...");
  if (!laws_error_.isEmpty()) return tr("The solver could not work out the curves: %1").arg(laws_error_);
  return tr("This law has no curve: its joints cannot break.");
}

void MainWindow::show_groups(const QStringList& groups) {
  std::vector<std::string> names;
  for (const QString& group : groups) names.push_back(group.toStdString());
  view_->scene().highlight(names);
  view_->render();
}

/// Those of the stage in hand are seen while its form is.
void MainWindow::show_loads() {
  const QString path = form_->section();
  std::vector<Load> seen;
  const bool begins = path.startsWith("initial_velocity["), in_stage = path.startsWith("stage[");
  const int stage = in_stage ? path.section('[', 1).section(']', 0, 0).toInt() : 0;
  for (const Condition& row : loads_) {
    const bool in_hand = row.number == stage || (row.number < 0 && stage == 0);
    if ((!begins && !in_stage) || side_->currentIndex() != 0 || !in_hand) continue;
    const std::vector<Load> own = glyphs_of(row);
    seen.insert(seen.end(), own.begin(), own.end());
  }
  view_->set_loads(std::move(seen));
}

/// A click takes a group into the field that waits for one; else it leads to the conditions on the face where those are
/// worked at, and to the material anywhere else.
void MainWindow::picked(const Scene::Picked& what) {
  const QString group = QString::fromStdString(what.volume);
  QStringList surfaces;
  for (const std::string& name : what.surfaces) surfaces << QString::fromStdString(name);
  if (form_->take_pick(group, surfaces) || showing_results_) return;
  const QString section = form_->section();
  if (section.startsWith("stage[") || section.startsWith("initial_velocity[")) {
    if (!conditions_->choose_targets(surfaces) && !conditions_->choose_targets({group})) {
      statusBar()->showMessage(
          tr("No load or constraint acts on %1").arg((surfaces + QStringList{group}).join(tr(" or "))), 5000);
    }
    show_groups(surfaces.isEmpty() ? QStringList{group} : surfaces);
    return;
  }
  if (const QString path = material_entry_of(document_, group); !path.isEmpty())
    tree_->select(stage_of(path.toStdString()), path);
}

void MainWindow::take_from_library() {
  const QString path = form_->section();
  LibraryDialog dialog(library_, shown_value(case_::key_of("material[].group"), document_.value(path + ".group")),
                       this);
  if (dialog.exec() == QDialog::Accepted && dialog.chosen() != nullptr)
    take_material(document_, path, *dialog.chosen());
}

void MainWindow::add_to_library() {
  const QString path = form_->section();
  bool good = false;
  const QString name =
      QInputDialog::getText(this, tr("Into my library"), tr("Name of the material"), QLineEdit::Normal,
                            shown_value(case_::key_of("material[].group"), document_.value(path + ".group")), &good);
  if (!good || name.trimmed().isEmpty()) return;
  if (const QString error = library_.add(material_of(document_, path, name.trimmed())); !error.isEmpty())
    QMessageBox::warning(this, tr("Breccia"), error);
}

void MainWindow::go_to(const QString& key, int line) {
  tree_->select(stage_of(key.toStdString()), key);
  form_->focus_field(key);
  if (line > 0) text_->go_to_line(line);
}

}  // namespace breccia::gui
