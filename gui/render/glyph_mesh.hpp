#pragma once

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "render/vectors.hpp"

namespace breccia::gui {

/// Solids of triangles that glyphs are put together from.
class GlyphMesh {
 public:
  /// A frustum between two places. @param from, to  radii
  void add(const Vector& begin, const Vector& end, double from, double to);
  /// A shaft with one or two heads at its end, all of a width that goes with the length.
  void add_arrow(const Vector& begin, const Vector& end, int heads);
  /// A flat disc across an axis. @param along  of length one
  void add_disc(const Vector& centre, const Vector& along, double radius, double thickness);
  /// Three quarters of a circle about an axis with a head that points as a body turns about it, by the right hand.
  /// @param axis   of length one;  @param width  radius of the rod
  /// @return  where it begins
  Vector add_turn(const Vector& centre, const Vector& axis, double radius, double width);

  [[nodiscard]] vtkSmartPointer<vtkPolyData> take();

 private:
  void triangle(vtkIdType a, vtkIdType b, vtkIdType c);

  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> triangles_;
};

}  // namespace breccia::gui
