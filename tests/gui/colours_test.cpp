#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <QComboBox>
#include <QLineEdit>
#include <QSlider>
#include <algorithm>

#include "gui/run_desk.hpp"
#include "render/element_values.hpp"

namespace breccia::gui::test::colours_test {
namespace {

void type(QLineEdit* field, const QString& text) {
  field->setFocus();
  field->selectAll();
  text.isEmpty() ? QTest::keyClick(field, Qt::Key_Delete) : QTest::keyClicks(field, text);
  QTest::keyClick(field, Qt::Key_Return);
}

/// Stress of a bar in tension along x: E times its strain, of both ends apart; nothing across but by its inertia.
TEST(Colours, OfAPulledBarAreItsStressAlongTheAxisThatIsChosen) {
  RunDesk desk(pulled_block());
  desk.window->view().set_colouring(colouring_by(Quantity::stress_xx));
  const auto along = desk.scene().range();
  desk.window->view().set_colouring(colouring_by(Quantity::tension));
  const auto largest = desk.scene().range();
  EXPECT_GT(along[1], 0);
  EXPECT_NEAR(along[1], largest[1], 0.02 * largest[1]) << "it is nearly the largest principal stress";
  desk.window->view().set_colouring(colouring_by(Quantity::stress_yz));
  EXPECT_LT(std::max(-desk.scene().range()[0], desk.scene().range()[1]), 0.2 * along[1]);
  desk.window->view().set_colouring(colouring_by(Quantity::compression));
  EXPECT_LT(desk.scene().range()[1], along[1]);
}

TEST(Colours, EveryQuantityIsReadAndCountedInTheUnitThatItsNameTells) {
  const QTemporaryDir scratch;
  const QString run = scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", written_case(scratch, pulled_block()), "-o", run}), 0);
  const FrameData frame = load_frame(read_series(run, "elements").back().file.toStdString(), "", 0, nullptr);
  ASSERT_NE(frame.elements, nullptr);
  const auto values = [&](Quantity quantity) { return values_of(frame, measure_of(quantity)).values; };
  for (int i = 0; i < kNumQuantities; ++i)
    EXPECT_EQ(values(static_cast<Quantity>(i)).size(), static_cast<std::size_t>(frame.elements->GetNumberOfCells()))
        << title_of(static_cast<Quantity>(i));
  vtkDataArray* von_mises = frame.elements->GetCellData()->GetArray("von_mises");
  const auto xx = values(Quantity::stress_xx), yy = values(Quantity::stress_yy), zz = values(Quantity::stress_zz),
             xy = values(Quantity::stress_xy), yz = values(Quantity::stress_yz), xz = values(Quantity::stress_xz),
             first = values(Quantity::tension), last = values(Quantity::compression);
  for (std::size_t e = 0; e < xx.size(); ++e) {
    const double a = xx[e] - yy[e], b = yy[e] - zz[e], c = zz[e] - xx[e];
    const double shear = xy[e] * xy[e] + yz[e] * yz[e] + xz[e] * xz[e];
    const double by_components = std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
    const double told = 1e-6 * von_mises->GetComponent(static_cast<vtkIdType>(e), 0);
    ASSERT_NEAR(by_components, told, 1e-5 * told);
    ASSERT_GE(first[e], std::max({xx[e], yy[e], zz[e]}) - 1e-5 * told);
    ASSERT_LE(last[e], std::min({xx[e], yy[e], zz[e]}) + 1e-5 * told);
  }
}

TEST(Colours, EndsThatAreTypedHoldForTheirQuantityInAllFrames) {
  RunDesk desk(pulled_block());
  auto *low = desk.find<QLineEdit>("colours_from"), *high = desk.find<QLineEdit>("colours_to");
  EXPECT_FALSE(low->isEnabled()) << "groups have no range";
  EXPECT_TRUE(low->placeholderText().isEmpty());
  desk.window->view().set_colouring(colouring_by(Quantity::displacement_x));
  ASSERT_TRUE(low->isEnabled());
  const auto found = desk.scene().range();  // um
  EXPECT_NEAR(high->placeholderText().toDouble(), found[1], 1e-3 * found[1]);
  type(high, "10");
  EXPECT_EQ(desk.scene().range()[1], 10);
  EXPECT_EQ(desk.scene().range()[0], found[0]);
  desk.picture("colours");
  QTest::keyClick(desk.find<QSlider>("frame"), Qt::Key_Home);
  ASSERT_TRUE(wait_until([&] { return desk.caption().startsWith("time 0 ") && !desk.window->busy(); }, kSolver))
      << desk.caption().toStdString();
  EXPECT_EQ(desk.scene().range()[1], 10) << "in the unit that it was typed in, though nothing has moved";
  desk.window->view().set_colouring(colouring_by(Quantity::speed));
  EXPECT_TRUE(high->text().isEmpty());
  desk.window->view().set_colouring(colouring_by(Quantity::displacement_x));
  EXPECT_EQ(high->text(), "10");
  type(low, "12");
  EXPECT_EQ(desk.scene().range()[1], 10) << "above the other end: nothing changes";
  EXPECT_FALSE(low->styleSheet().isEmpty()) << "and it is marked";
  type(low, "-2,5");
  EXPECT_EQ(desk.scene().range()[0], -2.5);
  type(low, "");
  type(high, "");
  EXPECT_EQ(desk.scene().colour_range(), ColourRange{});
  EXPECT_LT(desk.scene().range()[0], desk.scene().range()[1]) << "of a frame where all values are equal";
}

TEST(Colours, JointsThatAreHiddenHaveNoLegend) {
  RunDesk desk(turning_case("300 us"));
  ASSERT_GT(desk.scene().num_broken(), 0);
  const double with = desk.window->view().drawn_share();
  desk.find<QComboBox>("joints_by")->setCurrentText("hidden");
  EXPECT_LT(desk.window->view().drawn_share(), with);
  desk.find<QComboBox>("joints_by")->setCurrentText("mode");
  EXPECT_EQ(desk.window->view().drawn_share(), with);
}

}  // namespace
}  // namespace breccia::gui::test::colours_test
