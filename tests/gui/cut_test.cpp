#include "render/cut.hpp"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QProcess>
#include <QSlider>
#include <set>

#include "gui/desk.hpp"
#include "gui/timed_application.hpp"

namespace breccia::gui::test::cut_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy

double area_of(vtkPolyData& faces) {
  double area = 0;
  for (vtkIdType c = 0; c < faces.GetNumberOfCells(); ++c) {
    vtkCell* polygon = faces.GetCell(c);
    const auto at = [&](vtkIdType i) {
      Vector p{};
      polygon->GetPoints()->GetPoint(i, p.data());
      return p;
    };
    for (vtkIdType i = 2; i < polygon->GetNumberOfPoints(); ++i)
      area += 0.5 * length(cross(at(i - 1) - at(0), at(i) - at(0)));
  }
  return area;
}

FrameData block_at_rest(const QTemporaryDir& scratch, int cells) {
  const QString out = scratch.filePath("mesh");
  EXPECT_EQ(QProcess::execute(BRECCIA_PROGRAM,
                              {"mesh", written_case(scratch, block_case(cells, "1 ms")), "--json", "-o", out}),
            0);
  return load_frame((out + "/elements_000000.vtkhdf").toStdString(), "", 0, nullptr);
}

TEST(Cut, OfABlockIsAsLargeAsItsSectionWhereverAndHoweverThePlaneLies) {
  const QTemporaryDir scratch;
  const FrameData frame = block_at_rest(scratch, 2);  // 20 mm wide
  ASSERT_NE(frame.elements, nullptr);
  constexpr double kSide = 0.02, kTiny = 1e-9;
  const Vector slanted = unit({1, 1, 0});
  for (const double offset : {0.003, 0.0123, 0.01, 0.0199})  // the third lies in faces of elements
    for (const Vector& normal : {Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0, 0, 1}}) {
      const double side = normal[1] < 0 ? -1 : 1;
      const auto faces = Cut(frame.elements, normal).faces(side * offset);
      EXPECT_NEAR(area_of(*faces), kSide * kSide, kTiny) << offset;
      EXPECT_TRUE(faces->GetCellData()->HasArray("von_mises"));
    }
  const double middle = dot(slanted, {0.01, 0.01, 0});
  EXPECT_NEAR(area_of(*Cut(frame.elements, slanted).faces(middle)), kSide * kSide * std::sqrt(2.0), kTiny);
  EXPECT_EQ(Cut(frame.elements, {1, 0, 0}).faces(-0.001)->GetNumberOfCells(), 0) << "nothing stays";
  EXPECT_EQ(Cut(frame.elements, {1, 0, 0}).faces(0.021)->GetNumberOfCells(), 0) << "nothing is hidden";
}

TEST(Cut, ThroughFacesOfElementsShowsThoseThatStay) {
  const QTemporaryDir scratch;
  const FrameData frame = block_at_rest(scratch, 2);
  vtkUnstructuredGrid& grid = *frame.elements;
  const auto faces = Cut(frame.elements, {1, 0, 0}).faces(0.01);
  ASSERT_GT(faces->GetNumberOfCells(), 0);
  for (vtkIdType c = 0; c < faces->GetNumberOfCells(); ++c) {
    const auto id = static_cast<vtkIdType>(faces->GetCellData()->GetArray("id")->GetComponent(c, 0));
    double least = 1;
    for (vtkIdType i = 4 * id; i < 4 * id + 4; ++i) least = std::min(least, grid.GetPoint(i)[0]);
    EXPECT_LT(least, 0.01 - 1e-6) << id;
  }
}

/// A desktop with a case at rest.
struct Whole : Desk {
  explicit Whole(const QByteArray& text) {
    window->open_path(written_case(scratch, text));
    EXPECT_TRUE(wait_until([this] { return scene().has_data() && !window->busy(); }, kSolver));
  }
  [[nodiscard]] Scene& scene() { return window->view().scene(); }
  void choose(const QString& way) {
    auto* box = find<QComboBox>("cut_way");
    box->setFocus();
    box->setCurrentText(way);
    emit box->activated(box->currentIndex());
  }
};

