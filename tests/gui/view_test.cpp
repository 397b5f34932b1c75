#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <QComboBox>
#include <QDialog>
#include <QImage>
#include <QProcess>
#include <QSlider>
#include <QTableWidget>
#include <QTreeWidget>
#include <cmath>

#include "gui/desk.hpp"
#include "widgets/plots_panel.hpp"

namespace breccia::gui::test::view_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

/// A desktop whose window shows a case at rest.
struct Shown : Desk {
  explicit Shown(const QString& file) {
    window->open_path(file);
    shows_ = wait_until([this] { return scene().has_data() && !window->busy(); }, kSolver);
  }
  explicit Shown(const QByteArray& text) : Desk() {
    window->open_path(written_case(scratch, text));
    shows_ = wait_until([this] { return scene().has_data() && !window->busy(); }, kSolver);
  }
  [[nodiscard]] Scene& scene() { return window->view().scene(); }
  [[nodiscard]] bool shows() const { return shows_; }
  void key(Qt::Key key) {
    QTest::keyClick(window.get(), key, Qt::ControlModifier);
    QTest::qWait(50);
  }

 private:
  bool shows_ = false;
};

QByteArray pulled(const QByteArray& gravity) { return block_case(2, "1 ms") + "gravity = " + gravity + "\n"; }

std::array<double, 3> of(const double* three) { return {three[0], three[1], three[2]}; }

TEST(View, KeysLookAlongTheAxesWithWhatIsAgainstGravityUpwards) {
  Shown desk(pulled(R"(["9.81 m/s2", 0, 0])"));
  ASSERT_TRUE(desk.shows());
  EXPECT_EQ(desk.scene().up(), (std::array<double, 3>{-1, 0, 0}));
  vtkCamera& camera = *desk.scene().renderer()->GetActiveCamera();
  EXPECT_LT(camera.GetViewUp()[0], -0.9) << "from the beginning";
  const std::array<Qt::Key, 6> keys{Qt::Key_1, Qt::Key_2, Qt::Key_3, Qt::Key_4, Qt::Key_5, Qt::Key_6};
  for (std::size_t k = 0; k < keys.size(); ++k) {
    desk.key(keys[k]);
    std::array<double, 3> way{};  // from the eye to the model
    way[k / 2] = k % 2 == 0 ? -1 : 1;
    const auto seen = of(camera.GetDirectionOfProjection());
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(seen[a], way[a], 1e-9) << k;
    if (k > 1) {
      EXPECT_NEAR(camera.GetViewUp()[0], -1, 1e-9) << k;
    }
  }
  desk.key(Qt::Key_0);
  for (std::size_t a = 0; a < 3; ++a) EXPECT_GT(std::abs(camera.GetDirectionOfProjection()[a]), 0.1);
}

TEST(View, ModelsStandAsTheirTemplatesAreDrawn) {
  const std::array<std::pair<const char*, std::array<double, 3>>, 4> cases{{{"block_drop/case.toml", {0, 0, 1}},
                                                                            {"glass_impact/case_demo.toml", {0, 1, 0}},
                                                                            {"block_wall/case_smoke.toml", {0, 1, 0}},
                                                                            {"expanding_ring/case.toml", {0, 1, 0}}}};
  for (const auto& [file, up] : cases) {
    Desk desk;
    desk.window->open_path(QString(BRECCIA_MESHES) + "/" + file);
    EXPECT_EQ(desk.window->view().scene().up(), up) << file;
  }
}

/// Pixels of the lower left corner, above the caption, that differ from the ground.
int drawn_in_corner(const QImage& image) {
  constexpr int kCaption = 30;
  int drawn = 0;
  for (int y = image.height() - static_cast<int>(AxesCorner::kSize); y < image.height() - kCaption; ++y)
    for (int x = 1; x < static_cast<int>(AxesCorner::kSize); ++x)
      drawn += std::abs(qGray(image.pixel(x, y)) - qGray(image.pixel(0, y))) > 8 ? 1 : 0;
  return drawn;
}

