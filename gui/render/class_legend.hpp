#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <string>
#include <vector>

#include "render/plate.hpp"

namespace breccia::gui {

/// A legend at the right of the view: a box of its colour and a name for each class, below a title. It measures its
/// texts in every picture: vtkScalarBarActor puts annotations where texts of another size would have fitted when the
/// first picture has something translucent in it.
class ClassLegend : public vtkActor2D {
 public:
  static ClassLegend* New();
  vtkTypeMacro(ClassLegend, vtkActor2D)

      struct Class {
    std::array<double, 3> colour;
    std::string name;
  };
  void set_classes(const std::string& title, const std::vector<Class>& classes);
  [[nodiscard]] const std::vector<Class>& classes() const { return classes_; }
  /// Where the upper edge is, or the lower one, as a share of the view.
  void set_top(double share) { top_ = share, hangs_ = true; }
  void set_bottom(double share) { top_ = share, hangs_ = false; }
  /// Grey of the words and of the plate behind them, 0 to 1.
  void set_colours(double ink, double ground);

  int RenderOverlay(vtkViewport* viewport) override;
  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /// Rectangles of the last picture, x, y, width, height in pixels from the lower left corner: a box and a name for
  /// each class.
  struct Row {
    std::array<int, 4> box{}, name{};
  };
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

  ClassLegend(const ClassLegend&) = delete;
  ClassLegend& operator=(const ClassLegend&) = delete;

 protected:
  ClassLegend();
  ~ClassLegend() override = default;

 private:
  void place(vtkViewport& viewport);

  Plate plate_;
  vtkNew<vtkTextActor> title_;
  vtkNew<vtkPolyData> boxes_;
  vtkNew<vtkActor2D> box_actor_;
  std::vector<vtkSmartPointer<vtkTextActor>> names_;
  std::vector<Class> classes_;
  std::vector<Row> rows_;
  std::array<double, 3> ink_{};
  double top_ = 1;
  bool hangs_ = true;
};

}  // namespace breccia::gui
