#include "render/scale_bar.hpp"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkMath.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>
#include <vtkWindow.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render/prefixed_unit.hpp"

namespace breccia::gui {
namespace {

/// Pixels of a screen of 72 dots an inch.
constexpr double kLongest = 110, kTick = 5, kGap = 6;

/// The largest of 1, 2 and 5 times a power of ten that is not above.
double round_below(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0})
    if (step * power <= most) return step * power;
  return power;
}

double metres_of_a_pixel(vtkRenderer& renderer) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  const double half = camera.GetParallelProjection() != 0
                          ? camera.GetParallelScale()
                          : camera.GetDistance() * std::tan(vtkMath::RadiansFromDegrees(0.5 * camera.GetViewAngle()));
  return 2 * half / renderer.GetSize()[1];
}

}  // namespace

vtkStandardNewMacro(ScaleBar);

ScaleBar::ScaleBar() {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(line_);
  bar_->SetMapper(mapper);
  bar_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  bar_->GetProperty()->SetLineWidth(2);
  text_->SetTextScaleModeToNone();
  text_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  text_->GetTextProperty()->SetFontSize(12);
  text_->GetTextProperty()->SetVerticalJustificationToCentered();
}

void ScaleBar::set_dark(bool dark) {
  const double ink = dark ? 1 : 0;
  plate_.set_grey(plate_grey(dark));
  bar_->GetProperty()->SetColor(ink, ink, ink);
  text_->GetTextProperty()->SetColor(ink, ink, ink);
}

void ScaleBar::measure(vtkRenderer& renderer, double scale) {
  const double metre = metres_of_a_pixel(renderer), size = round_below(kLongest * scale * metre);
  const PrefixedUnit unit = prefixed_unit(size, "m");
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.4g %s", size / unit.size, unit.name.c_str());
  words_ = text.data();
  pixels_ = size / metre;
}

void ScaleBar::place(vtkRenderer& renderer) {
  const double scale = renderer.GetVTKWindow()->GetDPI() / 72.0;
  measure(renderer, scale);
  text_->SetInput(words_.c_str());
  std::array<double, 2> size{};
  text_->GetSize(&renderer, size.data());
  const double tick = kTick * scale, gap = kGap * scale, left = left_ * scale + gap, right = left + pixels_;
  const double height = std::max(size[1], 2 * tick) + gap, bottom = bottom_ * scale;
  const double middle = std::floor(bottom + 0.5 * height);
  plate_.place(left - gap, bottom, right + size[0] + 2 * gap, bottom + height);
  text_->SetPosition(right + gap, middle);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  const std::array<std::array<double, 2>, 6> corners{{{left, middle - tick},
                                                      {left, middle + tick},
                                                      {left, middle},
                                                      {right, middle},
                                                      {right, middle - tick},
                                                      {right, middle + tick}}};
  for (const auto& corner : corners) points->InsertNextPoint(corner[0], corner[1], 0);
  for (vtkIdType first = 0; first < 6; first += 2) {
    const std::array<vtkIdType, 2> ends{first, first + 1};
    lines->InsertNextCell(2, ends.data());
  }
  line_->SetPoints(points);
  line_->SetLines(lines);
}

int ScaleBar::RenderOverlay(vtkViewport* viewport) {
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  if (renderer == nullptr || renderer->GetSize()[1] <= 0) return 0;
  place(*renderer);
  return plate_.actor()->RenderOverlay(viewport) + bar_->RenderOverlay(viewport) +
         text_->RenderOpaqueGeometry(viewport) + text_->RenderOverlay(viewport);
}

void ScaleBar::ReleaseGraphicsResources(vtkWindow* window) {
  plate_.actor()->ReleaseGraphicsResources(window);
  bar_->ReleaseGraphicsResources(window);
  text_->ReleaseGraphicsResources(window);
  vtkActor2D::ReleaseGraphicsResources(window);
}

}  // namespace breccia::gui
