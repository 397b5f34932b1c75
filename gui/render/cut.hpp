#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <vector>

#include "render/vectors.hpp"

namespace breccia::gui {

/// A plane that cuts the model open: what lies on the side that its normal points to is hidden.
struct CutPlane {
  Vector normal{1, 0, 0};  ///< of length one
  double offset = 0;       ///< m, of the plane from the origin along the normal
};

/// What planes of one direction lay bare of elements. From where to where each of them reaches is found once, so that a
/// plane moves through all of them in a moment.
class Cut {
 public:
  /// @param elements  with four points each, in their order. O(elements)
  Cut(vtkSmartPointer<vtkUnstructuredGrid> elements, const Vector& normal);
  [[nodiscard]] const Vector& normal() const { return normal_; }
  /// Of each element that the plane goes through the polygon in which it does, with the arrays of the element. Faces of
  /// elements that lie in the plane are those of the elements that stay.
  [[nodiscard]] vtkSmartPointer<vtkPolyData> faces(double offset) const;

 private:
  [[nodiscard]] std::array<Vector, 4> corners_of(vtkIdType element) const;

  vtkSmartPointer<vtkUnstructuredGrid> elements_;
  Vector normal_;
  std::vector<std::array<double, 2>> reach_;  ///< of each element along the normal, m
};

}  // namespace breccia::gui
