#include <gtest/gtest.h>

#include <QCheckBox>
#include <QLabel>
#include <QProcess>
#include <QSpinBox>
#include <QStatusBar>
#include <QTableWidget>
#include <QThread>

#include "gui/desk.hpp"

namespace breccia::gui::test::runs_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

/// Runs the case that is open, on one rank, from its stage.
SolverRun& start(Desk& desk) {
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.click_stage("Run");
  desk.click("run");
  if (desk.window->run() == nullptr) throw std::runtime_error("no run");
  return *desk.window->run();
}

TEST(Runs, AStageOfTheCaseShowsTheMeshAtRestWhileARunGoesOn) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("10 s")));
  View3D& view = desk.window->view();
  ASSERT_TRUE(wait_until([&] { return view.scene().has_data() && !desk.window->busy(); }, kSolver));
  SolverRun& run = start(desk);
  ASSERT_TRUE(wait_until([&] { return view.scene().num_broken() > 0; }, kSolver)) << run.failure().toStdString();
  desk.click_stage("material: block");
  const auto at_rest = [&] {
    return view.caption() == "mesh at rest" && view.scene().num_broken() == 0 && !desk.window->busy();
  };
  ASSERT_TRUE(wait_until(at_rest, kSolver));
  const std::size_t frames = run.frames().size();
  ASSERT_TRUE(wait_until([&] { return run.frames().size() > frames + 1; }, kSolver));
  QTest::qWait(500);  // a frame would have been read
  EXPECT_TRUE(at_rest()) << view.caption().toStdString();
  desk.click_stage("Run");
  EXPECT_TRUE(wait_until([&] { return view.scene().num_broken() > 0; }, kSolver)) << "the run is seen again";
  desk.click("stop");
  ASSERT_TRUE(wait_until([&] { return !run.alive(); }, kSolver));
}

TEST(Runs, AnOpenedCaseHasItsLatestRunAtHandWhichNobodyAnnouncesAnew) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us"));
  desk.window->open_path(file);
  SolverRun& run = start(desk);
  ASSERT_TRUE(wait_until([&] { return run.state() == "complete"; }, kSolver)) << run.failure().toStdString();
  ASSERT_TRUE(wait_until([&] { return desk.window->statusBar()->currentMessage().contains("complete"); }, kSolver));
  const QString folder = run.record().folder;
  desk.window->document().close();
  desk.begin();
  desk.window->open_path(file);
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_EQ(desk.window->run()->record().folder, folder);
  View3D& view = desk.window->view();
  ASSERT_TRUE(wait_until([&] { return view.caption() == "mesh at rest" && !desk.window->busy(); }, kSolver));
  QTest::qWait(8 * SolverRun::kInterval);
  EXPECT_FALSE(desk.window->statusBar()->currentMessage().contains("complete"));
  desk.click_stage("Results");
  EXPECT_TRUE(wait_until([&] { return view.caption().startsWith("time "); }, kSolver)) << view.caption().toStdString();
  const QString table = desk.scratch.filePath("curves.csv");
  desk.click_and_name("export_curves", table);
  EXPECT_TRUE(wait_until([&] { return QFileInfo::exists(table); }, 20000));
  // A run of a terminal, which no list holds.
  ASSERT_TRUE(QFile::remove(desk.scratch.filePath("state/runs.json")));
  desk.window->document().close();
  desk.begin();
  desk.window->open_path(file);
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_EQ(desk.window->run()->record().folder, folder);
}

TEST(Runs, MoreRanksThanCoresNeedATick) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("10 s")));
  auto* ranks = desk.find<QSpinBox>("ranks");
  const int cores = QThread::idealThreadCount();
  EXPECT_LE(ranks->maximum(), 16 * cores);
  desk.click_stage("Run");
  auto* tick = desk.find<QCheckBox>("oversubscribe");
  EXPECT_FALSE(tick->isVisible());
  ranks->setValue(cores + 1);
  EXPECT_TRUE(tick->isVisible());
  EXPECT_FALSE(desk.find<QWidget>("run")->isEnabled());
  desk.click_stage("Materials");
  for (const Qt::KeyboardModifiers keys : {Qt::KeyboardModifiers(), Qt::ControlModifier | Qt::ShiftModifier})
    QTest::keyClick(desk.window.get(), Qt::Key_F5, keys);
  EXPECT_EQ(desk.window->run(), nullptr);
  EXPECT_EQ(desk.find<QTableWidget>("queue_table")->rowCount(), 0);
  EXPECT_EQ(QApplication::focusWidget(), tick) << "where one agrees";
  QTest::keyClick(tick, Qt::Key_Space);
  EXPECT_TRUE(desk.find<QWidget>("run")->isEnabled());
  ranks->setValue(cores + 2);
  EXPECT_FALSE(tick->isChecked()) << "one agrees to a number";
  QTest::keyClick(tick, Qt::Key_Space);
  QTest::keyClick(desk.window.get(), Qt::Key_F5);
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_TRUE(desk.window->run()->record().command.contains("--oversubscribe"));
  desk.window->run()->stop();
  EXPECT_TRUE(wait_until([&] { return !desk.window->run()->alive(); }, kSolver));
}

TEST(Runs, ARunThatIsFoundAgainSetsTheRanksAndOneThatLeftNoFrameSaysSo) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("10 s"));
  desk.window->open_path(file);
  SolverRun& first = start(desk);
  ASSERT_TRUE(wait_until([&] { return first.state() == "running"; }, kSolver)) << first.failure().toStdString();
  desk.click("pause");
  EXPECT_TRUE(desk.find<QLabel>("run_state")->text().contains("pausing"));
  EXPECT_FALSE(desk.find<QWidget>("pause")->isEnabled());
  desk.begin();
  desk.find<QSpinBox>("ranks")->setValue(2);
  desk.window->open_path(file);
  EXPECT_EQ(desk.find<QSpinBox>("ranks")->value(), 1);
  desk.window->run()->stop();
  ASSERT_TRUE(wait_until([&] { return !desk.window->run()->alive(); }, kSolver));
  EXPECT_FALSE(desk.find<QLabel>("run_state")->text().contains("time to go")) << "of a run that has ended";
  const QString bare = desk.scratch.filePath("bare");
  ASSERT_TRUE(QDir().mkpath(bare));
  QFile out(bare + "/provenance.json");
  ASSERT_TRUE(out.open(QIODevice::WriteOnly));
  out.write(R"({"program": "breccia"})");
  out.close();
  desk.window->open_path(bare);
  EXPECT_TRUE(desk.window->view().caption().contains("no frame")) << desk.window->view().caption().toStdString();
}

TEST(Runs, NamesOfRunsAreSeenWhole) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("50 us")));
  SolverRun& run = start(desk);
  ASSERT_TRUE(wait_until([&] { return run.state() == "complete"; }, kSolver)) << run.failure().toStdString();
  auto* table = desk.find<QTableWidget>("runs");
  EXPECT_GE(table->columnWidth(0), table->fontMetrics().horizontalAdvance(table->item(0, 0)->text()));
}

}  // namespace
}  // namespace breccia::gui::test::runs_test
