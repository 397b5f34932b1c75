#include <gtest/gtest.h>

#include <QVTKOpenGLNativeWidget.h>
#include <QAction>
#include <QComboBox>
#include <QDesktopServices>
#include <QLabel>
#include <QProcess>
#include <QStatusBar>
#include <QTextBrowser>
#include <QTreeWidget>

#include "gui/answer.hpp"
#include "gui/desk.hpp"
#include "widgets/plots_panel.hpp"

namespace breccia::gui::test::results_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

void run_in_terminal(const QString& file, const QString& folder) {
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", folder, "--progress", "none"}), 0);
}

/// Whether the middle of a chart has anything beside paper and grid.
bool has_curves(QWidget& canvas) {
  const QImage image = canvas.grab().toImage();
  int coloured = 0;
  for (int y = image.height() / 8; y < image.height() / 2; ++y)
    for (int x = image.width() / 6; x < image.width() / 2; ++x)
      coloured += image.pixelColor(x, y).saturation() > 100 ? 1 : 0;
  return coloured > 20;
}

TEST(Results, RunsOfTheCaseAreChosenFromAListWhereverTheyWereStarted) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("200 us"));
  const QString first = desk.scratch.filePath("runs/first"), second = desk.scratch.filePath("runs/second");
  run_in_terminal(file, first);
  QTest::qWait(1100);  // when they were started is told in seconds
  run_in_terminal(file, second);
  desk.window->open_path(file);
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_EQ(desk.window->run()->record().folder, second) << "the newest";
  desk.click_stage("Results");
  auto* list = desk.find<QComboBox>("results_run");
  ASSERT_EQ(list->count(), 2);
  EXPECT_TRUE(list->itemText(0).startsWith("second, complete, 20")) << list->itemText(0).toStdString();
  EXPECT_TRUE(list->itemText(0).endsWith("1 rank"));
  EXPECT_EQ(list->currentIndex(), 0);
  list->setFocus();
  QTest::keyClick(list, Qt::Key_Down);
  EXPECT_EQ(desk.window->run()->record().folder, first);
  EXPECT_EQ(list->currentData().toString(), first);
  EXPECT_TRUE(wait_until([&] { return desk.window->view().scene().num_broken() > 0; }, kSolver));
  desk.picture("run_picker");
  // One more, of a terminal, while the window is open.
  const QString third = desk.scratch.filePath("elsewhere/third");
  run_in_terminal(file, desk.scratch.filePath("runs/late"));
  run_in_terminal(file, third);
  desk.click_stage("material");
  desk.click_stage("Results");
  ASSERT_EQ(list->count(), 3);
  EXPECT_TRUE(list->itemText(0).startsWith("late")) << "it was started last";
  EXPECT_EQ(list->currentData().toString(), first) << "what is looked at stays";
  desk.window->open_path(third);
  EXPECT_EQ(list->currentData().toString(), third) << "another folder is in the list as well";
}

TEST(Results, AreNeverEmptyWhenARunHasComeToStandBesideTheCase) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us"));
  desk.window->open_path(file);
  desk.click_stage("Results");
  EXPECT_EQ(desk.find<QComboBox>("results_run")->currentText(), "no run is open");
  for (const char* button : {"export_curves", "report", "save_animation", "save_picture", "open_paraview"})
    EXPECT_FALSE(desk.find<QWidget>(button)->isEnabled()) << button;
  EXPECT_TRUE(desk.find<QWidget>("other_run")->isEnabled());
  desk.click_stage("material");
  run_in_terminal(file, desk.scratch.filePath("runs/late"));
  desk.click_stage("Results");
  ASSERT_NE(desk.window->run(), nullptr);
  EXPECT_TRUE(desk.find<QWidget>("export_curves")->isEnabled());
  EXPECT_TRUE(wait_until([&] { return desk.window->view().caption().startsWith("time "); }, kSolver));
}

TEST(Results, OfARunWhoseFramesHaveNoElementsSaySo) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us") + "elements = false\n");
  run_in_terminal(file, desk.scratch.filePath("runs/one"));
  desk.window->open_path(file);
  desk.click_stage("Results");
  EXPECT_TRUE(desk.window->view().caption().contains("no elements")) << desk.window->view().caption().toStdString();
}