TEST(Cut, AKeyCutsTheMeshOpenAndSliderAndFieldMoveThePlane) {
  Whole desk(block_case(3, "1 ms"));  // 30 mm
  EXPECT_FALSE(desk.find<QWidget>("cut_slider")->isVisible());
  const double whole = desk.window->view().drawn_share();
  QTest::keyClick(desk.window.get(), Qt::Key_8, Qt::ControlModifier);
  auto* slider = desk.find<QSlider>("cut_slider");
  auto* place = desk.find<QLineEdit>("cut_place");
  ASSERT_TRUE(wait_until([&] { return slider->isVisible() && slider->hasFocus(); }, 5000));
  EXPECT_EQ(place->text(), "15 mm");
  EXPECT_GT(desk.scene().num_cut(), 0);
  EXPECT_LT(desk.window->view().drawn_share(), 0.95 * whole) << "half of it is hidden";
  QTest::keyClick(slider, Qt::Key_Home);
  EXPECT_EQ(place->text(), "0 m");
  desk.type("cut_place", "12,5 mm");
  EXPECT_EQ(place->text(), "12.5 mm");
  EXPECT_NEAR(slider->value(), slider->maximum() * 12.5 / 30, 1);
  desk.type("cut_place", "12 kg");
  EXPECT_TRUE(place->toolTip().contains("length")) << place->toolTip().toStdString();
  EXPECT_GT(desk.scene().num_cut(), 0) << "it stays where it was";
  desk.type("cut_place", "1 cm");
  EXPECT_EQ(place->text(), "10 mm");
  desk.click_stage("material");
  desk.picture("cut_mesh");
  QTest::keyClick(desk.window.get(), Qt::Key_8, Qt::ControlModifier);
  EXPECT_EQ(desk.scene().num_cut(), 0);
  EXPECT_NEAR(desk.window->view().drawn_share(), whole, 0.01);
}

TEST(Cut, AClickOnTheCutFaceFindsItsGroupAndThroughWhatIsHiddenNothingIsPicked) {
  Whole desk(block_case(3, "1 ms"));
  desk.window->view().scene().look_from(LookFrom::plus_x);
  desk.choose("x");
  EXPECT_GT(desk.scene().num_cut(), 0);
  auto* canvas = desk.find<QWidget>("canvas");
  int seen = 0;
  for (int y = 5; y < canvas->height(); y += 20)
    for (int x = 5; x < canvas->width(); x += 20) {
      const Scene::Picked what = desk.window->view().picked_at({x, y});
      seen += what.volume == "block" ? 1 : 0;
      EXPECT_TRUE(what.surfaces.empty()) << "looked at along x the cut is in front of everything";
    }
  EXPECT_GT(seen, 20);
}

TEST(Cut, AcrossTheViewHidesWhatIsNearerAndTheOtherSideOnRequest) {
  Whole desk(block_case(3, "1 ms"));
  desk.choose("the view");
  ASSERT_GT(desk.scene().num_cut(), 0);
  EXPECT_TRUE(desk.window->view().caption().startsWith("mesh at rest"));
  const double near_hidden = desk.window->view().drawn_share();
  desk.click("cut_other");
  EXPECT_GT(desk.scene().num_cut(), 0);
  EXPECT_GT(std::abs(desk.window->view().drawn_share() - near_hidden), 0);
}

/// A plate on four supports, early in its impact.
TEST(Cut, IsSeenThroughWholeElementsOfAPlateThatIsHit) {
  Desk desk;
  const QString folder = desk.scratch.filePath("glass"), file = folder + "/case.toml";
  ASSERT_TRUE(QDir().mkpath(folder));
  QFile shipped(QString(BRECCIA_MESHES) + "/glass_impact/case_demo.toml"), own(file);
  ASSERT_TRUE(shipped.open(QIODevice::ReadOnly) && own.open(QIODevice::WriteOnly));
  own.write(shipped.readAll().replace("end = \"100 us\"", "end = \"8 us\"").replace("h = \"3 mm\"", "h = \"4 mm\""));
  own.close();
  ASSERT_TRUE(QFile::copy(QString(BRECCIA_MESHES) + "/glass_impact/geometry.geo", folder + "/geometry.geo"));
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", folder + "/runs/one", "--progress", "none"}), 0);
  desk.window->open_path(file);
  desk.click_stage("Results");
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  desk.window->view().set_colouring(colouring_by(Quantity::von_mises));
  auto* way = desk.find<QComboBox>("cut_way");
  way->setCurrentText("z");
  emit way->activated(way->currentIndex());
  EXPECT_GT(scene.num_cut(), 50);
  EXPECT_EQ(desk.find<QLineEdit>("cut_place")->text(), "0 m") << "the middle of the plate, with few digits";
  scene.renderer()->GetActiveCamera()->Zoom(1.7);
  desk.find<QAbstractButton>("edges")->setChecked(true);
  QTest::qWait(300);
  desk.picture("cut");
}

