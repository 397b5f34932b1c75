#include <vtkCamera.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/scene.hpp"

// How the model is looked at.

namespace breccia::gui {

void Scene::reset_camera() {
  // Of the view, whose middle is 0: the middle of the model, and how far it may reach beside legend and caption.
  constexpr double kMiddle = -0.18, kRight = 0.62, kLeft = -0.96, kHigh = 0.92, kLow = -0.82;
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(0.9, 0.9, 1.4);
  camera->SetViewUp(0, 1, 0);
  camera->SetWindowCenter(-kMiddle, 0);
  renderer_->ResetCamera();
  std::array<double, 6> box{};
  renderer_->ComputeVisiblePropBounds(box.data());
  if (box[0] > box[1]) return;  // nothing is seen
  double zoom = 1e3;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double x = box[corner & 1], y = box[2 + ((corner >> 1) & 1)], z = box[4 + (corner >> 2)];
    renderer_->WorldToView(x, y, z);
    x -= kMiddle;
    if (std::abs(x) > 0) zoom = std::min(zoom, (x > 0 ? kRight - kMiddle : kLeft - kMiddle) / x);
    if (std::abs(y) > 0) zoom = std::min(zoom, (y > 0 ? kHigh : kLow) / y);
  }
  camera->Zoom(zoom);
  renderer_->ResetCameraClippingRange();
}

}  // namespace breccia::gui
