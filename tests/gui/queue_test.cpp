#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QCheckBox>
#include <QLabel>
#include <QProgressBar>
#include <QSpinBox>
#include <QTableWidget>

#include "core/run_queue.hpp"
#include "gui/desk.hpp"

namespace breccia::gui::test::queue_test {
namespace {

constexpr int kSolver = 120000;  // ms; the machine may be busy

/// The second column, from top to bottom.
QStringList states(const QTableWidget& table) {
  QStringList words;
  for (int row = 0; row < table.rowCount(); ++row) words << table.item(row, 1)->text();
  return words;
}

TEST(Queue, RunsThatWereAddedStartInTheChosenOrderAndGoOnWhileNoWindowIsOpen) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("1.8 ms")));
  desk.click_stage("Run");
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.find<QSpinBox>("queue_cores")->setValue(1);
  desk.find<QCheckBox>("queue_hold")->setChecked(true);
  auto* table = desk.find<QTableWidget>("queue_table");
  desk.click("queue_run");
  desk.window->document().set_value("stage[0].end", "\"100 us\"");
  QTest::keyClick(desk.window.get(), Qt::Key_F5, Qt::ControlModifier | Qt::ShiftModifier);
  desk.click("queue_run");
  ASSERT_EQ(states(*table), (QStringList{"waiting", "waiting", "waiting"}));
  EXPECT_TRUE(desk.window->document().modified()) << "a run of what is edited needs no saving";
  const QString second = table->item(1, 5)->text(), third = table->item(2, 5)->text();
  EXPECT_TRUE(desk.find<QLabel>("queue_why")->isHidden());
  table->setCurrentCell(2, 0);
  EXPECT_FALSE(desk.find<QAbstractButton>("queue_stop")->isEnabled());
  desk.click("queue_earlier");
  EXPECT_EQ(table->item(1, 5)->text(), third);
  EXPECT_EQ(table->currentRow(), 1);
  table->setCurrentCell(2, 0);
  desk.click("queue_remove");
  ASSERT_EQ(table->rowCount(), 2);
  desk.find<QCheckBox>("queue_hold")->setChecked(false);
  ASSERT_TRUE(wait_until([&] { return states(*table) == QStringList({"running", "waiting"}); }, kSolver));
  EXPECT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, kSolver));
  EXPECT_EQ(desk.find<QTableWidget>("runs")->rowCount(), 1);
  EXPECT_EQ(table->cellWidget(1, 2), nullptr) << "it waits";
  // A new one comes with the end of the run: it is looked for each time.
  const auto bar = [&] { return qobject_cast<const QProgressBar*>(table->cellWidget(0, 2)); };
  EXPECT_TRUE(wait_until(
      [&] { return bar() != nullptr && bar()->value() > 0 && bar()->text().contains(" %, to go: "); }, kSolver));
  EXPECT_TRUE(bar() != nullptr && bar()->accessibleName().contains("to go"));
  desk.picture("queue");

  desk.window->document().close();  // its edits are not asked about here
  desk.window.reset();
  const RunQueue queue(desk.scratch.filePath("state"));
  EXPECT_TRUE(wait_until([&] { return !queue.is_worked(); }, kSolver));
  desk.begin();
  table = desk.find<QTableWidget>("queue_table");
  EXPECT_EQ(states(*table), (QStringList{"complete", "complete"}));
  EXPECT_EQ(desk.find<QTableWidget>("runs")->rowCount(), 2);
  EXPECT_FALSE(QFileInfo::exists(second));
  desk.click("queue_clear");
  EXPECT_EQ(table->rowCount(), 0);
}

TEST(Queue, ARunThatFailsToStartTellsWhyInTheWordsOfTheSolver) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us"));
  desk.window->open_path(file);
  desk.click_stage("Run");
  desk.show_tab("Queue");
  const RunQueue queue(desk.scratch.filePath("state"));
  ASSERT_EQ(
      queue.add({BRECCIA_PROGRAM, BRECCIA_MPIEXEC},
                {{file, desk.scratch.filePath("runs/bad"), turning_case("1 us"), 1, {"material[0].young=-1"}, {}}}),
      QString());
  auto* table = desk.find<QTableWidget>("queue_table");
  ASSERT_TRUE(wait_until([&] { return states(*table) == QStringList{"failed"}; }, kSolver));
  auto* why = desk.find<QLabel>("queue_why");
  EXPECT_TRUE(why->isVisible());
  EXPECT_TRUE(why->text().startsWith("bad failed: ") && why->text().contains("young")) << why->text().toStdString();
  desk.picture("queue_failed");
}

TEST(Queue, TheKeyOfRunStartsNoSecondRunWhileTheOneThatIsShownGoesOn) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("10 s")));
  desk.find<QSpinBox>("ranks")->setValue(1);
  const auto press = [&] { QTest::keyClick(desk.window.get(), Qt::Key_F5); };
  press();
  press();
  EXPECT_EQ(desk.find<QTableWidget>("runs")->rowCount(), 1);
  ASSERT_NE(desk.window->run(), nullptr);
  desk.window->run()->stop();
  ASSERT_TRUE(wait_until([&] { return !desk.window->run()->alive(); }, kSolver));
  press();
  EXPECT_EQ(desk.find<QTableWidget>("runs")->rowCount(), 2) << "another one after it";
}

TEST(Queue, ARunOfItIsStoppedAndTheNextOneFollows) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("10 s")));
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.find<QSpinBox>("queue_cores")->setValue(1);
  desk.click_stage("Run");
  desk.click("queue_run");
  desk.click("queue_run");
  auto* table = desk.find<QTableWidget>("queue_table");
  for (int row = 0; row < 2; ++row) {
    ASSERT_TRUE(wait_until([&] { return states(*table)[row] == "running"; }, kSolver));
    const auto* runs = desk.find<QTableWidget>("runs");  // the latest is the first
    ASSERT_TRUE(wait_until([&] { return runs->rowCount() == row + 1 && states(*runs)[0] == "running"; }, kSolver));
    table->setCurrentCell(row, 0);
    desk.click("queue_stop");
    ASSERT_TRUE(
        wait_until([&] { return states(*table)[row] == "stopped" || states(*table)[row] == "interrupted"; }, kSolver))
        << states(*table).join(" ").toStdString();
  }
}

}  // namespace
}  // namespace breccia::gui::test::queue_test