TEST(View, AxesAreInTheCornerAndTheScaleBarIsAsLongAsItSays) {
  Shown desk(block_case(3, "1 ms"));
  ASSERT_TRUE(desk.shows());
  EXPECT_GT(drawn_in_corner(desk.window->view().picture()), 100);
  const ScaleBar& bar = desk.scene().scale_bar();
  const QStringList words = QString::fromStdString(bar.words()).split(' ');
  ASSERT_EQ(words.size(), 2) << bar.words();
  EXPECT_EQ(words[1], "mm") << "a block of 30 mm";
  vtkRenderer& renderer = *desk.scene().renderer();
  vtkCamera& camera = *renderer.GetActiveCamera();
  const auto begin = of(camera.GetFocalPoint()), up = of(camera.GetViewUp());
  const auto pixels_of = [&](std::array<double, 3> x) {
    renderer.SetWorldPoint(x[0], x[1], x[2], 1);
    renderer.WorldToDisplay();
    return of(renderer.GetDisplayPoint());
  };
  // As far upwards, in the plane that the camera looks at.
  const double metres = 1e-3 * words[0].toDouble();
  const auto way = of(camera.GetDirectionOfProjection());
  const double along = up[0] * way[0] + up[1] * way[1] + up[2] * way[2];
  std::array<double, 3> across{up[0] - along * way[0], up[1] - along * way[1], up[2] - along * way[2]};
  const double size = std::hypot(across[0], across[1], across[2]);
  const auto from = pixels_of(begin),
             to = pixels_of({begin[0] + metres * across[0] / size, begin[1] + metres * across[1] / size,
                             begin[2] + metres * across[2] / size});
  EXPECT_NEAR(std::hypot(to[0] - from[0], to[1] - from[1]), bar.pixels(), 1);
  desk.key(Qt::Key_7);
  EXPECT_EQ(drawn_in_corner(desk.window->view().picture()), 0);
}

/// On a model that fills the view, dark or light, words used to have no ground of their own.
TEST(View, CaptionAndLegendAreReadOverAnyModel) {
  Shown desk(block_case(3, "1 ms"));
  ASSERT_TRUE(desk.shows());
  for (const bool dark : {false, true}) {
    desk.window->set_dark(dark);
    desk.scene().renderer()->GetActiveCamera()->Zoom(dark ? 1 : 8);
    const QImage image = desk.window->view().picture();
    const auto& row = desk.scene().class_legend().rows().at(0);
    int lightest = 0, darkest = 255;
    for (int y = row.name[1]; y < row.name[1] + row.name[3]; ++y)
      for (int x = row.name[0]; x < row.name[0] + row.name[2]; ++x) {
        const int grey = qGray(image.pixel(x, image.height() - 1 - y));
        lightest = std::max(lightest, grey);
        darkest = std::min(darkest, grey);
      }
    constexpr int kApart = 130;  // of 255, of words and ground
    EXPECT_GT(lightest - darkest, kApart) << dark;
    desk.picture(dark ? "over_model_in_dark" : "over_model");
  }
  desk.window->set_dark(false);  // colours are those of the whole program
}

TEST(View, AStretchingGoesOutwardsAndItsWordsAreNotCovered) {
  Shown desk(QString(BRECCIA_MESHES) + "/expanding_ring/case.toml");
  ASSERT_TRUE(desk.shows());
  desk.click_stage("initial velocity");
  EXPECT_GT(desk.scene().num_glyphs(), 8);
  desk.picture("ring");
  auto* table = desk.find<QTableWidget>("conditions_table");
  EXPECT_TRUE(table->item(0, 3)->text().startsWith("strain rate 3 1/s, 3 1/s, 0"))
      << table->item(0, 3)->text().toStdString();
}

TEST(View, WordsOfTheLoadsOfOneGroupDoNotCoverEachOther) {
  Shown desk(block_case(2, "1 ms") + R"([[initial_velocity]]
group = "block"
velocity = [0, "-3 m/s", 0]
angular = [0, "20 rad/s", 0]
strain_rate = ["-30 1/s", 0, "20 1/s"]
random = [0, "1 m/s"]
)");
  ASSERT_TRUE(desk.shows());
  desk.click_stage("initial velocity");
  for (const Qt::Key key : {Qt::Key_0, Qt::Key_1, Qt::Key_4}) {
    desk.key(key);
    desk.window->view().render_now();
    const auto& boxes = desk.scene().load_words().boxes();
    ASSERT_EQ(boxes.size(), 4U);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const auto &a = boxes[i], &b = boxes[k];
        EXPECT_FALSE(a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]) << i << " over " << k;
      }
  }
  desk.key(Qt::Key_0);
  desk.picture("motions");
}

/// A desktop with the results of a block that its rotation has torn, with a gauge.
struct Torn : Desk {
  QString file, run;
  explicit Torn(const QByteArray& more = {}) {
    file = written_case(scratch, turning_case("300 us") + more);
    run = scratch.filePath("run");
    EXPECT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", run}), 0);
    window->open_path(run);
    EXPECT_TRUE(wait_until([this] { return window->view().scene().num_broken() > 0 && !window->busy(); }, kSolver));
    window->activateWindow();  // keys go to an active window alone
    EXPECT_TRUE(QTest::qWaitForWindowActive(window.get()));
  }
};

