#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QProcess>
#include <QSlider>
#include <QSpinBox>
#include <QTableWidget>
#include <numeric>

#include "core/case_outline.hpp"
#include "core/study.hpp"
#include "gui/desk.hpp"
#include "widgets/case_tree.hpp"
#include "widgets/frame_loader.hpp"
#include "widgets/histogram_panel.hpp"
#include "widgets/line_chart.hpp"

namespace breccia::gui::test::panels_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

TEST(Panels, AStudyIsQueuedFromATableAndEndsInOnePlotAndOneTable) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, turning_case("200 us")));
  desk.find<QSpinBox>("ranks")->setValue(1);
  desk.find<QSpinBox>("queue_cores")->setValue(2);
  desk.show_tab("Study");
  desk.type("study_key_1", "material[0].density");
  desk.type("study_values_1", "1 g/cm3; 2 g/cm3; -1");
  desk.type("study_key_2", "detection.algorithm");
  desk.type("study_values_2", "ms; sorted_grid");
  auto* start = desk.find<QAbstractButton>("study_start");
  EXPECT_EQ(start->text(), "Add 6 runs to the queue");
  desk.click("study_start");
  EXPECT_TRUE(desk.find<QLabel>("study_words")->text().contains("density")) << "the solver's words";
  EXPECT_EQ(desk.find<QTableWidget>("queue_table")->rowCount(), 0);
  desk.type("study_values_1", "1 g/cm3; 2 g/cm3; 4 g/cm3");
  desk.click("study_start");
  EXPECT_TRUE(desk.find<QLabel>("study_words")->text().isEmpty());
  auto* table = desk.find<QTableWidget>("study_table");
  ASSERT_EQ(table->rowCount(), 6);
  const auto complete = [&] {
    int n = 0;
    for (int row = 0; row < table->rowCount(); ++row) n += table->item(row, 2)->text() == "complete" ? 1 : 0;
    return n == 6;
  };
  ASSERT_TRUE(wait_until(complete, kSolver));
  auto* column = desk.find<QComboBox>("study_column");
  column->setCurrentText("kinetic [J]");
  const auto& lines = desk.find<LineChart>("study_chart")->lines();
  ASSERT_EQ(lines.size(), 2U);
  ASSERT_EQ(lines[0].y.size(), 3U);
  EXPECT_LT(lines[0].y[0], lines[0].y[2]);
  EXPECT_EQ(table->item(0, 3)->text(), QString::number(lines[0].y[0], 'g', 6));
  desk.picture("study");
  const QString file = desk.scratch.filePath("runs/study.csv");
  desk.click_and_name("study_export", file);
  QFile csv(file);
  ASSERT_TRUE(csv.open(QIODevice::ReadOnly));
  EXPECT_EQ(csv.readAll().count('\n'), 7);

  desk.begin();  // another window finds it
  desk.window->open_path(desk.scratch.filePath("case.toml"));
  auto* studies = desk.find<QComboBox>("studies");
  EXPECT_EQ(studies->count(), 1);
  desk.show_tab("Study");
  QTest::qWait(100);
  EXPECT_LE(studies->sizeHint().width(), studies->width()) << studies->currentText().toStdString();
  EXPECT_EQ(desk.find<QTableWidget>("study_table")->rowCount(), 6);
}

TEST(Panels, TheTableOfALongHistoryIsWholeThoughItIsExportedAtOnce) {
  constexpr int kRows = 60000;
  Desk desk;
  const QString folder = desk.scratch.filePath("long");
  QDir().mkpath(folder);
  const auto write = [&](const QString& name, const QByteArray& text) {
    QFile out(QDir(folder).filePath(name));
    EXPECT_TRUE(out.open(QIODevice::WriteOnly) && out.write(text) == text.size());
  };
  QByteArray history = "step,time [s],kinetic [J]\n";
  for (int i = 0; i < kRows; ++i) history += QByteArray::number(i) + "," + QByteArray(60, '1') + ",1\n";
  write("provenance.json", R"({"program": "breccia"})");
  write("history.csv", history);
  desk.window->open_path(folder);
  const QString table = desk.scratch.filePath("all.csv");
  desk.click_and_name("export_curves", table);
  ASSERT_TRUE(wait_until([&] { return QFileInfo::exists(table); }, kSolver));
  QFile csv(table);
  ASSERT_TRUE(csv.open(QIODevice::ReadOnly));
  EXPECT_EQ(csv.readAll().count('\n'), kRows + 1);
}

