#include <QAction>
#include <QCloseEvent>
#include <QDockWidget>
#include <QGuiApplication>
#include <QScreen>
#include <QStackedWidget>
#include <algorithm>
#include <array>

#include "widgets/case_text.hpp"
#include "widgets/case_tree.hpp"
#include "widgets/main_window.hpp"
#include "widgets/start_page.hpp"
#include "widgets/view3d.hpp"

// Where the docks are, what is in front, and what of it the next session finds.

namespace breccia::gui {
namespace {

/// The last one is in front.
constexpr std::array kDocks{"dock_stages", "dock_properties", "dock_plots",    "dock_text",
                            "dock_runs",   "dock_queue",      "dock_study",    "dock_histogram",
                            "dock_law",    "dock_conditions", "dock_contacts", "dock_messages"};
constexpr int kLayoutVersion = 1;  // of what saveState keeps; one of other docks is not taken up

}  // namespace

void MainWindow::arrange_docks() {
  const auto place = [this](const char* name, Qt::DockWidgetArea area) {
    auto* dock = findChild<QDockWidget*>(name);
    dock->setFloating(false);
    addDockWidget(area, dock);
    return dock;
  };
  QDockWidget* stages = place("dock_stages", Qt::LeftDockWidgetArea);
  QDockWidget* properties = place("dock_properties", Qt::RightDockWidgetArea);
  QDockWidget* first = place("dock_messages", Qt::BottomDockWidgetArea);
  for (const char* name : {"dock_plots", "dock_text", "dock_runs", "dock_queue", "dock_study", "dock_histogram",
                           "dock_conditions", "dock_law", "dock_contacts"})
    tabifyDockWidget(first, place(name, Qt::BottomDockWidgetArea));
  first->raise();
  resizeDocks({stages, properties}, {240, 400}, Qt::Horizontal);
  resizeDocks({first}, {230}, Qt::Vertical);
}

namespace {

/// Of a screen, less what the system adds around a window.
QSize room_on(const QScreen& screen) { return screen.availableGeometry().size() - QSize(8, 40); }

/// A window of the same place and size as far as the screen has both, where it is, or the first one.
QRect within_a_screen(QRect window) {
  const QScreen* screen = QGuiApplication::screenAt(window.center());
  if (screen == nullptr) screen = QGuiApplication::primaryScreen();
  const QRect all = screen->availableGeometry();
  if (all.contains(window)) return window;
  window.setSize(window.size().boundedTo(room_on(*screen)));
  window.moveLeft(std::clamp(window.left(), all.left(), all.right() + 1 - window.width()));
  window.moveTop(std::clamp(window.top(), all.top(), all.bottom() + 1 - window.height()));
  return window;
}

}  // namespace

void MainWindow::take_default_size() {
  const QSize room = room_on(*QGuiApplication::primaryScreen());
  setMinimumSize(QSize(900, 600).boundedTo(room));
  resize(QSize(1400, 900).boundedTo(room));
}

void MainWindow::remember_arrangement() {
  if (restoreGeometry(memory_.geometry()) && !isMaximized() && !isFullScreen())
    setGeometry(within_a_screen(geometry()));
  layout_ = memory_.layout();
  if (const std::optional<bool> dark = memory_.dark()) set_dark(*dark);
}

void MainWindow::keep_arrangement() {
  if (centre_->currentWidget() == view_) layout_ = saveState(kLayoutVersion);
  memory_.set_arrangement(saveGeometry(), layout_);
}

void MainWindow::reset_arrangement() {
  layout_.clear();
  if (isMaximized() || isFullScreen()) showNormal();
  take_default_size();
  arrange_docks();
  centre_->currentWidget() == view_ ? show_all_docks() : show_start();
}

void MainWindow::show_start() {
  if (centre_->currentWidget() == view_) layout_ = saveState(kLayoutVersion);
  start_->refresh(registry_.load());
  centre_->setCurrentWidget(start_);
  for (const char* name : kDocks) findChild<QWidget*>(name)->hide();
}

void MainWindow::show_all_docks() {
  for (const char* name : kDocks) findChild<QWidget*>(name)->show();
}

/// Docks that were closed stay so, also in the next session.
void MainWindow::show_workspace() {
  setAnimated(false);  // each step of it would draw the view anew
  if (centre_->currentWidget() != view_ && (layout_.isEmpty() || !restoreState(layout_, kLayoutVersion)))
    show_all_docks();
  if (auto* front = findChild<QDockWidget*>(kDocks.back()); !front->isHidden()) front->raise();
  centre_->setCurrentWidget(view_);
  setAnimated(true);
  tree_->setFocus();
}

void MainWindow::show_dock(const QString& name) {
  if (auto* dock = findChild<QDockWidget*>(name)) {
    dock->show();
    dock->raise();
  }
}

void MainWindow::offer_dock(const QString& name) {
  if (!text_->hasFocus()) show_dock(name);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!may_leave_case()) {
    event->ignore();
    return;
  }
  keep_arrangement();
  document_.close();
  event->accept();
}

}  // namespace breccia::gui