TEST(View, JointsAreColouredByTheTimeAtWhichTheyFailed) {
  Torn desk;
  Scene& scene = desk.window->view().scene();
  EXPECT_EQ(scene.failure_range()[1], 0);
  desk.find<QComboBox>("joints_by")->setCurrentText("time of failure");
  EXPECT_GT(scene.failure_range()[1], 0);
  EXPECT_LE(scene.failure_range()[1], 300e-6);
  desk.picture("failure");
  desk.find<QComboBox>("joints_by")->setCurrentText("mode");
  EXPECT_EQ(scene.failure_range()[1], 0);
}

TEST(View, AKeyPlaysTheFramesToTheLast) {
  Torn desk;
  auto* slider = desk.find<QSlider>("frame");
  ASSERT_GE(slider->maximum(), 2);
  std::vector<int> seen;
  QObject::connect(slider, &QSlider::valueChanged, [&](int n) { seen.push_back(n); });
  auto* play = desk.find<QAbstractButton>("play");
  QTest::keyClick(desk.window.get(), Qt::Key_F9);
  ASSERT_TRUE(wait_until([&] { return play->isChecked(); }, 5000));
  EXPECT_TRUE(wait_until([&] { return !play->isChecked(); }, 30000));
  ASSERT_EQ(static_cast<int>(seen.size()), slider->maximum() + 1) << "each once, from the first";
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<int>(i));
  desk.click("play");
  desk.click_stage("material");
  EXPECT_FALSE(play->isChecked()) << "not while other things are shown";
}

QTreeWidgetItem* curve_item(QTreeWidget& list, const QString& column) {
  for (QTreeWidgetItemIterator it(&list); *it != nullptr; ++it)
    if ((*it)->data(0, Qt::UserRole).toString() == column) return *it;
  throw std::runtime_error("no curve " + column.toStdString());
}

TEST(View, CurvesAreChosenFromAListThatHasGaugesAndContacts) {
  Torn desk("gauges = [\"block\"]\n");
  auto* plots = desk.find<PlotsPanel>("plots");
  auto* list = desk.find<QTreeWidget>("curves");
  desk.show_tab("Plots");
  const int first = plots->num_curves();
  EXPECT_GE(first, 4);
  for (const char* column : {"contacts", "block velocity x [m/s]", "max speed [m/s]"})
    EXPECT_EQ(curve_item(*list, column)->checkState(0), Qt::Unchecked) << column;
  QTreeWidgetItem* speed = curve_item(*list, "block velocity x [m/s]");
  list->expandAll();
  list->scrollToItem(speed);
  list->setCurrentItem(speed);
  QTest::keyClick(list, Qt::Key_Space);
  EXPECT_EQ(plots->num_curves(), first + 1);
  desk.picture("plots");
  QTest::keyClick(list, Qt::Key_Space);
  EXPECT_EQ(plots->num_curves(), first);
}

/// Only the kinetic energy and the broken joints of the other run used to be drawn.
TEST(View, EveryChosenCurveIsDrawnOfBothRunsThatAreCompared) {
  Torn desk;
  const QString other = desk.scratch.filePath("other");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", desk.file, "-o", other}), 0);
  auto* plots = desk.find<PlotsPanel>("plots");
  const int first = plots->num_curves();
  desk.window->open_path(other);
  ASSERT_TRUE(wait_until([&] { return plots->num_curves() == first; }, kSolver));
  auto* runs = desk.find<QTableWidget>("runs");
  for (int row = 0; row < runs->rowCount(); ++row)
    for (int column = 0; column < runs->columnCount(); ++column)
      if (auto* item = runs->item(row, column); item != nullptr && item->flags().testFlag(Qt::ItemIsUserCheckable))
        item->setCheckState(Qt::Checked);
  EXPECT_TRUE(wait_until([&] { return plots->num_curves() == 2 * first; }, 5000)) << plots->num_curves();
  desk.show_tab("Plots");
  desk.picture("compared");
}

TEST(View, AKeyListsTheKeys) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(2, "1 ms")));
  QTest::keyClick(desk.window.get(), Qt::Key_F1, Qt::ControlModifier);
  auto* table = desk.find<QTableWidget>("keys_table");
  QStringList listed;
  for (int row = 0; row < table->rowCount(); ++row) listed << table->item(row, 0)->text();
  for (const QAction* action : desk.window->findChildren<QAction*>())
    for (const QKeySequence& keys : action->shortcuts())
      EXPECT_TRUE(listed.contains(keys.toString(QKeySequence::NativeText))) << action->text().toStdString();
  for (const char* keys : {"F5", "Ctrl+L", "F9", "Ctrl+1", "F1"}) EXPECT_TRUE(listed.contains(keys)) << keys;
  desk.picture("keys", desk.find<QDialog>("keys"));
}

}  // namespace
}  // namespace breccia::gui::test::view_test