TEST(Panels, AFunctionOfTimeIsDrawnBesideTheTableOfConditions) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(2, "1 ms") + R"(gravity = [0, 0, "-9.81 m/s2"]
[[stage.constraint]]
group = "block"
velocity = { x = { ramp = { to = "2 m/s", end = "400 us" } }, z = { linear = "-1000 m/s2" } }
)"));
  auto* table = desk.find<QTableWidget>("conditions_table");
  ASSERT_EQ(table->rowCount(), 2);
  desk.click_stage("constraint");
  EXPECT_EQ(table->currentRow(), 1) << "the entry in hand";
  auto* chart = desk.find<LineChart>("load_chart");
  ASSERT_EQ(chart->lines().size(), 2U);
  EXPECT_EQ(chart->lines()[0].name, "velocity x");
  EXPECT_EQ(chart->lines()[0].y.back(), 2);
  EXPECT_EQ(chart->lines()[0].x.back(), 1e-3) << "s";
  EXPECT_EQ(chart->x_title(), "time [ms]") << "numbers are short";
  EXPECT_EQ(chart->y_title(), "velocity [m/s]");
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data(); }, kSolver));
  desk.picture("conditions");
  desk.window->document().set_value("stage[0].constraint[0].velocity", "{ x = \"5 m/s\" }");
  ASSERT_TRUE(wait_until([&] { return chart->lines()[0].y.front() == 5; }, 5000));
  desk.window->document().set_value("stage[0].constraint[0].velocity", "{ x = \"5 mm/s\" }");
  ASSERT_TRUE(wait_until([&] { return chart->lines()[0].y.front() == 5e-3; }, 5000));
  EXPECT_EQ(chart->y_title(), "velocity [mm/s]");
  table->setCurrentCell(0, 0);
  EXPECT_EQ(chart->lines()[0].name, "gravity z");
}

TEST(Panels, AClickOnAFaceChoosesItsConditionsAndChosenConditionsShowTheirFaces) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(2, "1 ms") + R"(
[[stage.constraint]]
group = "block.y0"
fixed = "xyz"
[[stage.pressure]]
surface = "block.x1"
value = "1 MPa"
[[stage.pressure]]
surface = "block.y1"
value = "2 MPa"
)"));
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  auto* table = desk.find<QTableWidget>("conditions_table");
  auto* canvas = desk.find<QWidget>("canvas");
  constexpr int kFaces = 2 * 2 * 4;  // triangles of a side of 2 x 2 cubes
  desk.click_stage("constraint");
  EXPECT_EQ(scene.num_chosen(), kFaces) << "the entry in hand";
  QTest::mouseClick(canvas, Qt::LeftButton, {}, desk.place_of("block.x1"));
  ASSERT_EQ(table->selectionModel()->selectedRows().size(), 1);
  EXPECT_EQ(table->item(table->currentRow(), 2)->text(), "block.x1");
  EXPECT_EQ(scene.num_chosen(), kFaces);

  desk.show_tab("Conditions");
  const auto click_row = [&](int row, Qt::KeyboardModifiers keys) {
    QTest::mouseClick(table->viewport(), Qt::LeftButton, keys, table->visualItemRect(table->item(row, 1)).center());
  };
  click_row(1, {});
  EXPECT_EQ(scene.num_chosen(), kFaces);
  click_row(2, Qt::ControlModifier);
  EXPECT_EQ(table->selectionModel()->selectedRows().size(), 2);
  EXPECT_EQ(scene.num_chosen(), 2 * kFaces) << "several rows at once";
  desk.picture("faces");

  desk.click_stage("pressure");
  desk.click("pick:stage[0].pressure[0].surface");
  QTest::mouseClick(canvas, Qt::LeftButton, {}, desk.place_of("block.z1"));
  EXPECT_EQ(desk.window->document().value("stage[0].pressure[0].surface"), "\"block.z1\"");
}

