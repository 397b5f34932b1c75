#pragma once

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <array>

namespace breccia::gui {

/// Of what lies behind words in the view, so that they are read over any model.
inline constexpr double kPlateOpacity = 0.75;

/// Colour of the plates, 0 to 1, on light and on dark ground.
inline double plate_grey(bool dark) { return dark ? 0.15 : 1.0; }

/// A rectangle behind words, in pixels of the viewport.
class Plate {
 public:
  Plate() {
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(quad_);
    actor_->SetMapper(mapper);
    actor_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
    actor_->GetProperty()->SetOpacity(kPlateOpacity);
  }

  void set_grey(double grey) { actor_->GetProperty()->SetColor(grey, grey, grey); }

  void place(double left, double bottom, double right, double top) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    std::array<vtkIdType, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k)
      corners[k] = points->InsertNextPoint(k == 1 || k == 2 ? right : left, k >= 2 ? top : bottom, 0);
    cells->InsertNextCell(4, corners.data());
    quad_->SetPoints(points);
    quad_->SetPolys(cells);
  }

  [[nodiscard]] vtkActor2D* actor() { return actor_; }

 private:
  vtkNew<vtkPolyData> quad_;
  vtkNew<vtkActor2D> actor_;
};

}  // namespace breccia::gui
