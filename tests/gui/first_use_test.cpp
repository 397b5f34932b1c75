#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QSlider>
#include <QSpinBox>
#include <QTableWidget>

#include "gui/desk.hpp"
#include "widgets/plots_panel.hpp"

namespace breccia::gui::test {
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
  desk.type("field:mesh.parameters", R"({ h = "4 mm", h_support = "4 mm", h_projectile = "4.5 mm", tip = "5 mm" })");
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
  document.undo_stack().undo();
  EXPECT_EQ(document.text(), before);
  ASSERT_TRUE(wait_until([&] { return run->isEnabled(); }, 2000));

  // Material and speed.
  desk.type("field:material[0].young", "70 GPa");
  EXPECT_EQ(document.value("material[0].young"), "\"70 GPa\"");
  desk.click_stage("initial velocity");
  desk.type("field:initial_velocity[0].velocity", "0, -20 m/s, 0");
  EXPECT_EQ(document.value("initial_velocity[0].velocity"), "[0, \"-20 m/s\", 0]");
  EXPECT_TRUE(desk.find<QPlainTextEdit>("case_text")->toPlainText().contains("\"-20 m/s\""));
  desk.picture("loads");
  desk.click_stage("output");
  desk.type("field:output.frame_interval", "1 us");

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
  desk.window->view().set_colouring(Colouring::speed);
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
  desk.click("pause");
  ASSERT_TRUE(wait_until([&] { return solver.state() == "running"; }, kSolver));
  desk.click("stop");
  ASSERT_TRUE(wait_until([&] { return !solver.alive(); }, kSolver));
  EXPECT_EQ(solver.state(), "stopped");
  EXPECT_TRUE(members_of(solver.record().session).isEmpty());

  // Results.
  desk.click("open_results");
  auto* frame = desk.find<QSlider>("frame");
  EXPECT_TRUE(frame->isVisible());
  ASSERT_GE(frame->maximum(), 1);
  QTest::keyClick(frame, Qt::Key_Home);
  EXPECT_TRUE(wait_until([&] { return desk.find<QLabel>("frame_time")->text().startsWith("frame 1 "); }, 5000));
  desk.click("next_frame");
  EXPECT_EQ(frame->value(), 1);
  frame->setValue(frame->maximum());
  EXPECT_TRUE(wait_until([&] { return !desk.window->busy(); }, kSolver));
  desk.picture("results_dark");
  desk.window->set_dark(false);
  desk.picture("results");
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
}  // namespace breccia::gui::test
