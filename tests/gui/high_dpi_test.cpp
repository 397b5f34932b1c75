#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLabel>
#include <QSlider>
#include <QTabBar>

#include "gui/desk.hpp"

// Run with QT_SCALE_FACTOR 1, 1.5 and 2 (tests/gui/CMakeLists.txt).

namespace breccia::gui::test::high_dpi_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

bool shows_its_text(const QLabel& label) {
  if (label.text().isEmpty() || !label.pixmap(Qt::ReturnByValue).isNull()) return true;
  if (label.wordWrap()) return label.height() >= label.heightForWidth(label.width());
  return label.width() >= label.sizeHint().width();
}

/// Widgets in sight with less room than their texts need.
QStringList cut_texts(const QWidget& window) {
  QStringList cut;
  const auto tell = [&](const QWidget& widget, const QString& text) {
    cut << QString("%1 '%2' has %3 x %4 of %5 x %6")
               .arg(widget.objectName(), text)
               .arg(widget.width())
               .arg(widget.height())
               .arg(widget.sizeHint().width())
               .arg(widget.sizeHint().height());
  };
  for (const auto* label : window.findChildren<QLabel*>())
    if (label->isVisible() && !shows_its_text(*label)) tell(*label, label->text());
  for (const auto* button : window.findChildren<QAbstractButton*>())
    if (button->isVisible() && !button->text().isEmpty() && button->width() < button->minimumSizeHint().width())
      tell(*button, button->text());
  for (const auto* bar : window.findChildren<QTabBar*>())
    if (bar->isVisible() && bar->count() > 0 && bar->tabRect(bar->count() - 1).right() > bar->width())
      tell(*bar, bar->tabText(bar->count() - 1));
  return cut;
}

/// What has just been shown is laid out a moment later.
std::string cut_for_good(const QWidget& window) {
  constexpr int kLaidOut = 5000;  // ms
  (void)wait_until([&] { return cut_texts(window).isEmpty(); }, kLaidOut);
  return cut_texts(window).join('\n').toStdString();
}

TEST(HighDpi, EveryStageAndPanelHasRoomForItsTextsAndTheViewIsDrawnAndPickedInPixelsOfTheScreen) {
  Desk desk;
  const double scale = desk.window->devicePixelRatioF();
  const QString wanted = qEnvironmentVariable("QT_SCALE_FACTOR", "1");
  ASSERT_EQ(scale, wanted.toDouble());
  const QString suffix = "_" + QString::number(100 * scale);
  EXPECT_EQ(cut_for_good(*desk.window), "") << "start";
  desk.picture("start" + suffix);
  desk.window->open_path(QString(BRECCIA_MESHES) + "/block_wall/case_smoke.toml");
  View3D& view = desk.window->view();
  ASSERT_TRUE(wait_until([&] { return view.scene().has_data() && !desk.window->busy(); }, kSolver));
  for (const char* stage : {"title", "mesh", "material: block", "joint: block", "contact: ", "initial velocity",
                            "constraint", "time", "domains", "output", "Run", "Results"}) {
    desk.click_stage(stage);
    EXPECT_EQ(cut_for_good(*desk.window), "") << stage;
  }
  for (const char* tab :
       {"Messages", "Plots", "Text", "Runs", "Queue", "Study", "Histogram", "Conditions", "Joint law", "Contacts"}) {
    desk.show_tab(tab);
    EXPECT_EQ(cut_for_good(*desk.window), "") << tab;
  }
  auto* canvas = desk.find<QWidget>("canvas");
  const QImage image = view.picture();
  EXPECT_NEAR(image.width(), scale * canvas->width(), 1);
  EXPECT_NEAR(image.height(), scale * canvas->height(), 1);
  const auto& rows = view.scene().class_legend().rows();
  ASSERT_EQ(rows.size(), 2U);
  constexpr double kBox = 14, kRounded = 1;  // pixels at 100 %
  EXPECT_NEAR(rows[0].box[2], scale * kBox, kRounded);
  QTest::mouseClick(canvas, Qt::LeftButton, {}, desk.place_of("block"));
  EXPECT_TRUE(desk.find<QWidget>("field:material[0].young")->isVisible());
  desk.picture("block" + suffix);
}

TEST(SmallScreen, EveryStageFitsAndItsSlidersCanBeMoved) {
  constexpr QSize kScreen(1024, 700);
  constexpr int kSlider = 60;  // pixels
  Desk desk;
  desk.window->open_path(QString(BRECCIA_MESHES) + "/block_wall/case_smoke.toml");
  ASSERT_TRUE(wait_until([&] { return desk.window->view().scene().has_data() && !desk.window->busy(); }, kSolver));
  desk.window->resize(kScreen);
  for (const char* stage : {"mesh", "material: block", "domains", "Run", "Results"}) {
    desk.click_stage(stage);
    EXPECT_EQ(cut_for_good(*desk.window), "") << stage;
    EXPECT_EQ(desk.window->size(), kScreen) << stage;
    for (const auto* slider : desk.window->findChildren<QSlider*>()) {
      if (!slider->isVisible()) continue;
      EXPECT_GE(slider->width(), kSlider) << stage << ": " << slider->objectName().toStdString();
    }
  }
  desk.picture("small_screen");
}

}  // namespace
}  // namespace breccia::gui::test::high_dpi_test
