#include <gtest/gtest.h>

#include <QAction>
#include <QDockWidget>
#include <QGuiApplication>
#include <QMenuBar>
#include <QScreen>

#include "gui/desk.hpp"

// What the window keeps from one session to the next.

namespace breccia::gui::test::layout_test {
namespace {

/// Ends a session, and begins the next one as the program does: the size is the window's own.
void restart(Desk& desk) {
  ASSERT_TRUE(desk.window->close());
  desk.window = std::make_unique<MainWindow>(desk.places());
  desk.window->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(desk.window.get()));
}

QAction* action_of(Desk& desk, const QString& text) {
  for (auto* action : desk.window->findChildren<QAction*>())
    if (QString(action->text()).remove('&') == text) return action;
  throw std::runtime_error("no action " + text.toStdString());
}

void open_block(Desk& desk) { desk.window->open_path(written_case(desk.scratch, block_case(1, "1 ms"))); }

TEST(Layout, SizePlaceAndDocksAreThoseOfTheSessionBefore) {
  Desk desk;
  open_block(desk);
  const QRect place(40, 30, 1111, 777);
  desk.window->setGeometry(place);
  desk.find<QDockWidget>("dock_study")->hide();
  desk.find<QDockWidget>("dock_text")->setFloating(true);
  desk.window->addDockWidget(Qt::LeftDockWidgetArea, desk.find<QDockWidget>("dock_properties"));
  restart(desk);
  EXPECT_EQ(desk.window->geometry(), place);
  EXPECT_TRUE(desk.find<QDockWidget>("dock_stages")->isHidden()) << "the start page has none";
  open_block(desk);
  EXPECT_TRUE(desk.find<QDockWidget>("dock_study")->isHidden());
  EXPECT_TRUE(desk.find<QDockWidget>("dock_text")->isFloating());
  EXPECT_EQ(desk.window->dockWidgetArea(desk.find<QDockWidget>("dock_properties")), Qt::LeftDockWidgetArea);
  EXPECT_FALSE(desk.find<QDockWidget>("dock_stages")->isHidden());
}

TEST(Layout, DocksThatWereClosedStaySoWhenAnotherCaseIsOpened) {
  Desk desk;
  open_block(desk);
  desk.find<QDockWidget>("dock_study")->hide();
  action_of(desk, "New from a template...")->trigger();
  open_block(desk);
  EXPECT_TRUE(desk.find<QDockWidget>("dock_study")->isHidden());
  open_block(desk);
  EXPECT_TRUE(desk.find<QDockWidget>("dock_study")->isHidden());
}

TEST(Layout, DarkAndLightAreKeptOnceChosen) {
  Desk desk;
  EXPECT_FALSE(desk.window->remembers_colours());
  action_of(desk, "Dark")->trigger();
  EXPECT_TRUE(desk.window->dark());
  restart(desk);
  EXPECT_TRUE(desk.window->dark());
  EXPECT_TRUE(action_of(desk, "Dark")->isChecked());
  action_of(desk, "Dark")->trigger();
  restart(desk);
  EXPECT_FALSE(desk.window->dark());
  EXPECT_TRUE(desk.window->remembers_colours());
}

TEST(Layout, AWindowOfALargerScreenIsWithinThisOne) {
  Desk desk;
  desk.window->hide();
  desk.window->setGeometry(5000, 4000, 3000, 2500);
  restart(desk);
  const QRect screen = QGuiApplication::primaryScreen()->availableGeometry();
  EXPECT_TRUE(screen.contains(desk.window->geometry()))
      << desk.window->x() << " " << desk.window->y() << " " << desk.window->width() << " " << desk.window->height();
}

TEST(Layout, ResettingItBringsEveryDockBackToItsPlace) {
  Desk desk;
  open_block(desk);
  desk.find<QDockWidget>("dock_study")->hide();
  desk.find<QDockWidget>("dock_text")->setFloating(true);
  desk.window->addDockWidget(Qt::LeftDockWidgetArea, desk.find<QDockWidget>("dock_properties"));
  action_of(desk, "Reset layout")->trigger();
  for (auto* dock : desk.window->findChildren<QDockWidget*>()) {
    EXPECT_FALSE(dock->isHidden()) << dock->objectName().toStdString();
    EXPECT_FALSE(dock->isFloating()) << dock->objectName().toStdString();
  }
  EXPECT_EQ(desk.window->dockWidgetArea(desk.find<QDockWidget>("dock_properties")), Qt::RightDockWidgetArea);
  desk.show_tab("Study");
  restart(desk);
  open_block(desk);
  EXPECT_FALSE(desk.find<QDockWidget>("dock_study")->isHidden());
}

TEST(Layout, FilesThatHoldSomethingElseChangeNothing) {
  Desk desk;
  ASSERT_TRUE(desk.window->close());
  desk.window.reset();
  QFile out(desk.scratch.filePath("state/window.ini"));
  ASSERT_TRUE(out.open(QIODevice::WriteOnly | QIODevice::Truncate));
  out.write("[General]\ndark=maybe\ngeometry=@ByteArray(x)\nlayout=@ByteArray(\\0\\xff)\n");
  out.close();
  desk.window = std::make_unique<MainWindow>(desk.places());
  desk.window->show();
  EXPECT_FALSE(desk.window->dark());
  open_block(desk);
  for (auto* dock : desk.window->findChildren<QDockWidget*>())
    EXPECT_FALSE(dock->isHidden()) << dock->objectName().toStdString();
}

}  // namespace
}  // namespace breccia::gui::test::layout_test