TEST(Panels, LoadsOfTheStageInHandAreSeenAsGlyphsWhichAKeyHides) {
  Desk desk;
  desk.window->resize(1500, 900);
  desk.window->open_path(written_case(desk.scratch, block_case(3, "1 ms") + R"(gravity = [0, "-9.81 m/s2", 0]
[[stage.constraint]]
group = "block.y0"
fixed = "xyz"
[[stage.pressure]]
surface = "block.z1"
value = "1 MPa"
[[stage]]
end = "2 ms"
[[stage.constraint]]
group = "block.y1"
velocity = { x = "2 m/s" }
[[initial_velocity]]
group = "block"
velocity = [0, "-3 m/s", 0]
)"));
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  desk.click_stage("material: block");
  EXPECT_EQ(scene.num_glyphs(), 0);
  desk.click_stage("constraint");
  const int first = scene.num_glyphs();
  EXPECT_GT(first, 50) << "gravity, what is fixed, the pressure, and what the first stage begins with";
  desk.picture("glyphs");
  QTest::keyClick(desk.window.get(), Qt::Key_L, Qt::ControlModifier);
  EXPECT_TRUE(wait_until([&] { return scene.num_glyphs() == 0; }, 5000));
  QTest::keyClick(desk.window.get(), Qt::Key_L, Qt::ControlModifier);
  EXPECT_TRUE(wait_until([&] { return scene.num_glyphs() == first; }, 5000));
  desk.window->document().set_value("stage[0].pressure[0].value", "\"-1 MPa\"");
  desk.window->document().remove("stage[0].gravity");
  EXPECT_TRUE(wait_until([&] { return scene.num_glyphs() == first - 1; }, 5000)) << "they follow the case";
  desk.window->findChild<CaseTree*>()->select(stage_of("stage[1].constraint[0]"), "stage[1].constraint[0]");
  EXPECT_GT(scene.num_glyphs(), 5);
  EXPECT_LT(scene.num_glyphs(), 30) << "those of the second stage alone";
}

/// The faces of a slit lie between elements of one body, and random velocities have no direction: both were not seen.
TEST(Panels, APressureInASlitAndRandomVelocitiesAreSeen) {
  Desk desk;
  desk.window->open_path(QString(BRECCIA_MESHES) + "/slit_plate/case_smoke.toml");
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  const auto drawn = [&] {
    const QImage image = desk.window->view().picture();
    int count = 0;  // pixels that are far more red than blue: the plate is blue
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        count += qRed(image.pixel(x, y)) > 2 * qBlue(image.pixel(x, y)) + 50 ? 1 : 0;
    return count;
  };
  const int before = drawn();  // the axis x in the corner
  desk.click_stage("pressure");
  EXPECT_GT(scene.num_glyphs(), 3);
  constexpr int kArrows = 100;
  EXPECT_GT(drawn(), before + kArrows) << "in front of the plate, in which the slit is";
  desk.picture("slit");
  desk.window->document().close();
  desk.window->open_path(written_case(desk.scratch, block_case(3, "1 ms") + R"([[initial_velocity]]
group = "block"
random = ["1 m/s", "5 m/s"]
)"));
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  desk.click_stage("initial velocity");
  EXPECT_GT(scene.num_glyphs(), 3);
}

TEST(Panels, AHistogramOfTheResultInViewShowsTheElementsAndJointsOfItsBars) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("200 us")), run = desk.scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", run}), 0);
  desk.window->open_path(run);
  auto* panel = desk.find<HistogramPanel>("histogram");
  auto* bars = desk.find<HistogramView>("histogram_bars");
  auto* measure = desk.find<QComboBox>("histogram_measure");
  Scene& scene = desk.window->view().scene();
  desk.window->view().set_colouring(colouring_by(Quantity::speed));
  EXPECT_EQ(measure->currentText(), "speed [m/s]") << "what is coloured";
  constexpr std::size_t kElements = 4 * 4 * 4 * 24;
  const auto counted = [&](Measure of) {
    return !desk.window->busy() && panel->values() != nullptr && panel->values()->measure == of &&
           !panel->values()->values.empty();
  };
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && counted(measure_of(Quantity::speed)); }, kSolver));
  const auto total = [&] { return std::accumulate(bars->bars().counts.begin(), bars->bars().counts.end(), 0U); };
  EXPECT_EQ(total(), kElements);
  const auto [low, high] = scene.range();
  EXPECT_LE(bars->bars().low, low);
  EXPECT_GE(bars->bars().low + bars->bars().width * static_cast<double>(bars->bars().counts.size()), high * (1 - 1e-9));

  desk.show_tab("Histogram");
  bars->setFocus();
  QTest::keyClick(bars, Qt::Key_Home);
  EXPECT_TRUE(wait_until([&] { return scene.num_marked() > 0; }, kSolver));
  const auto marked = scene.num_marked();
  EXPECT_LE(marked, 4 * bars->bars().counts[0]);
  desk.picture("histogram");
  auto* frame = desk.find<QSlider>("frame");
  frame->setValue(frame->value() - 1);
  QTest::keyClick(frame, Qt::Key_Left);
  EXPECT_TRUE(wait_until([&] { return counted(measure_of(Quantity::speed)) && bars->chosen() == 0; }, kSolver))
      << "the bar stays chosen while one walks through the frames";

  QTest::keyClick(frame, Qt::Key_End);
  measure->setCurrentText("damage of damaged joints");
  ASSERT_TRUE(wait_until([&] { return counted(Measure::damage); }, kSolver));
  EXPECT_EQ(scene.num_marked(), 0);
  EXPECT_GT(bars->bars().counts.back(), 0) << "what is broken is damaged whole";
  bars->choose(static_cast<int>(bars->bars().counts.size()) - 1);
  EXPECT_TRUE(wait_until([&] { return scene.num_marked() == bars->bars().counts.back(); }, kSolver))
      << "a joint is a triangle";
}

