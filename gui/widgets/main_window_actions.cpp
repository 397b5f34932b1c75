#include <QAction>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>

#include "widgets/keys_dialog.hpp"
#include "widgets/main_window.hpp"
#include "widgets/problems_panel.hpp"
#include "widgets/property_form.hpp"
#include "widgets/view3d.hpp"

namespace breccia::gui {

void MainWindow::make_actions() {
  auto* bar = addToolBar(tr("Main"));
  bar->setObjectName("main_bar");
  bar->setToolButtonStyle(Qt::ToolButtonTextOnly);
  const auto add = [this, bar](QMenu* menu, const QString& text, const QKeySequence& keys, const auto& slot,
                               bool on_bar) {
    QAction* action = menu->addAction(text);
    action->setShortcut(keys);
    action->setToolTip(QString(text).remove('&').remove("...") +
                       (keys.isEmpty() ? "" : " (" + keys.toString(QKeySequence::NativeText) + ")"));
    connect(action, &QAction::triggered, this, slot);
    if (on_bar) bar->addAction(action);
    return action;
  };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  add(
      file, tr("&New from a template..."), QKeySequence::New,
      [this] {
        if (may_leave_case()) show_start();
      },
      true);
  add(
      file, tr("&Open..."), QKeySequence::Open,
      [this] {
        const QString name = QFileDialog::getOpenFileName(
            this, tr("Open a case"), document_.is_open() ? document_.folder() : places_.projects, tr("Cases (*.toml)"));
        if (!name.isEmpty()) open_path(name);
      },
      true);
  add(
      file, tr("&Import a geometry..."), QKeySequence("Ctrl+I"), [this] { import_geometry(); }, false);
  add(
      file, tr("Open &results..."), QKeySequence("Ctrl+Shift+O"), [this] { open_other_run(); }, false);
  needs_case_.push_back(add(
      file, tr("&Save"), QKeySequence::Save, [this] { (void)save(); }, true));
  needs_case_.push_back(add(
      file, tr("Save &as..."), QKeySequence::SaveAs, [this] { save_as(); }, false));
  file->addSeparator();
  add(
      file, tr("&Quit"), QKeySequence::Quit, [this] { close(); }, false);
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  QAction* undo = document_.undo_stack().createUndoAction(this, tr("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = document_.undo_stack().createRedoAction(this, tr("&Redo"));
  QList<QKeySequence> redo_keys = QKeySequence::keyBindings(QKeySequence::Redo);
  if (const QKeySequence other("Ctrl+Y"); !redo_keys.contains(other)) redo_keys << other;
  redo->setShortcuts(redo_keys);
  edit->addActions({undo, redo});
  add(
      edit, tr("Next &problem"), Qt::Key_F8, [this] { messages_->next_problem(); }, false);
  QMenu* run = menuBar()->addMenu(tr("&Run"));
  needs_case_.push_back(add(
      run, tr("&Mesh"), Qt::Key_F6,
      [this] {
        form_->take_typed();
        ask_mesh();
      },
      true));
  needs_case_.push_back(add(
      run, tr("&Check"), Qt::Key_F7,
      [this] {
        form_->take_typed();
        ask_estimate();
      },
      true));
  run_action_ = add(
      run, tr("&Run"), Qt::Key_F5, [this] { start_run(); }, true);
  queue_action_ = add(
      run, tr("Add to the &queue"), QKeySequence("Ctrl+Shift+F5"), [this] { queue_run(); }, false);
  needs_alive_.push_back(add(
      run, tr("&Pause or resume"), Qt::Key_F4, [this] { pause_or_resume(); }, false));
  needs_alive_.push_back(add(
      run, tr("Check&point"), QKeySequence("Shift+F4"),
      [this] {
        if (run_ != nullptr && run_->alive()) run_->checkpoint();
      },
      false));
  resume_action_ = add(
      run, tr("Resu&me from checkpoint"), QKeySequence("Ctrl+F5"), [this] { go_on_with_run(); }, false);
  needs_alive_.push_back(add(
      run, tr("&Stop"), QKeySequence("Shift+F5"),
      [this] {
        if (run_ != nullptr) run_->stop();
      },
      true));
  QMenu* view = menuBar()->addMenu(tr("&View"));
  for (QDockWidget* dock : findChildren<QDockWidget*>()) view->addAction(dock->toggleViewAction());
  view->addSeparator();
  add(
      view, tr("&Reset layout"), {}, [this] { reset_arrangement(); }, false);
  dark_ = add(
      view, tr("&Dark"), QKeySequence("Ctrl+D"),
      [this](bool on) {
        set_dark(on);
        memory_.set_dark(on);
        tell_trouble("window", tr("The layout of the window is not stored for the next session"), memory_.error());
      },
      true);
  dark_->setCheckable(true);
  view->addMenu(view_->look_menu());
  view->addAction(view_->cut_action());
  QMenu* tools = menuBar()->addMenu(tr("&Tools"));
  needs_run_.push_back(add(
      tools, tr("Open in &ParaView"), {}, [this] { open_paraview(); }, false));
  needs_run_.push_back(add(
      tools, tr("Watch &live in ParaView"), {}, [this] { watch_live(); }, false));
  needs_run_.push_back(add(
      tools, tr("Export &curves..."), {}, [this] { export_curves(); }, false));
  needs_run_.push_back(add(
      tools, tr("&Report of the run..."), QKeySequence("Ctrl+R"), [this] { make_report(); }, false));
  needs_run_.push_back(add(
      tools, tr("Save &animation..."), {}, [this] { save_animation(); }, false));
  add(
      tools, tr("Save p&icture..."), {}, [this] { save_picture(); }, false);
  QMenu* help = menuBar()->addMenu(tr("&Help"));
  add(
      help, tr("&Guide"), QKeySequence::HelpContents, [this] { open_guide(); }, false);
  add(
      help, tr("&Keys..."), QKeySequence("Ctrl+F1"), [this] { show_keys(*this); }, false);
  add(
      help, tr("&About Breccia"), {},
      [this] {
        QMessageBox::about(this, tr("Breccia"),
                           tr("<b>Breccia</b><br>Combined finite-discrete element simulation of solids that break.<br>"
                              "<br>F1 opens the guide, Ctrl+F1 lists the keys."));
      },
      false);
  for (QAction* action : findChildren<QAction*>()) action->setProperty("tip", action->toolTip());
}

void MainWindow::show_actions() {
  const auto set = [](QAction* action, bool on, const QString& why) {
    action->setEnabled(on);
    action->setToolTip(on ? action->property("tip").toString()
                          : QString("%1: %2").arg(action->property("tip").toString(), why));
  };
  const bool open = document_.is_open(), alive = run_ != nullptr && run_->alive();
  const QString no_case = tr("no case is open"), no_run = tr("no run is shown");
  for (QAction* action : needs_case_) set(action, open, no_case);
  for (QAction* action : needs_run_) set(action, run_ != nullptr, no_run);
  for (QAction* action : needs_alive_) set(action, alive, tr("no run in progress is shown"));
  set(resume_action_, run_ != nullptr && run_->can_go_on(), tr("no run that has ended before its time is shown"));
  const QString words = !open                ? no_case
                        : !problems_.empty() ? tr("the case has problems; F8 goes to the next one")
                                             : tr("the run that is shown is in progress");
  set(run_action_, open && problems_.empty() && !alive, words);
  set(queue_action_, open && problems_.empty(), words);
}

}  // namespace breccia::gui
