#pragma once

#include <vtkAxesActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace breccia::gui {

/// The axes x, y and z as the model is seen, in the lower left corner of the view: a picture of its own over the other.
class AxesCorner {
 public:
  /// Of a side of the corner, in pixels of a screen of 72 dots an inch.
  static constexpr double kSize = 76;

  AxesCorner();
  /// For the layer above that of the model.
  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  void set_dark(bool dark);
  void show(bool on) { renderer_->SetDraw(on); }
  /// Turns them as the model is turned. To be called when a picture of it begins.
  void follow(vtkRenderer& model);

 private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkAxesActor> axes_;
};

}  // namespace breccia::gui
