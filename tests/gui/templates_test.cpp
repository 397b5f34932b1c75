#include <gtest/gtest.h>
#include <vtkActor2D.h>
#include <vtkActor2DCollection.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <QFileInfo>
#include <QImage>
#include <algorithm>
#include <array>
#include <cmath>

#include "gui/desk.hpp"
#include "widgets/start_page.hpp"

namespace breccia::gui::test::templates_test {
namespace {

constexpr int kSolver = 240000;  // ms; the machine may be busy
constexpr qint64 kLargest = 15000;
constexpr QSize kPicture(280, 182);

/// Looks at the model so that it fills a part of the picture.
void fit(vtkRenderer& renderer, bool z_is_up, double width, double height) {
  constexpr double kFilled = 0.96;
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(z_is_up ? 1.0 : 0.9, z_is_up ? -1.4 : 0.9, z_is_up ? 0.6 : 1.4);
  camera->SetViewUp(0, z_is_up ? 0 : 1, z_is_up ? 1 : 0);
  camera->SetWindowCenter(0, 0);
  renderer.ResetCamera();
  std::array<double, 6> box{};
  renderer.ComputeVisiblePropBounds(box.data());
  double most = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::array<double, 3> x{box[corner & 1], box[2 + ((corner >> 1) & 1)], box[4 + (corner >> 2)]};
    renderer.WorldToView(x[0], x[1], x[2]);
    most = std::max({most, std::abs(x[0]) / width, std::abs(x[1]) / height});
  }
  camera->Zoom(kFilled / most);
}

/// What is seen of the mesh alone, on a clear ground.
QImage drawing_of(View3D& view, bool z_is_up) {
  vtkRenderer* renderer = view.scene().renderer();
  vtkActor2DCollection* all = renderer->GetActors2D();
  all->InitTraversal();
  while (vtkActor2D* words = all->GetNextActor2D()) words->VisibilityOff();
  view.scene().show_axes(false);
  renderer->GradientBackgroundOff();
  renderer->SetBackground(1, 0, 1);
  const QSize whole = view.picture().size(), part = kPicture.scaled(whole, Qt::KeepAspectRatio);
  fit(*renderer, z_is_up, static_cast<double>(part.width()) / whole.width(),
      static_cast<double>(part.height()) / whole.height());
  QImage image = view.picture().convertToFormat(QImage::Format_ARGB32);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (image.pixel(x, y) == qRgb(255, 0, 255)) image.setPixel(x, y, 0);
  image = image.copy(QRect(QPoint((image.width() - part.width()) / 2, (image.height() - part.height()) / 2), part));
  return image.convertToFormat(QImage::Format_ARGB32_Premultiplied)
      .scaled(kPicture, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

/// The pictures of gui/resources/templates are made by this test, with BRECCIA_SCREENSHOTS.
TEST(Templates, OpenAndShowTheirMesh) {
  constexpr double kSomething = 0.01;  // of a picture
  const QStringList kZIsUp{"block_drop", "cooling_tower", "hertz_impact"};
  const QString folder = qEnvironmentVariable("BRECCIA_SCREENSHOTS");
  Places places;
  places.meshes = BRECCIA_MESHES;
  for (const Template& t : templates(places)) {
    Desk desk;
    QString error;
    places.projects = desk.scratch.filePath("copies");
    desk.window->open_path(copy_template(t, places, &error));
    ASSERT_EQ(error, QString());
    View3D& view = desk.window->view();
    ASSERT_TRUE(wait_until([&] { return view.scene().has_data() && !desk.window->busy(); }, kSolver))
        << t.case_file.toStdString();
    const QString folder_of_case = QFileInfo(t.case_file).dir().dirName();
    const QImage drawing = drawing_of(view, kZIsUp.contains(folder_of_case));
    qint64 drawn = 0;
    for (int y = 0; y < drawing.height(); ++y)
      for (int x = 0; x < drawing.width(); ++x) drawn += qAlpha(drawing.pixel(x, y)) > 0 ? 1 : 0;
    EXPECT_GT(drawn, kSomething * kPicture.width() * kPicture.height()) << t.case_file.toStdString();
    const QString name = folder_of_case + ".png";
    if (!folder.isEmpty() && QDir(folder).mkpath("templates"))
      drawing.save(QDir(folder).filePath("templates/" + name), nullptr, 0);
  }
}

/// How far apart two colours are in lightness, 1 to 21 (as the guidelines for web content count it).
double contrast(double a, double b) { return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05); }

double lightness(QRgb colour) {
  const auto linear = [](int c) { return std::pow(c / 255.0, 2.2); };
  return 0.2126 * linear(qRed(colour)) + 0.7152 * linear(qGreen(colour)) + 0.0722 * linear(qBlue(colour));
}

TEST(Templates, HaveSmallPicturesThatStandOutOnLightAndOnDark) {
  constexpr double kStandsOut = 1.5, kMost = 0.5;  // of what is drawn
  Places places;
  places.meshes = BRECCIA_MESHES;
  for (const Template& t : templates(places)) {
    const QString name = picture_of_template(t);
    const QImage picture(name);
    ASSERT_FALSE(picture.isNull()) << name.toStdString();
    EXPECT_LE(QFileInfo(name).size(), kLargest) << name.toStdString();
    EXPECT_EQ(picture.size(), kPicture);
    EXPECT_EQ(qAlpha(picture.pixel(0, 0)), 0) << "its ground is clear: " << name.toStdString();
    int drawn = 0, on_light = 0, on_dark = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const QRgb colour = picture.pixel(x, y);
        if (qAlpha(colour) < 255) continue;
        ++drawn;
        on_light += contrast(lightness(colour), lightness(qRgb(255, 255, 255))) > kStandsOut ? 1 : 0;
        on_dark += contrast(lightness(colour), lightness(qRgb(32, 34, 37))) > kStandsOut ? 1 : 0;
      }
    EXPECT_GT(on_light, kMost * drawn) << name.toStdString();
    EXPECT_GT(on_dark, kMost * drawn) << name.toStdString();
  }
}

}  // namespace
}  // namespace breccia::gui::test::templates_test
