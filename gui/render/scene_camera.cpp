#include <vtkCamera.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/scene.hpp"
#include "render/vectors.hpp"

// View of the model.

namespace breccia::gui {
namespace {

/// To the right and towards the eye, of a model that stands upright.
struct Sides {
  Vector right, front;
};

Sides sides_of(const Vector& up) {
  const Vector right = std::abs(up[0]) > 0.5 ? Vector{0, 0, 1} : Vector{1, 0, 0};
  return {right, cross(right, up)};
}

/// Direction from the model to the eye.
Vector place_of(LookFrom where, const Vector& up) {
  if (where == LookFrom::corner) {
    const auto& [right, front] = sides_of(up);
    return 0.9 * right + 0.9 * up + 1.4 * front;
  }
  const int number = static_cast<int>(where) - static_cast<int>(LookFrom::plus_x);
  Vector along{};
  along[static_cast<std::size_t>(number / 2)] = number % 2 == 0 ? 1 : -1;
  return along;
}

}  // namespace

void Scene::look_from(LookFrom where) {
  // Of the view, whose middle is 0: the middle of the model.
  constexpr double kMiddle = -0.18;
  const Vector place = place_of(where, up_);
  const double along_up = dot(unit(place), up_);
  // Seen from above or below, what is in front of the model is drawn below it or above it.
  const Vector up = std::abs(along_up) < 0.99 ? up_ : (along_up > 0 ? -1 : 1) * sides_of(up_).front;
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(place.data());
  camera->SetViewUp(up.data());
  camera->SetWindowCenter(-kMiddle, 0);
  renderer_->ResetCamera();
  fit_beside(kMiddle);
  renderer_->ResetCameraClippingRange();
}

Vector Scene::look() const {
  Vector way{};
  renderer_->GetActiveCamera()->GetDirectionOfProjection(way.data());
  return way;
}

/// Zooms until the model is as large as it may be beside legend, axes and caption. @param middle  of it in the view
void Scene::fit_beside(double middle) {
  constexpr double kRight = 0.62, kLeft = -0.96, kHigh = 0.92, kFoot = 64;  // the last in pixels
  const int height = std::max(1, renderer_->GetSize()[1]);
  const double scale = renderer_->GetVTKWindow() == nullptr ? 1 : renderer_->GetVTKWindow()->GetDPI() / 72.0;
  const double low = std::min(-1 + 2 * kFoot * scale / height, -0.5);
  std::array<double, 6> box{};
  renderer_->ComputeVisiblePropBounds(box.data());
  if (box[0] > box[1]) return;  // nothing is seen
  double zoom = 1e3;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double x = box[corner & 1], y = box[2 + ((corner >> 1) & 1)], z = box[4 + (corner >> 2)];
    renderer_->WorldToView(x, y, z);
    x -= middle;
    if (std::abs(x) > 0) zoom = std::min(zoom, (x > 0 ? kRight - middle : kLeft - middle) / x);
    if (std::abs(y) > 0) zoom = std::min(zoom, (y > 0 ? kHigh : low) / y);
  }
  renderer_->GetActiveCamera()->Zoom(zoom);
}

}  // namespace breccia::gui