TEST(Cut, OfARunIsColouredByWhatIsChosen) {
  Desk desk;
  const QString file = written_case(desk.scratch, turning_case("300 us")), run = desk.scratch.filePath("run");
  ASSERT_EQ(QProcess::execute(BRECCIA_PROGRAM, {"run", file, "-o", run}), 0);
  desk.window->open_path(run);
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.num_broken() > 0 && !desk.window->busy(); }, kSolver));
  desk.window->view().set_colouring(colouring_by(Quantity::tension));
  auto* way = desk.find<QComboBox>("cut_way");
  way->setCurrentText("z");
  emit way->activated(way->currentIndex());
  ASSERT_GT(scene.num_cut(), 0);
  const auto range = scene.range();
  vtkDataArray* principal = scene.cut_values()->GetArray("principal");
  vtkDataArray* shown = scene.cut_values()->GetArray(Scene::kShown);
  ASSERT_NE(shown, nullptr);
  for (vtkIdType c = 0; c < shown->GetNumberOfTuples(); ++c) {
    EXPECT_DOUBLE_EQ(shown->GetTuple1(c), 1e-6 * principal->GetComponent(c, 0));
    EXPECT_GE(shown->GetTuple1(c), range[0]);
    EXPECT_LE(shown->GetTuple1(c), range[1]);
  }
  auto* frame = desk.find<QSlider>("frame");
  const vtkIdType torn = scene.num_cut();
  QTest::keyClick(frame, Qt::Key_Home);
  ASSERT_TRUE(wait_until([&] { return scene.num_broken() == 0; }, kSolver));
  EXPECT_GT(scene.num_cut(), 0) << "the plane stays where it is while the model moves through it";
  EXPECT_NE(scene.num_cut(), torn);
  desk.window->view().set_colouring(Colouring::group);
  EXPECT_EQ(scene.cut_values()->GetArray(Scene::kShown)->GetRange()[1], 0) << "one group";
}

/// What it takes is told, and left to people to judge: it is another machine's time everywhere else.
TEST(Cut, MovesThroughFourHundredThousandElements) {
  constexpr int kCells = 26, kMoves = 40;
  Desk desk;
  desk.window->resize(1600, 1000);
  desk.window->open_path(written_case(desk.scratch, block_case(kCells, "1 ms")));
  Scene& scene = desk.window->view().scene();
  ASSERT_TRUE(wait_until([&] { return scene.has_data() && !desk.window->busy(); }, kSolver));
  desk.window->view().set_colouring(colouring_by(Quantity::von_mises));
  auto* way = desk.find<QComboBox>("cut_way");
  way->setCurrentText("x");
  const double before = busy_ms();
  emit way->activated(way->currentIndex());
  const double first = busy_ms() - before;
  auto* slider = desk.find<QSlider>("cut_slider");
  double move = 0, picture = 0;
  vtkIdType most = 0;
  for (int i = 1; i <= kMoves; ++i) {
    const double start = busy_ms();
    slider->setValue(slider->maximum() * i / (kMoves + 1));
    const double moved = busy_ms();
    desk.window->view().render_now();
    move += (moved - start) / kMoves;
    picture += (busy_ms() - moved) / kMoves;
    most = std::max(most, scene.num_cut());
  }
  std::printf(
      "%d elements: cut open in %.0f ms; a move of the plane %.1f ms for up to %lld polygons, a picture %.1f "
      "ms\n",
      24 * kCells * kCells * kCells, first, move, static_cast<long long>(most), picture);
  EXPECT_GT(most, kCells * kCells);
}

}  // namespace
}  // namespace breccia::gui::test::cut_test
