#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QClipboard>
#include <QDialog>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QTableWidget>

#include "gui/desk.hpp"
#include "widgets/animation_export.hpp"
#include "widgets/joint_plot.hpp"
#include "widgets/plots_panel.hpp"

namespace breccia::gui::test::first_use_test {
namespace {

constexpr int kSolver = 120000;  // ms; the machine may be busy
constexpr double kSomethingDrawn = 0.03;

void open_glass(Desk& desk) {
  auto* templates = desk.find<QListWidget>("templates");
  ASSERT_GT(templates->count(), 5);
  QTest::mouseClick(templates->viewport(), Qt::LeftButton, {}, templates->visualItemRect(templates->item(0)).center());
  ASSERT_TRUE(desk.window->document().is_open());
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, kSolver));
}

TEST(FirstUse, FromATemplateToBreakingGlassAndItsResults) {
  Desk desk;
  desk.picture("start");
  open_glass(desk);
  Document& document = desk.window->document();
  EXPECT_GT(desk.window->view().drawn_share(), kSomethingDrawn);
  desk.picture("mesh");

  // A coarser mesh is drawn as soon as it is asked for.
  const auto fine = desk.window->view().scene().num_faces();
  desk.click_stage("mesh");
  desk.type("parameter:h", "4 mm");
  desk.type("parameter:h_support", "4 mm");
  desk.type("parameter:h_projectile", "4.5 mm");
  EXPECT_EQ(document.value("mesh.parameters"),
            R"({ h = "4 mm", h_support = "4 mm", h_projectile = "4.5 mm", tip = "5 mm" })");
  ASSERT_TRUE(
      wait_until([&] { return desk.window->view().scene().num_faces() < fine && !desk.window->busy(); }, kSolver));

  // A mistake is marked, counted and told in the solver's words; undo takes it back.
  const QByteArray before = document.text();
  desk.click_stage("material: glass");
  desk.type("field:material[0].poisson", "0.7");
  auto* run = desk.find<QAbstractButton>("run");
  ASSERT_TRUE(wait_until([&] { return run->text().contains("1 problem"); }, 2000)) << run->text().toStdString();
  EXPECT_FALSE(run->isEnabled());
  EXPECT_TRUE(desk.find<QLabel>("mark:material[0].poisson")->isVisible());
  EXPECT_TRUE(desk.find<QListWidget>("problems")->item(0)->text().contains("is out of range"));
  desk.picture("mistake");
  desk.window->set_dark(true);
  QTest::qWait(100);
  constexpr int kDark = 128;  // of 255
  auto* wrong = desk.find<QWidget>("field:material[0].poisson");
  EXPECT_LT(wrong->grab().toImage().pixelColor(wrong->width() - 10, wrong->height() / 2).lightness(), kDark);
  desk.window->set_dark(false);
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), before);
  ASSERT_TRUE(wait_until([&] { return run->isEnabled(); }, 2000));

  // A click in the view leads to the material; a field picks its group there.
  auto* canvas = desk.find<QWidget>("canvas");
  QTest::mouseClick(canvas, Qt::LeftButton, {}, desk.place_of("support"));
  EXPECT_TRUE(desk.find<QWidget>("field:material[1].young")->isVisible());
  desk.click_stage("initial velocity");
  desk.click("pick:initial_velocity[0].group");
  QTest::mouseClick(canvas, Qt::LeftButton, {}, desk.place_of("glass"));
  EXPECT_EQ(document.value("initial_velocity[0].group"), "\"glass\"");
  EXPECT_FALSE(desk.find<QAbstractButton>("pick:initial_velocity[0].group")->isChecked());
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), before);

  // Material and speed.
  desk.click_stage("material: glass");
  desk.type("field:material[0].young", "70 GPa");
  EXPECT_EQ(document.value("material[0].young"), "\"70 GPa\"");
  desk.click_stage("initial velocity");
  desk.type("field:initial_velocity[0].velocity", "0, -20 m/s, 0");
  EXPECT_EQ(document.value("initial_velocity[0].velocity"), "[0, \"-20 m/s\", 0]");
  EXPECT_TRUE(desk.find<QPlainTextEdit>("case_text")->toPlainText().contains("\"-20 m/s\""));
  QTest::qWait(300);  // the view follows the check of what was typed
  desk.picture("loads");

  // The joint law as the solver evaluates it, and a material of the library.
  desk.click_stage("joint: glass");
  auto* plot = desk.find<JointPlot>("joint_plot");
  ASSERT_TRUE(wait_until([&] { return plot->isVisible() && plot->num_points() > 200; }, kSolver));
  EXPECT_TRUE(plot->accessibleDescription().contains("Pa/m"));
  desk.picture("joint");
  desk.click_stage("material: glass");
  const QByteArray by_hand = document.text();
  QTimer::singleShot(500, desk.window.get(), [&] {
    auto* dialog = desk.find<QDialog>("library");
    auto* filter = dialog->findChild<QLineEdit*>("library_filter");
    QTest::keyClicks(filter, "soda");
    desk.picture("library", dialog);
    QTest::mouseClick(dialog->findChild<QAbstractButton*>("library_take"), Qt::LeftButton);
  });
  desk.click("from_library");
  EXPECT_EQ(document.value("joint[0].energy_mode_1"), "\"8 J/m2\"");
  desk.window->activateWindow();
  (void)QTest::qWaitForWindowActive(desk.window.get());
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), by_hand);
  desk.click_stage("output");
  desk.type("field:output.frame_interval", "1 us");
  EXPECT_EQ(document.value("output.frame_interval"), "\"1 us\"");

  // Domains for two ranks.
  desk.find<QSpinBox>("ranks")->setValue(2);
  desk.click_stage("domains");
  auto* table = desk.find<QTableWidget>("domain_table");
  ASSERT_TRUE(wait_until([&] { return table->rowCount() == 2; }, kSolver));
  EXPECT_GT(table->item(0, 1)->text().toInt(), 1000);
  EXPECT_EQ(desk.window->view().scene().colouring(), Colouring::rank);
  desk.picture("domains");

  // The estimate, then the run on two ranks.
  desk.click_stage("Run");
  auto* estimate = desk.find<QLabel>("estimate");
  ASSERT_TRUE(wait_until([&] { return estimate->text().contains("stable step"); }, kSolver))
      << estimate->text().toStdString();
  desk.picture("estimate");
  desk.click("run");
  ASSERT_NE(desk.window->run(), nullptr);
  SolverRun& solver = *desk.window->run();
  EXPECT_TRUE(solver.record().command.contains("-n"));
  desk.window->view().set_colouring(colouring_by(Quantity::speed));
  ASSERT_TRUE(wait_until(
      [&] { return solver.status().broken_joints > 20 && desk.window->view().scene().num_broken() > 0; }, 4 * kSolver))
      << solver.failure().toStdString();
  EXPECT_GT(desk.window->view().drawn_share(), kSomethingDrawn);
  EXPECT_GE(desk.find<PlotsPanel>("plots")->num_curves(), 4);
  desk.picture("running");

  // Pause, resume, stop.
  desk.click("pause");
  ASSERT_TRUE(wait_until([&] { return solver.state() == "paused"; }, kSolver));
  desk.window->set_dark(true);
  desk.picture("paused_dark");
  desk.click("checkpoint");
  ASSERT_TRUE(wait_until([&] { return !solver.checkpoints().empty(); }, kSolver));
  EXPECT_TRUE(desk.find<QLabel>("checkpoints")->text().contains("latest at step"));
  desk.click("pause");
  ASSERT_TRUE(wait_until([&] { return solver.state() == "running"; }, kSolver));
  auto* go_on = desk.find<QAbstractButton>("go_on");
  EXPECT_FALSE(go_on->isVisible());
  desk.click("stop");
  ASSERT_TRUE(wait_until([&] { return !solver.alive() && go_on->isVisible(); }, kSolver));
  EXPECT_EQ(solver.state(), "stopped");
  EXPECT_TRUE(members_of(solver.record().session).isEmpty());
  desk.window->set_dark(false);
  desk.picture("stopped");

  // On, on one rank.
  const qint64 left_at = solver.checkpoints().front().step;
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.click("copy_go_on_command");
  EXPECT_TRUE(QApplication::clipboard()->text().contains(" resume "));
  desk.click("go_on");
  SolverRun& second = *desk.window->run();
  ASSERT_EQ(second.record().ranks, 1);
  EXPECT_FALSE(go_on->isVisible());
  ASSERT_TRUE(wait_until([&] { return second.status().step > static_cast<double>(left_at); }, kSolver))
      << second.failure().toStdString();
  EXPECT_EQ(desk.find<QTableWidget>("runs")->rowCount(), 1);
  desk.click("stop");
  ASSERT_TRUE(wait_until([&] { return !second.alive(); }, kSolver));
  desk.window->set_dark(true);

  // Results.
  desk.click("open_results");
  auto* frame = desk.find<QSlider>("frame");
  EXPECT_TRUE(frame->isVisible());
  ASSERT_GE(frame->maximum(), 1);
  QTest::keyClick(frame, Qt::Key_Home);
  EXPECT_TRUE(wait_until([&] { return desk.find<QLabel>("frame_time")->text().startsWith("frame 1 "); }, 5000));
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().num_broken() == 0; }, kSolver));
  desk.click("next_frame");
  EXPECT_EQ(frame->value(), 1);
  frame->setValue(frame->maximum());
  EXPECT_TRUE(wait_until([&] { return desk.window->view().scene().num_broken() > 0; }, kSolver));
  desk.window->set_dark(false);
  desk.picture("results");

  // Curves and a film for others.
  const QString table_file = desk.scratch.filePath("curves.csv"), film = desk.scratch.filePath("film.mp4");
  desk.click_and_name("export_curves", table_file);
  QFile curves(table_file);
  ASSERT_TRUE(curves.open(QIODevice::ReadOnly));
  EXPECT_TRUE(curves.readLine().contains("kinetic [J]"));
  EXPECT_GT(curves.readAll().count('\n'), 1);
  if (!AnimationExport::program().isEmpty()) {
    desk.click_and_name("save_animation", film);
    const auto is_written = [&] { return desk.window->statusBar()->currentMessage().contains("is written"); };
    EXPECT_TRUE(wait_until(is_written, kSolver));
    EXPECT_GT(QFileInfo(film).size(), 1000);
  }
  // A fresh view is drawn after the light theme.
  EXPECT_GT(desk.window->view().drawn_share(), kSomethingDrawn);
}

TEST(FirstUse, ARunThatOutlivesTheWindowIsInTheNextOne) {
  Desk desk;
  open_glass(desk);
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.click_stage("Run");
  desk.click("run");
  const Session session = desk.window->run()->record().session;
  ASSERT_TRUE(wait_until([&] { return desk.window->run()->status().step > 0; }, kSolver));
  desk.begin();  // the first window is gone
  EXPECT_FALSE(members_of(session).isEmpty());
  auto* runs = desk.find<QListWidget>("start_runs");
  ASSERT_EQ(runs->count(), 1);
  EXPECT_TRUE(runs->item(0)->text().startsWith("running"));
  QTest::mouseClick(runs->viewport(), Qt::LeftButton, {}, runs->visualItemRect(runs->item(0)).center());
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_TRUE(desk.window->run()->alive());
  desk.click("stop");
  EXPECT_TRUE(wait_until([&] { return members_of(session).isEmpty(); }, kSolver));
}

}  // namespace
}  // namespace breccia::gui::test::first_use_test
