#include "render/deformation.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <QComboBox>
#include <QProcess>
#include <QSlider>

#include "gui/run_desk.hpp"
#include "render/frame_data.hpp"

namespace breccia::gui::test::deformation_test {
namespace {

struct Results : RunDesk {
  using RunDesk::RunDesk;
  void choose(const QString& scale) {
    auto* box = find<QComboBox>("deformation");
    box->setFocus();
    box->lineEdit()->selectAll();
    QTest::keyClicks(box->lineEdit(), scale);
    QTest::keyClick(box->lineEdit(), Qt::Key_Return);
    EXPECT_TRUE(wait_until([this] { return !window->busy(); }, kSolver));
  }
};

TEST(Deformation, CornersMoveSoManyTimesFurtherFromWhereTheyRestAndJointsWithTheirFaces) {
  const QTemporaryDir scratch;
  const QString run = scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", written_case(scratch, turning_case("200 us")), "-o", run}), 0);
  const auto frames = read_series(run, "elements");
  ASSERT_GE(frames.size(), 2U);
  const auto first = read_vtkhdf(frames.front().file.toStdString()),
             last = read_vtkhdf(frames.back().file.toStdString());
  const auto rest = RestPlaces::of(first);
  ASSERT_NE(rest, nullptr);
  EXPECT_EQ(RestPlaces::of(last), nullptr) << "it has moved";
  EXPECT_NEAR(rest->size(), 0.04, 1e-9);
  constexpr double kScale = 3, kSingle = kScale * 2e-8;  // m: places near 0.1 m in single precision
  const auto enlarged = enlarged_elements(*last, *rest, kScale);
  vtkDataArray* moved = last->GetCellData()->GetArray("displacement");
  vtkDataArray* id = last->GetCellData()->GetArray("id");
  for (vtkIdType c = 0; c < last->GetNumberOfCells(); ++c) {
    Vector centre{}, at_rest{};
    for (int i = 0; i < 4; ++i) {
      Vector p{};
      enlarged->GetPoint(4 * c + i, p.data());
      centre = centre + 0.25 * p;
      at_rest = at_rest + 0.25 * *rest->corner(static_cast<std::int64_t>(id->GetComponent(c, 0)), i);
    }
    for (int a = 0; a < 3; ++a)
      ASSERT_NEAR(centre[static_cast<std::size_t>(a)] - at_rest[static_cast<std::size_t>(a)],
                  kScale * moved->GetComponent(c, a), kSingle);
  }
  QString joints = frames.back().file;
  joints.replace("/elements_", "/joints_");
  const FrameData frame = load_frame(frames.back().file.toStdString(), joints.toStdString(), 0, nullptr,
                                     {kScale, frames.front().file.toStdString(), nullptr, false});
  ASSERT_NE(frame.joints, nullptr);
  std::array<double, 6> of_joints{}, of_skin{}, true_box{};
  frame.joints->GetBounds(of_joints.data());
  frame.skin->GetBounds(of_skin.data());
  frame.elements->GetBounds(true_box.data());
  EXPECT_GT(of_skin[1] - of_skin[0], 1.2 * (true_box[1] - true_box[0]));
  for (std::size_t a = 0; a < 6; a += 2) {
    EXPECT_GE(of_joints[a], of_skin[a] - 1e-9);
    EXPECT_LE(of_joints[a + 1], of_skin[a + 1] + 1e-9);
  }
}

TEST(Deformation, IsDrawnAtTheScaleThatIsTypedAndTheCaptionTellsIt) {
  Results desk(pulled_block());
  const auto wide = [&] {
    const auto x = desk.scene().extent({1, 0, 0});
    return x[1] - x[0];
  };
  const double is = wide() - 0.02;
  EXPECT_GT(is, 0);
  EXPECT_FALSE(desk.seen_words().contains("displacements"));
  desk.choose("x100");
  EXPECT_TRUE(wait_until([&] { return wide() > 0.02 + 50 * is; }, kSolver));
  EXPECT_NEAR(wide() - 0.02, 100 * is, 1e-4 * 100 * is);
  EXPECT_TRUE(desk.seen_words().contains("displacements x100")) << desk.seen_words().toStdString();
  desk.window->view().set_colouring(colouring_by(Quantity::displacement_x));
  EXPECT_NEAR(desk.scene().range()[1], 4.6, 0.5) << "um, of centres of elements: values are true at any scale";
  desk.picture("deformation");
  desk.choose("nonsense");
  EXPECT_NEAR(wide() - 0.02, 100 * is, 1e-4 * 100 * is) << "it stays as it was";
  desk.choose("automatic");
  EXPECT_TRUE(wait_until([&] { return std::abs(wide() - 0.02 - 100 * is) > is; }, kSolver));
  EXPECT_NEAR(wide() - 0.02, 200 * is, 1e-4 * 200 * is) << "a twentieth of the model or less: 1, 2 or 5 by ten";
  QTest::keyClick(desk.find<QSlider>("frame"), Qt::Key_Left);
  ASSERT_TRUE(wait_until([&] { return !desk.window->busy(); }, kSolver));
  EXPECT_TRUE(desk.seen_words().contains("displacements x200")) << "frames can be compared";
  desk.choose("1");
  EXPECT_TRUE(wait_until([&] { return std::abs(wide() - 0.02) < 2 * is; }, kSolver));
  desk.click_stage("material");
  EXPECT_FALSE(desk.find<QWidget>("deformation")->isEnabled()) << "a mesh at rest has none";
}

TEST(Deformation, OfARunWithoutAFrameAtRestIsTrueAndTheCaptionSaysWhy) {
  Results desk(pulled_block("frame_interval = 0\n"));
  desk.choose("x10");
  EXPECT_TRUE(wait_until([&] { return desk.seen_words().contains("no frame of this run is at rest"); }, kSolver))
      << desk.seen_words().toStdString();
}

}  // namespace
}  // namespace breccia::gui::test::deformation_test
