#include "widgets/main_window.hpp"

#include <QAction>
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "core/own_files.hpp"
#include "core/report_maker.hpp"
#include "widgets/case_text.hpp"
#include "widgets/case_tree.hpp"
#include "widgets/conditions_panel.hpp"
#include "widgets/contact_matrix.hpp"
#include "widgets/domains_panel.hpp"
#include "widgets/frame_loader.hpp"
#include "widgets/histogram_panel.hpp"
#include "widgets/joint_plot.hpp"
#include "widgets/named_button.hpp"
#include "widgets/paraview_results.hpp"
#include "widgets/plots_panel.hpp"
#include "widgets/problems_panel.hpp"
#include "widgets/property_form.hpp"
#include "widgets/queue_panel.hpp"
#include "widgets/results_panel.hpp"
#include "widgets/run_panel.hpp"
#include "widgets/runs_panel.hpp"
#include "widgets/start_page.hpp"
#include "widgets/study_panel.hpp"
#include "widgets/theme.hpp"
#include "widgets/view3d.hpp"
#include "widgets/wheel_guard.hpp"

namespace breccia::gui {
namespace {

constexpr int kValidationDelay = 150, kLawDelay = 500;  // ms after the last edit
constexpr int kBetweenWords = 16;                       // pixels in the status bar

/// The dock in which a widget stands, if it does in one.
const QDockWidget* dock_of(const QWidget& widget) {
  for (const QWidget* up = &widget; up != nullptr; up = up->parentWidget())
    if (const auto* dock = qobject_cast<const QDockWidget*>(up)) return dock;
  return nullptr;
}

/// Qt calls a dock behind others visible, though it lies outside of the window.
bool takes_tab(const QWidget& widget) {
  if ((widget.focusPolicy() & Qt::TabFocus) == 0 || widget.focusProxy() != nullptr) return false;
  if (!widget.isVisible() || !widget.isEnabled()) return false;
  const QDockWidget* dock = dock_of(widget);
  return dock == nullptr || !dock->visibleRegion().isEmpty();
}

}  // namespace

MainWindow::MainWindow(Places places, QWidget* parent)
    : QMainWindow(parent),
      places_(std::move(places)),
      memory_(places_.state),
      document_(places_.state),
      queries_(document_, places_.launch.program),
      registry_(places_.state + "/runs.json"),
      queue_(places_.state),
      library_(places_.state + "/materials.toml"),
      loader_(new FrameLoader(this)),
      paraview_(new ParaViewResults(this)),
      report_(new ReportMaker(this)) {
  setObjectName("main_window");
  take_default_size();
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  make_panels();
  make_docks();
  make_actions();
  join_panels();
  QStringList folders{QDir::tempPath()};
  for (const QString& file : recent_cases(places_)) folders << QFileInfo(file).absolutePath();
  folders.removeDuplicates();
  remove_orphans(folders);
  find_runs();
  queue_panel_->look();
  show_start();
  show_actions();
  remember_arrangement();
  qApp->installEventFilter(new WheelGuard(this));
}

/// Hidden children pass the focus on, and a field that loses it reads the document, which must still exist.
MainWindow::~MainWindow() { hide(); }

bool MainWindow::busy() const { return queries_.busy() || import_.busy() || loader_->busy() || histogram_->busy(); }

void MainWindow::make_panels() {
  start_ = new StartPage(places_);
  tree_ = new CaseTree(document_);
  form_ = new PropertyForm(document_);
  text_ = new CaseText(document_);
  view_ = new View3D;
  plots_ = new PlotsPanel;
  messages_ = new ProblemsPanel(document_);
  joint_plot_ = new JointPlot;
  contacts_ = new ContactMatrix(document_);
  conditions_ = new ConditionsPanel;
  histogram_ = new HistogramPanel;
  run_panel_ = new RunPanel;
  runs_panel_ = new RunsPanel;
  queue_panel_ = new QueuePanel(queue_);
  study_panel_ = new StudyPanel(document_, queue_);
  domains_ = new DomainsPanel;
  results_ = new ResultsPanel;
  centre_ = new QStackedWidget;
  centre_->addWidget(start_);
  centre_->addWidget(view_);
  setCentralWidget(centre_);
  side_ = new QStackedWidget;
  side_->setMinimumWidth(300);
  auto* forms = new QWidget;
  auto* column = new QVBoxLayout(forms);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(form_, 1);
  column->addWidget(domains_);
  domains_->hide();
  make_extras(*column);
  side_->addWidget(forms);
  for (QWidget* page : {static_cast<QWidget*>(run_panel_), static_cast<QWidget*>(results_)}) {
    auto* area = new QScrollArea;  // on a small screen nothing is cut off
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setFocusPolicy(Qt::NoFocus);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setWidget(page);
    side_->addWidget(area);
  }
  busy_ = new QLabel;
  busy_->setIndent(kBetweenWords);
  mesh_words_ = new QLabel;
  run_words_ = new QLabel;
  run_bar_ = new QProgressBar;
  run_bar_->setRange(0, 1000);
  run_bar_->setMaximumWidth(160);
  run_bar_->setAccessibleName(tr("Progress of the run"));
  run_bar_->setToolTip(tr("Share of the simulated time"));
  run_bar_->hide();
  statusBar()->addWidget(mesh_words_);
  statusBar()->addWidget(busy_);
  statusBar()->addPermanentWidget(run_words_);
  statusBar()->addPermanentWidget(run_bar_);
}

/// What stands below the form of some sections.
void MainWindow::make_extras(QVBoxLayout& column) {
  library_bar_ = new QWidget;
  auto* row = new QHBoxLayout(library_bar_);
  const auto add = [row](const QString& text, const QString& name, const QString& tip) {
    QPushButton* button = named_button(text, name, tip);
    row->addWidget(button);
    return button;
  };
  connect(add(tr("From the li&brary..."), "from_library",
              tr("Values of rocks, concretes, glasses, ceramics, metals and ice, each with its source")),
          &QPushButton::clicked, this, &MainWindow::take_from_library);
  connect(add(tr("Into &my library..."), "into_library", tr("Keeps the values of this material for other cases")),
          &QPushButton::clicked, this, &MainWindow::add_to_library);
  column.addWidget(library_bar_);
  library_bar_->hide();
}

void MainWindow::add_dock(QWidget* widget, const QString& title, const QString& name) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName(name);
  dock->setWidget(widget);
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable |
                    QDockWidget::DockWidgetFloatable);
}

