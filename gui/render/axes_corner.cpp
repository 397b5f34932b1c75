#include "render/axes_corner.hpp"

#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindow.h>

#include <algorithm>
#include <array>

#include "render/vectors.hpp"

namespace breccia::gui {

AxesCorner::AxesCorner() {
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
  renderer_->AddActor(axes_);
  renderer_->GetActiveCamera()->ParallelProjectionOn();
  axes_->SetCylinderRadius(0.04);
  axes_->SetConeRadius(0.35);
  axes_->SetShaftTypeToCylinder();
  axes_->SetAxisLabels(1);
  // Distinguished by their letters; the colours also with red-green colour blindness.
  constexpr std::array<Vector, 3> kColours{{{0.84, 0.37, 0.0}, {0.0, 0.62, 0.45}, {0.0, 0.45, 0.70}}};
  const std::array<std::array<vtkProperty*, 2>, 3> parts{
      {{axes_->GetXAxisShaftProperty(), axes_->GetXAxisTipProperty()},
       {axes_->GetYAxisShaftProperty(), axes_->GetYAxisTipProperty()},
       {axes_->GetZAxisShaftProperty(), axes_->GetZAxisTipProperty()}}};
  for (std::size_t a = 0; a < 3; ++a)
    for (vtkProperty* part : parts[a]) part->SetColor(kColours[a][0], kColours[a][1], kColours[a][2]);
  axes_->SetXAxisLabelText("x");
  axes_->SetYAxisLabelText("y");
  axes_->SetZAxisLabelText("z");
  set_dark(false);
}

void AxesCorner::set_dark(bool dark) {
  const double ink = dark ? 1 : 0;
  for (vtkCaptionActor2D* label :
       {axes_->GetXAxisCaptionActor2D(), axes_->GetYAxisCaptionActor2D(), axes_->GetZAxisCaptionActor2D()}) {
    label->GetTextActor()->SetTextScaleModeToNone();
    vtkTextProperty* text = label->GetCaptionTextProperty();
    text->SetFontSize(13);
    text->SetColor(ink, ink, ink);
    text->SetBold(1);
    text->SetItalic(0);
    text->SetShadow(0);
  }
}

void AxesCorner::follow(vtkRenderer& model) {
  vtkWindow* window = model.GetVTKWindow();
  const int* size = model.GetSize();
  if (window == nullptr || size[0] <= 0 || size[1] <= 0) return;
  const double side = kSize * window->GetDPI() / 72.0;
  renderer_->SetViewport(0, 0, std::min(1.0, side / size[0]), std::min(1.0, side / size[1]));
  vtkCamera &from = *model.GetActiveCamera(), &to = *renderer_->GetActiveCamera();
  const double* way = from.GetDirectionOfProjection();
  const double* up = from.GetViewUp();
  constexpr double kFar = 10, kReach = 1.45;  // the axes are of length one, and letters stand beyond their ends
  to.SetFocalPoint(0, 0, 0);
  to.SetPosition(-kFar * way[0], -kFar * way[1], -kFar * way[2]);
  to.SetViewUp(up[0], up[1], up[2]);
  to.SetParallelScale(kReach);
  to.SetClippingRange(1, 2 * kFar);
}

}  // namespace breccia::gui
