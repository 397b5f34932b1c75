#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <string>

#include "render/plate.hpp"

namespace breccia::gui {

/// A bar of a round length with its unit, at the lower edge of the view. The view is in perspective: the length is that
/// at the focal depth of the camera, the middle of the model.
class ScaleBar : public vtkActor2D {
 public:
  static ScaleBar* New();
  vtkTypeMacro(ScaleBar, vtkActor2D)

      /// Of its lower left corner, in pixels of a screen of 72 dots an inch.
      void set_place(double left, double bottom) {
    left_ = left, bottom_ = bottom;
  }
  void set_dark(bool dark);
  /// "5 mm", of the last picture.
  [[nodiscard]] const std::string& words() const { return words_; }
  [[nodiscard]] double pixels() const { return pixels_; }

  int RenderOverlay(vtkViewport* viewport) override;
  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ScaleBar(const ScaleBar&) = delete;
  ScaleBar& operator=(const ScaleBar&) = delete;

 protected:
  ScaleBar();
  ~ScaleBar() override = default;

 private:
  void measure(vtkRenderer& renderer, double scale);
  void place(vtkRenderer& renderer);

  Plate plate_;
  vtkNew<vtkPolyData> line_;
  vtkNew<vtkActor2D> bar_;
  vtkNew<vtkTextActor> text_;
  std::string words_;
  double left_ = 0, bottom_ = 0, pixels_ = 0;
};

}  // namespace breccia::gui