/// What the bar is of was looked for in the frame that was counted next, which may have nothing.
TEST(Panels, ABarThatIsChosenWhileAnotherFrameIsCountedIsOfTheFrameWhoseBarsAreSeen) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(2, "1 ms")));
  auto* panel = desk.find<HistogramPanel>("histogram");
  auto* bars = desk.find<HistogramView>("histogram_bars");
  ASSERT_TRUE(wait_until([&] { return !desk.window->busy() && !bars->bars().counts.empty(); }, kSolver));
  panel->set_frame({}, false);
  bars->choose(0);
  EXPECT_TRUE(wait_until([&] { return !panel->busy() && bars->bars().counts.empty(); }, kSolver));
}

TEST(Panels, APreviewThatWasLeftWhileItWasReadIsReadWhenOneComesBack) {
  constexpr int kCells = 14;
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us")), run = desk.scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", run}), 0);
  desk.window->open_path(written_case(desk.scratch, block_case(kCells, "1 ms")));
  ASSERT_TRUE(wait_until([&] { return desk.window->findChild<FrameLoader*>()->busy(); }, kSolver));
  desk.window->open_path(run);
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  EXPECT_TRUE(scene.groups().empty()) << "the names of the groups are those of another case";
  desk.click_stage("material: block");
  EXPECT_TRUE(wait_until([&] { return scene.num_faces() == 6 * 4 * kCells * kCells; }, kSolver));
  EXPECT_EQ(scene.groups(), std::vector<std::string>{"block"});
}

