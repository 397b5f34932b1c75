#include <gtest/gtest.h>

#include <QCheckBox>
#include <QImage>
#include <algorithm>
#include <cstdlib>
#include <set>

#include "gui/desk.hpp"

namespace breccia::gui::test::legend_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

/// Pixels of a rectangle that is counted from the lower left corner.
std::set<QRgb> colours_in(const QImage& image, const std::array<int, 4>& box, int inset) {
  std::set<QRgb> found;
  for (int y = box[1] + inset; y < box[1] + box[3] - inset; ++y)
    for (int x = box[0] + inset; x < box[0] + box[2] - inset; ++x)
      if (image.rect().contains(x, image.height() - 1 - y)) found.insert(image.pixel(x, image.height() - 1 - y));
  return found;
}

/// Names of classes used to lie over their boxes when the first picture had a translucent skin.
TEST(Legend, NamesStandBesideTheirBoxesInAFirstPictureThatIsSeenThrough) {
  Desk desk;
  desk.find<QCheckBox>("solid")->setChecked(false);
  desk.window->open_path(QString(BRECCIA_MESHES) + "/block_wall/case_smoke.toml");
  View3D& view = desk.window->view();
  ASSERT_TRUE(wait_until([&] { return view.scene().has_data(); }, kSolver));
  const QImage image = view.picture();
  const auto& rows = view.scene().class_legend().rows();
  ASSERT_EQ(rows.size(), 2U);
  for (const ClassLegend::Row& row : rows) {
    constexpr int kEdge = 2, kInk = 100;  // pixels that are smoothed at the edge; lightness of 255
    EXPECT_EQ(colours_in(image, row.box, kEdge).size(), 1U) << "nothing lies over the colour";
    int darkest = 255;
    for (const QRgb colour : colours_in(image, row.name, 0)) darkest = std::min(darkest, qGray(colour));
    EXPECT_LT(darkest, kInk) << "the name is drawn where it was measured";
    EXPECT_GE(row.name[0], row.box[0] + row.box[2]);
    EXPECT_LE(row.name[0] + row.name[2], image.width());
  }
}

/// The lower corner of a cube used to be below the view.
TEST(Legend, TheModelStandsWholeBesideIt) {
  Desk desk;
  desk.window->open_path(written_case(desk.scratch, block_case(3, "1 ms")));
  View3D& view = desk.window->view();
  ASSERT_TRUE(wait_until([&] { return view.scene().has_data(); }, kSolver));
  const QImage image = view.picture();
  const auto& row = view.scene().class_legend().rows().at(0);
  const auto is_drawn = [&](int x, int y) {
    constexpr int kBackground = 8;  // of 255: some versions of VTK scatter its colours
    return std::abs(qGray(image.pixel(x, y)) - qGray(image.pixel(0, y))) > kBackground;
  };
  for (int x = 0; x < image.width(); ++x) {
    EXPECT_FALSE(is_drawn(x, 0)) << x;
    EXPECT_FALSE(is_drawn(x, image.height() - 1)) << x;
  }
  constexpr int kBeside = 3;  // pixels
  for (int y = image.height() / 4; y < image.height(); ++y) EXPECT_FALSE(is_drawn(row.box[0] - kBeside, y)) << y;
}

}  // namespace
}  // namespace breccia::gui::test::legend_test