TEST(Results, OfAFinishedRunThatIsOpenedAllChartsAreDrawn) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("300 us"));
  run_in_terminal(file, desk.scratch.filePath("runs/one"));
  desk.window->open_path(file);
  ASSERT_NE(desk.window->run(), nullptr);
  desk.show_tab("Plots");
  auto* plots = desk.find<PlotsPanel>("plots");
  const auto canvases = plots->findChildren<QVTKOpenGLNativeWidget*>();
  const auto shown = std::count_if(canvases.begin(), canvases.end(), [](const auto* c) { return !c->isHidden(); });
  EXPECT_TRUE(wait_until(
      [&] { return std::count_if(canvases.begin(), canvases.end(), [](auto* c) { return c->isVisible(); }) == 2; },
      5000))
      << shown;
  QTest::qWait(300);
  desk.picture("charts");
  for (auto* canvas : canvases)
    if (canvas->isVisible()) {
      EXPECT_TRUE(has_curves(*canvas)) << canvas->accessibleName().toStdString();
    }
}

TEST(Results, CurvesOfGaugesThatRestAreToldToBeRoundingAndAreDrawnOnRequest) {
  Desk desk;
  const QString file = written_case(desk.scratch, block_case(2, "100 us") + R"([[stage.constraint]]
group = "block.x0"
fixed = "xyz"
[output]
gauges = ["block"]
)");
  run_in_terminal(file, desk.scratch.filePath("runs/rest"));
  desk.window->open_path(file);
  ASSERT_NE(desk.window->run(), nullptr);
  desk.show_tab("Plots");
  auto* plots = desk.find<PlotsPanel>("plots");
  auto* list = desk.find<QTreeWidget>("curves");
  EXPECT_EQ(plots->num_curves(), 1) << "one fragment, and nothing that moves";
  QTreeWidgetItem* reaction = nullptr;
  for (QTreeWidgetItemIterator it(list); *it != nullptr; ++it)
    if ((*it)->data(0, Qt::UserRole).toString() == "block reaction x [N]") reaction = *it;
  ASSERT_NE(reaction, nullptr);
  EXPECT_EQ(reaction->text(0), "block reaction x (only rounding)");
  EXPECT_EQ(reaction->checkState(0), Qt::Unchecked);
  desk.picture("rounding");
  reaction->setCheckState(0, Qt::Checked);
  EXPECT_EQ(plots->num_curves(), 2);
}

TEST(Results, AReportOfARunIsWrittenByTheSolverAndOpened) {
  Desk desk;
  QTextBrowser browser;  // stands for that of the system
  QDesktopServices::setUrlHandler("file", &browser, "setSource");
  const QString file = written_case(desk.scratch, turning_case("200 us"));
  run_in_terminal(file, desk.scratch.filePath("runs/one"));
  desk.window->open_path(file);
  desk.click_stage("Results");
  const QString page = desk.scratch.filePath("page.html");
  auto* button = desk.find<QAbstractButton>("report");
  desk.click_and_name("report", page);
  EXPECT_FALSE(button->isEnabled());
  EXPECT_TRUE(button->text().contains("is written..."));
  ASSERT_TRUE(wait_until([&] { return button->isEnabled(); }, kSolver));
  QFile out(page);
  ASSERT_TRUE(out.open(QIODevice::ReadOnly));
  const QByteArray text = out.readAll();
  EXPECT_TRUE(text.startsWith("<!DOCTYPE html"));
  EXPECT_TRUE(text.contains("residual"));
  EXPECT_TRUE(text.contains("[[material]]")) << "the case at its end";
  EXPECT_EQ(browser.source().toLocalFile(), page);
  QDesktopServices::unsetUrlHandler("file");
  EXPECT_TRUE(desk.window->statusBar()->currentMessage().contains("is written"));

  // What is no page is not written over, in the solver's words.
  QFile other(desk.scratch.filePath("other.html"));
  ASSERT_TRUE(other.open(QIODevice::WriteOnly) && other.write("mine") == 4);
  other.close();
  Answer yes(QMessageBox::Ok);
  desk.click_and_name("report", other.fileName());
  ASSERT_TRUE(wait_until([&] { return yes.words().size() > 0 && button->isEnabled(); }, kSolver));
  EXPECT_TRUE(yes.words().join(' ').contains("this file is no page")) << yes.words().join('|').toStdString();
}

}  // namespace
}  // namespace breccia::gui::test::results_test
