#pragma once

#include <signal.h>

#include <QDir>
#include <QFileDialog>
#include <QImage>
#include <QLineEdit>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <QTreeWidget>
#include <algorithm>
#include <functional>
#include <memory>

#include "gui/block_case.hpp"
#include "widgets/main_window.hpp"
#include "widgets/view3d.hpp"

namespace breccia::gui::test {

/// A desktop with folders of its own, on the screen, driven by clicks and keys.
struct Desk {
  QTemporaryDir scratch;
  std::unique_ptr<MainWindow> window;

  Desk() { begin(); }
  ~Desk() {
    window->document().close();
    const RunQueue queue(scratch.filePath("state"));
    queue.hold(true);
    for (const RunRecord& run : RunRegistry(scratch.filePath("state/runs.json")).load())
      signal_session(run.session, SIGKILL);
  }

  /// Those of this desktop.
  [[nodiscard]] Places places() const {
    Places places;
    // Pictures show the program where it is installed.
    places.launch = {qEnvironmentVariable("BRECCIA_PROGRAM", BRECCIA_PROGRAM), BRECCIA_MPIEXEC};
    places.desktop = BRECCIA_GUI;
    places.meshes = BRECCIA_MESHES;
    places.projects = scratch.filePath("projects");
    places.state = scratch.filePath("state");
    return places;
  }

  void begin() {
    window = std::make_unique<MainWindow>(places());
    window->resize(1280, 800);
    window->show();
    (void)QTest::qWaitForWindowExposed(window.get());
    window->activateWindow();  // fields take over what was typed when they lose the focus
    (void)QTest::qWaitForWindowActive(window.get());
  }

  template <class Widget>
  Widget* find(const QString& name) {
    auto* found = window->findChild<Widget*>(name);
    if (found == nullptr) throw std::runtime_error("no widget " + name.toStdString());
    return found;
  }

  /// Fields for experts are there, but not shown before their button is clicked.
  void unfold(const QWidget* widget) {
    auto* more = window->findChild<QToolButton*>("expert_keys");
    if (more != nullptr && !more->isChecked() && !widget->isVisible()) QTest::mouseClick(more, Qt::LeftButton);
  }

  void click(const QString& name) {
    auto* widget = find<QWidget>(name);
    unfold(widget);
    QTest::mouseClick(widget, Qt::LeftButton);
  }

  /// A click on the line of the tree of stages whose text begins so.
  void click_stage(const QString& text) {
    auto* tree = find<QTreeWidget>("stages");
    for (QTreeWidgetItemIterator it(tree); *it != nullptr; ++it) {
      if (!(*it)->text(0).startsWith(text)) continue;
      tree->scrollToItem(*it);
      QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualItemRect(*it).center());
      return;
    }
    throw std::runtime_error("no stage " + text.toStdString());
  }

  /// Brings a panel of the foot to the front.
  void show_tab(const QString& title) {
    for (auto* bar : window->findChildren<QTabBar*>())
      for (int i = 0; i < bar->count(); ++i)
        if (bar->tabText(i) == title) return QTest::mouseClick(bar, Qt::LeftButton, {}, bar->tabRect(i).center());
    throw std::runtime_error("no tab " + title.toStdString());
  }

  /// Types into a field and leaves it.
  void type(const QString& field, const QString& text) {
    type_and_stay(field, text);
    QTest::keyClick(find<QWidget>(field), Qt::Key_Tab);
  }

  /// Types into a field; the cursor stays there. A field takes over what was typed when it loses the focus, which only
  /// an active window has, and without a window manager nothing gives it back to the window when a dialog has closed.
  void type_and_stay(const QString& field, const QString& text) {
    for (int i = 0; i < 50 && !window->isActiveWindow(); ++i) {
      window->activateWindow();
      QTest::qWait(20);
    }
    auto* widget = find<QWidget>(field);
    unfold(widget);
    widget->setFocus();
    QTest::keyClick(widget, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClick(widget, Qt::Key_Delete);
    QTest::keyClicks(widget, text);
  }

  /// Clicks a button that opens the dialog for files, and types a name there.
  void click_and_name(const QString& button, const QString& file) {
    name_in_dialog([&] { click(button); }, file);
  }

  /// Types a name into the dialog for files that `open` opens; the key of return again while the dialog stays, since it
  /// takes no name before it has read the folder.
  void name_in_dialog(const std::function<void()>& open, const QString& file) {
    QTimer typing;
    QObject::connect(&typing, &QTimer::timeout, window.get(), [this, file] {
      auto* dialog = window->findChild<QFileDialog*>();
      if (dialog == nullptr) throw std::runtime_error("no dialog for files");
      auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
      if (name->text() != file) {
        name->setFocus();
        name->clear();
        QTest::keyClicks(name, file);
      }
      QTest::keyClick(name, Qt::Key_Return);
    });
    typing.start(500);
    open();
    typing.stop();
    window->activateWindow();
    (void)QTest::qWaitForWindowActive(window.get());
  }

  /// A place of the 3D view where a group is seen; none: not in sight.
  QPoint place_of(const QString& group) {
    auto* canvas = find<QWidget>("canvas");
    for (int y = 5; y < canvas->height(); y += 7)
      for (int x = 5; x < canvas->width(); x += 7)
        if (const Scene::Picked what = window->view().picked_at({x, y});
            what.volume == group.toStdString() ||
            std::count(what.surfaces.begin(), what.surfaces.end(), group.toStdString()) > 0)
          return {x, y};
    throw std::runtime_error("not in sight: " + group.toStdString());
  }

  /// A picture of the window, or of a dialog, in the colours of the moment; of the window in light colours also a dark
  /// one, called after it. They are kept where BRECCIA_SCREENSHOTS says.
  void picture(const QString& name, QWidget* of = nullptr) {
    const QDir folder(qEnvironmentVariable("BRECCIA_SCREENSHOTS"));
    QTest::qWait(100);
    if (!qEnvironmentVariableIsSet("BRECCIA_SCREENSHOTS") || !folder.mkpath(".")) return;
    const auto save = [&](QWidget* widget, const QString& as) {
      constexpr int kSmallest = 0;  // of a PNG, without loss
      widget->grab().save(folder.filePath(as + ".png"), nullptr, kSmallest);
    };
    save(of == nullptr ? window.get() : of, name);
    if (of != nullptr || window->dark()) return;
    window->set_dark(true);
    QTest::qWait(300);
    save(window.get(), name + "_dark");
    window->set_dark(false);
    QTest::qWait(100);
  }
};

}  // namespace breccia::gui::test