void MainWindow::make_docks() {
  add_dock(tree_, tr("Stages"), "dock_stages");
  add_dock(side_, tr("Properties"), "dock_properties");
  add_dock(messages_, tr("Messages"), "dock_messages");
  add_dock(plots_, tr("Plots"), "dock_plots");
  add_dock(text_, tr("Text"), "dock_text");
  add_dock(runs_panel_, tr("Runs"), "dock_runs");
  add_dock(queue_panel_, tr("Queue"), "dock_queue");
  add_dock(study_panel_, tr("Study"), "dock_study");
  add_dock(histogram_, tr("Histogram"), "dock_histogram");
  add_dock(conditions_, tr("Conditions"), "dock_conditions");
  add_dock(contacts_, tr("Contacts"), "dock_contacts");
  add_dock(joint_plot_, tr("Joint law"), "dock_law");
  arrange_docks();
}

void MainWindow::set_dark(bool dark) {
  apply_theme(dark);
  dark_->setChecked(dark);
  view_->set_dark(dark);
  plots_->set_dark(dark);
}

void MainWindow::join_panels() {
  domains_->set_ranks(run_panel_->ranks());
  validation_.setSingleShot(true);
  validation_.setInterval(kValidationDelay);
  preview_.setSingleShot(true);
  connect(&validation_, &QTimer::timeout, this, &MainWindow::validate);
  connect(&preview_, &QTimer::timeout, this, &MainWindow::ask_mesh);
  law_.setSingleShot(true);
  law_.setInterval(kLawDelay);
  connect(&law_, &QTimer::timeout, this, [this] {
    if (!problems_.empty() || !form_->section().startsWith("joint[")) return;
    laws_asked_ = document_.text();
    queries_.joints();
  });
  connect(&queries_, &CaseQueries::joints_told, this, &MainWindow::show_laws);
  connect(&queries_, &CaseQueries::parameters_told, this, &MainWindow::show_parameters);
  connect(&document_, &Document::changed, this, &MainWindow::case_changed);
  connect(&document_, &Document::snapshot_tried, this, [this](const QString& error) {
    tell_trouble("snapshot", tr("Unsaved edits are not kept against a crash; save the case"), error);
  });
  connect(&document_, &Document::renamed, this, &MainWindow::show_title);
  connect(&document_, &Document::modification_changed, this, &MainWindow::show_title);
  connect(&queries_, &CaseQueries::checked, this, &MainWindow::show_check);
  connect(&queries_, &CaseQueries::meshed, this, &MainWindow::show_mesh);
  connect(&queries_, &CaseQueries::divided, this, &MainWindow::show_division);
  connect(&queries_, &CaseQueries::failed, this, &MainWindow::query_failed);
  connect(&queries_, &CaseQueries::busy_changed, this,
          [this] { busy_->setText(queries_.busy() ? tr("waiting for the solver...") : QString()); });
  connect(loader_, &FrameLoader::loaded, this, &MainWindow::show_frame);
  connect(loader_, &FrameLoader::loaded, results_, &ResultsPanel::frame_shown);
  connect(start_, &StartPage::template_chosen, this, [this](int n) { open_template(n, false); });
  connect(start_, &StartPage::demo_wanted, this, [this] { open_template(0, true); });
  connect(start_, &StartPage::case_chosen, this, &MainWindow::open_path);
  connect(start_, &StartPage::run_chosen, this, &MainWindow::open_run);
  connect(start_, &StartPage::open_wanted, this, [this] {
    const QString name = QFileDialog::getOpenFileName(this, tr("Open a case"), places_.projects, tr("Cases (*.toml)"));
    if (!name.isEmpty()) open_path(name);
  });
  join_import();
  connect(start_, &StartPage::import_wanted, this, &MainWindow::import_geometry);
  connect(tree_, &CaseTree::selected, this, &MainWindow::stage_selected);
  connect(text_, &CaseText::line_entered, this, [this](int line) {
    const std::string path = document_.places().path_at_line(line);
    const int stage = stage_of(path);
    if (!path.empty() && work_stages()[static_cast<std::size_t>(tree_->stage())].kind == WorkStage::Kind::sections)
      tree_->select(stage, QString::fromStdString(path));
  });
  connect(messages_, &ProblemsPanel::place_wanted, this, &MainWindow::go_to);
  const auto show_group = [this](const QString& group) {
    view_->scene().highlight({group.toStdString()});
    view_->render();
  };
  connect(form_, &PropertyForm::group_entered, this, show_group);
  const auto show_entry = [this](const QString& path) { tree_->select(stage_of(path.toStdString()), path); };
  connect(contacts_, &ContactMatrix::entry_wanted, this, show_entry);
  connect(contacts_, &ContactMatrix::group_entered, this, show_group);
  connect(histogram_, &HistogramPanel::elements_chosen, this, &MainWindow::show_elements);
  connect(conditions_, &ConditionsPanel::entry_wanted, this, show_entry);
  connect(conditions_, &ConditionsPanel::groups_chosen, this, &MainWindow::show_groups);
  connect(form_, &PropertyForm::pick_wanted, view_, &View3D::set_picking);
  connect(view_, &View3D::colouring_changed, histogram_, &HistogramPanel::follow);
  connect(view_, &View3D::deformation_chosen, this, [this] {
    loader_->forget_scale();
    results_->ask_again();
  });
  connect(view_, &View3D::picked, this, &MainWindow::picked);
  connect(run_panel_, &RunPanel::run_wanted, this, &MainWindow::start_run);
  connect(run_panel_, &RunPanel::queue_wanted, this, &MainWindow::queue_run);
  connect(run_panel_, &RunPanel::check_wanted, this, &MainWindow::ask_estimate);
  estimate_.setSingleShot(true);
  connect(&estimate_, &QTimer::timeout, this, &MainWindow::ask_estimate);
  connect(run_panel_, &RunPanel::stop_wanted, this, [this] {
    if (run_ != nullptr) run_->stop();
  });
  connect(run_panel_, &RunPanel::pause_wanted, this, &MainWindow::pause_or_resume);
  connect(run_panel_, &RunPanel::checkpoint_wanted, this, [this] {
    if (run_ != nullptr) run_->checkpoint();
  });
  connect(run_panel_, &RunPanel::go_on_wanted, this, &MainWindow::go_on_with_run);
  connect(run_panel_, &RunPanel::results_wanted, this,
          [this] { tree_->select(static_cast<int>(work_stages().size()) - 1, {}); });
  connect(run_panel_, &RunPanel::ranks_changed, this, [this](int n) {
    show_commands();
    domains_->set_ranks(n);
  });
  connect(domains_, &DomainsPanel::division_wanted, this, [this](int n) { queries_.domains(n); });
  connect(runs_panel_, &RunsPanel::run_chosen, this, &MainWindow::open_run);
  connect(runs_panel_, &RunsPanel::comparison_wanted, this, [this](const QStringList& folders) {
    std::vector<SolverRun*> others;
    for (SolverRun* run : runs_)
      if (folders.contains(run->record().folder)) others.push_back(run);
    compare(others);
  });
  connect(queue_panel_, &QueuePanel::changed, this, &MainWindow::take_queue);
  connect(queue_panel_, &QueuePanel::change_tried, this,
          [this](const QString& error) { tell_trouble("queue", tr("The queue stays as it was"), error); });
  connect(queue_panel_, &QueuePanel::worker_wanted, this, &MainWindow::start_worker);
  connect(queue_panel_, &QueuePanel::run_chosen, this, &MainWindow::open_run);
  connect(queue_panel_, &QueuePanel::stop_wanted, this, [this](const QString& folder) {
    queue_panel_->changed_with(queue_.note_stop(folder));  // the list shows how the run ended, for any files it leaves
    for (SolverRun* run : runs_)
      if (run->record().folder == folder) run->stop();
  });
  connect(study_panel_, &StudyPanel::start_wanted, this, &MainWindow::start_study);
  connect(study_panel_, &StudyPanel::export_wanted, this, &MainWindow::export_study);
  connect(study_panel_, &StudyPanel::run_chosen, this, &MainWindow::open_run);
  connect(results_, &ResultsPanel::curves_wanted, this, &MainWindow::export_curves);
  connect(results_, &ResultsPanel::run_chosen, this, [this](const QString& folder) {
    watch(run_in(folder));
    show_dock("dock_plots");
  });
  connect(results_, &ResultsPanel::other_run_wanted, this, &MainWindow::open_other_run);
  connect(results_, &ResultsPanel::report_wanted, this, &MainWindow::make_report);
  connect(report_, &ReportMaker::done, this, &MainWindow::report_made);
  connect(results_, &ResultsPanel::animation_wanted, this, &MainWindow::save_animation);
  connect(results_, &ResultsPanel::frame_wanted, this, [this](int n) {
    // A stage of the case shows the mesh at rest, also while a run writes frames.
    if (!showing_results_ || run_ == nullptr || n >= static_cast<int>(run_->frames().size())) return;
    load_frame_of_run(run_->frames()[static_cast<std::size_t>(n)]);
  });
  connect(results_, &ResultsPanel::paraview_wanted, this, &MainWindow::open_paraview);
  connect(paraview_, &ParaViewResults::failed, this, [this](const QString& error) {
    QMessageBox::warning(this, tr("Breccia"), tr("ParaView could not be started: %1").arg(error));
  });
  connect(results_, &ResultsPanel::picture_wanted, this, &MainWindow::save_picture);
}