TEST(Panels, TheEstimateComesAlthoughTheMeshIsStillMadeWhenItIsAskedFor) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(4, "1 ms")));
  desk.click_stage("Run");
  EXPECT_TRUE(wait_until([&] { return desk.find<QLabel>("estimate")->text().contains("stable step"); }, kSolver));
}

TEST(Panels, AFolderOfARunIsTheSameRunHoweverItIsWritten) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("100 us")), run = desk.scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", run}), 0);
  for (const QString& written : {run, run + "/", desk.scratch.filePath("./run"), QDir().relativeFilePath(run)})
    desk.window->open_path(written);
  EXPECT_EQ(desk.find<QTableWidget>("runs")->rowCount(), 1);
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  EXPECT_EQ(scene.groups(), std::vector<std::string>{"block"});
  desk.window->view().set_colouring(Colouring::group);
  ASSERT_EQ(scene.class_legend().classes().size(), 1U);
  EXPECT_EQ(scene.class_legend().classes()[0].name, "block");
}

TEST(Panels, ABarOfTheHistogramShowsItsElements) {
  Desk desk;
  desk.window->open_path(QString(BRECCIA_MESHES) + "/glass_impact/case_demo.toml");
  auto* bars = desk.find<HistogramView>("histogram_bars");
  ASSERT_TRUE(
      wait_until([&] { return desk.window->view().scene().has_data() && !bars->bars().counts.empty(); }, kSolver));
  SolverQuery query;
  QJsonObject told;
  QObject::connect(&query, &SolverQuery::answered, [&](const QJsonObject& json) { told = json; });
  query.ask(BRECCIA_PROGRAM, {"mesh", desk.window->document().file(), "--json"});
  ASSERT_TRUE(wait_until([&] { return !told.isEmpty(); }, kSolver));
  const QJsonArray counts = told["quality"].toArray();
  ASSERT_EQ(counts.size(), static_cast<int>(bars->bars().counts.size()));
  for (int bar = 0; bar < counts.size(); ++bar)
    EXPECT_NEAR(bars->bars().counts[static_cast<std::size_t>(bar)], counts[bar].toInt(), 2) << "those of the solver";

  desk.show_tab("Histogram");
  int fullest = 0;
  for (int bar = 0; bar < counts.size(); ++bar)
    if (counts[bar].toInt() > counts[fullest].toInt()) fullest = bar;
  QTest::mouseClick(bars, Qt::LeftButton, {}, bars->place_of(fullest).center().toPoint());
  Scene& scene = desk.window->view().scene();
  auto* panel = desk.find<HistogramPanel>("histogram");
  // Seen are the faces that no two of the chosen elements share.
  const auto shows = [&](int bar) {
    const int count = bars->bars().counts[static_cast<std::size_t>(bar)];
    return !panel->busy() && scene.num_marked() > 0 && scene.num_marked() <= 4 * count &&
           desk.find<QLabel>("histogram_words")->text().startsWith(QString("%1 elements").arg(count));
  };
  EXPECT_TRUE(wait_until([&] { return shows(fullest); }, kSolver));
  QTest::keyClick(bars, Qt::Key_Left);
  EXPECT_TRUE(wait_until([&] { return shows(fullest - 1); }, kSolver));
  QTest::keyClick(bars, Qt::Key_Left);
  QTest::keyClick(bars, Qt::Key_Left);
  EXPECT_TRUE(wait_until([&] { return shows(fullest - 3); }, kSolver));
  desk.picture("quality");
  QTest::keyClick(bars, Qt::Key_Escape);
  EXPECT_EQ(scene.num_marked(), 0);
}

}  // namespace
}  // namespace breccia::gui::test::panels_test
