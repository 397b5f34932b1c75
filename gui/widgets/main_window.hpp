#pragma once

#include <QAction>
#include <QHash>
#include <QJsonArray>
#include <QLockFile>
#include <QMainWindow>
#include <QStackedWidget>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

#include "core/case_queries.hpp"
#include "core/conditions.hpp"
#include "core/document.hpp"
#include "core/material_library.hpp"
#include "core/places.hpp"
#include "core/solver_problems.hpp"
#include "core/study.hpp"
#include "render/frame_data.hpp"
#include "render/scene.hpp"
#include "widgets/window_memory.hpp"

class QAction;
class QLabel;
class QProgressBar;
class QVBoxLayout;

namespace breccia::gui {

class AnimationExport;
class CaseText;
class CaseTree;
class ConditionsPanel;
class ContactMatrix;
class DomainsPanel;
class FrameLoader;
class JointPlot;
class ParaViewResults;
class PlotsPanel;
class ProblemsPanel;
class PropertyForm;
class HistogramPanel;
class QueuePanel;
class ReportMaker;
class ResultsPanel;
class RunPanel;
class RunsPanel;
class StartPage;
class StudyPanel;
class View3D;

/// The one window: stages left, 3D in the middle, properties right, docks below. It joins the parts; what they do is
/// theirs, and what the case means is the solver's.
class MainWindow final : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(Places places, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// A case file or the folder of a run.
  void open_path(const QString& path);
  [[nodiscard]] Document& document() { return document_; }
  [[nodiscard]] View3D& view() { return *view_; }
  [[nodiscard]] SolverRun* run() { return run_; }
  [[nodiscard]] bool busy() const;
  /// Offers what a session that was killed has left. @param of  a case, which is open; empty: any
  void offer_recovery(const QString& of = {});
  void set_dark(bool dark);
  [[nodiscard]] bool dark() const { return dark_->isChecked(); }
  /// Light or dark was chosen in an earlier session.
  [[nodiscard]] bool remembers_colours() const { return memory_.dark().has_value(); }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void changeEvent(QEvent* event) override;
  /// The key of Tab goes from the stages to the form, the view and the panel in front, never into one behind it, where
  /// nothing is seen of what is typed.
  bool focusNextPrevChild(bool next) override;

 private:
  // main_window.cpp: construction
  void make_panels();
  void make_docks();
  void add_dock(QWidget* widget, const QString& title, const QString& name);
  void make_extras(QVBoxLayout& column);
  void make_actions();  // main_window_actions.cpp
  void join_panels();
  /// Updates which actions are enabled; disabled ones state that they need a case or a run.
  void show_actions();
  [[nodiscard]] std::vector<QWidget*> tab_order() const;

  // main_window_layout.cpp
  void arrange_docks();
  void take_default_size();
  void remember_arrangement();
  void keep_arrangement();
  void reset_arrangement();
  void show_start();
  void show_workspace();
  void show_all_docks();
  void show_dock(const QString& name);
  /// The same, but never away from the text that is being typed.
  void offer_dock(const QString& name);

  // main_window_case.cpp: the case in hand
  void remember_run(const RunRecord& record);
  void ask_estimate();
  void renew_estimate();
  void open_template(int number, bool run_it);
  void open_case(const QString& file);
  void case_changed();
  void validate();
  /// What depends on the mesh: names of groups, and what the solver's commands have found.
  void add_problems_of_mesh();
  /// What the mesh of the case is made of.
  [[nodiscard]] QString mesh_source() const;
  void ask_mesh();
  /// Queries the parameters of the geometry, if it is another one than at the last query.
  void ask_parameters();
  void stage_selected(int stage, const QString& path);
  void go_to(const QString& key, int line);
  void show_title();
  void show_extras(const QString& path);
  void show_joint_law();
  [[nodiscard]] QString key_of_law() const;
  /// Why there is no curve of the law in hand.
  [[nodiscard]] QString no_law_words() const;
  void picked(const Scene::Picked& what);
  void show_groups(const QStringList& groups);
  void show_loads();
  void open_guide();
  void take_from_library();
  void add_to_library();

  // main_window_file.cpp: the file of the case, and stored edits
  /// Reports that something cannot be stored, once until it can. @param error  empty: it can
  void tell_trouble(const QString& what, const QString& words, const QString& error);
  void remember_file();
  [[nodiscard]] bool save();
  void save_as();
  void look_at_disk();
  /// Reports whether another window has the case open.
  void claim_case();
  [[nodiscard]] bool agrees_with_disk();
  /// Another program has changed the file: the user chooses the version to keep. False: no choice was made.
  [[nodiscard]] bool settle_with_disk();
  [[nodiscard]] bool may_leave_case();

  // main_window_import.cpp: a solid becomes a case
  void import_geometry();
  void join_import();
  void take_geometry(const QJsonObject& mesh);

  // main_window_answers.cpp: reports of the solver on the case
  void show_check(const QJsonObject& json);
  void show_mesh(const QJsonObject& json, const QString& elements_file);
  void name_groups();
  void load_mesh();
  void show_elements(vtkPolyData* faces, const QString& words);
  void show_division(const QJsonObject& json);
  void show_laws(const QJsonObject& json);
  void show_parameters(const QJsonObject& json);
  /// A query succeeded: former problems of this query are obsolete.
  void query_succeeded(Query what);
  void query_failed(Query what, const QString& text, const std::vector<Problem>& problems, const QByteArray& asked);

  // main_window_queue.cpp: runs that wait, alone or as a study
  void queue_run();
  void start_worker();
  void take_queue();
  void start_study(const std::vector<StudyParameter>& parameters);
  void show_studies();

  // main_window_runs.cpp: runs and their results
  void start_run();
  void go_on_with_run();
  /// Whether to resume the run that is shown although its case has been edited since. It may start a new one instead.
  [[nodiscard]] bool resumes_as_it_was_run();
  /// More ranks than cores need the user's agreement, which is requested where they are set.
  [[nodiscard]] bool ranks_are_accepted();
  void pause_or_resume();
  void show_commands();
  void take_run(SolverRun* run);
  void open_run(const QString& path);
  void open_other_run();
  /// Searches for the runs of the case, from any window or terminal.
  void find_runs_of_case();
  void list_runs_of_case();
  /// The one that is watched, or is from now on.
  SolverRun* run_in(const QString& folder);
  void attach_newest_run();
  [[nodiscard]] bool open_case_of(const RunRecord& record);
  void find_runs();
  void watch(SolverRun* run);
  void show_run_frames();
  void load_frame_of_run(const RunFrame& frame);
  [[nodiscard]] QString no_frame_words() const;
  void offer_fragments();
  void run_changed();
  void run_ended(const SolverRun* run);
  void show_frame(const FrameData& frame);

  // main_window_exports.cpp
  void open_paraview();
  void watch_live();
  void compare(const std::vector<SolverRun*>& others);
  void show_curves();
  void export_curves();
  void export_study();
  void write_curves();
  [[nodiscard]] QString table_name(const QString& title, const QString& suggested);
  void write_table(const QString& name, const QByteArray& text);
  [[nodiscard]] QString film_name();
  void save_animation();
  void end_animation();
  void save_picture();
  void make_report();
  void report_made(const QString& file, const QString& error, const QString& notes);
  [[nodiscard]] QString new_run_folder() const;
  [[nodiscard]] QStringList command_line() const;

  Places places_;
  WindowMemory memory_;
  QByteArray layout_;  ///< of the docks while the start page hides them; empty: as they are made
  Document document_;
  std::unique_ptr<QLockFile> claim_;  ///< locked while the case is open here
  QString claimed_;                   ///< file of that lock; empty: none
  CaseQueries queries_;
  SolverQuery import_;
  QString imported_;  ///< file of the dialog import_
  RunRegistry registry_;
  RunQueue queue_;
  QStringList waiting_;  ///< folders of the runs that waited when the queue was last read
  UserLibrary library_;
  std::vector<SolverRun*> runs_, compared_;
  SolverRun* run_ = nullptr;  ///< the one that is shown
  FrameLoader* loader_;
  ParaViewResults* paraview_;
  AnimationExport* animation_ = nullptr;
  ReportMaker* report_;
  std::vector<RunOrigin> beside_;   ///< runs of the case, at the last search
  QHash<QString, QString> states_;  ///< of those, by folder, at the last search
  QString curves_file_;             ///< of the table that waits for the histories; empty: none
  QTimer validation_, preview_, law_, estimate_;
  QByteArray estimated_;  ///< text of the case that the estimate is of; empty: none was requested
  std::vector<Problem> problems_;
  SolverProblems told_;     ///< that the solver's commands have found
  std::vector<int> owner_;  ///< rank of each element of the preview
  FrameData preview_frame_;
  bool showing_results_ = false, run_when_checked_ = false;
  std::vector<Condition> loads_;     ///< of the case, as last read
  QJsonArray laws_;                  ///< of joints, as last reported
  QByteArray laws_asked_, laws_of_;  ///< text of the case at the query; of the reported laws
  QString laws_error_;               ///< error of the query
  std::optional<QString> geometry_;  ///< .geo whose parameters the form has, or will; none: not queried yet
  QString mesh_text_;                ///< what the preview was made of
  QString mesh_asked_, groups_of_;   ///< source of the mesh query; source of the groups
  std::optional<MeshGroups> mesh_groups_;
  QString mesh_file_;                ///< its elements, until they have been read
  std::vector<std::string> groups_;  ///< names of the volume groups of the preview

  StartPage* start_ = nullptr;
  CaseTree* tree_ = nullptr;
  PropertyForm* form_ = nullptr;
  CaseText* text_ = nullptr;
  View3D* view_ = nullptr;
  PlotsPanel* plots_ = nullptr;
  ProblemsPanel* messages_ = nullptr;
  RunPanel* run_panel_ = nullptr;
  RunsPanel* runs_panel_ = nullptr;
  HistogramPanel* histogram_ = nullptr;
  QueuePanel* queue_panel_ = nullptr;
  StudyPanel* study_panel_ = nullptr;
  DomainsPanel* domains_ = nullptr;
  ResultsPanel* results_ = nullptr;
  QStackedWidget *centre_ = nullptr, *side_ = nullptr;
  QWidget* library_bar_ = nullptr;
  JointPlot* joint_plot_ = nullptr;
  ContactMatrix* contacts_ = nullptr;
  ConditionsPanel* conditions_ = nullptr;
  std::vector<QAction*> needs_case_, needs_run_, needs_alive_;
  QAction *dark_ = nullptr, *resume_action_ = nullptr, *run_action_ = nullptr, *queue_action_ = nullptr;
  QLabel *busy_ = nullptr, *mesh_words_ = nullptr, *run_words_ = nullptr;
  QProgressBar* run_bar_ = nullptr;
};

}  // namespace breccia::gui