/// By regions of the window; in each of them in the order in which its widgets were made.
std::vector<QWidget*> MainWindow::tab_order() const {
  enum Region { stages, properties, centre, others, docks, count };
  const auto region_of = [this](const QWidget& widget) {
    const QDockWidget* dock = dock_of(widget);
    if (dock == nullptr) return centre_->isAncestorOf(&widget) ? centre : others;
    return dock->objectName() == "dock_stages" ? stages : dock->objectName() == "dock_properties" ? properties : docks;
  };
  std::array<std::vector<QWidget*>, count> regions;
  for (QWidget* w = nextInFocusChain(); w != this; w = w->nextInFocusChain())
    if (w->window() == this && takes_tab(*w)) regions[region_of(*w)].push_back(w);
  std::vector<QWidget*> order;
  for (const std::vector<QWidget*>& region : regions) order.insert(order.end(), region.begin(), region.end());
  return order;
}

bool MainWindow::focusNextPrevChild(bool next) {
  const std::vector<QWidget*> order = tab_order();
  if (order.empty()) return false;
  const auto place_of = [&](QWidget* w) { return std::find(order.begin(), order.end(), w); };
  QWidget* now = focusWidget();  // a part of a widget, as the line of a box, counts as that widget
  while (now != nullptr && place_of(now) == order.end()) now = now->parentWidget();
  const std::size_t n = order.size();
  std::size_t at = next ? 0 : n - 1;
  if (now != nullptr) at = (static_cast<std::size_t>(place_of(now) - order.begin()) + (next ? 1 : n - 1)) % n;
  order[at]->setFocus(next ? Qt::TabFocusReason : Qt::BacktabFocusReason);
  return true;
}

void MainWindow::changeEvent(QEvent* event) {
  if (event->type() == QEvent::ActivationChange && isActiveWindow()) {  // back from another program
    look_at_disk();
    if (!told_.empty()) ask_estimate();  // which may have mended the geometry
  }
  QMainWindow::changeEvent(event);
}

}  // namespace breccia::gui
