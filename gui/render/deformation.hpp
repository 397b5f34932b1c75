#pragma once

#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/vectors.hpp"

namespace breccia::gui {

/// Whether nothing has moved.
[[nodiscard]] bool is_at_rest(vtkUnstructuredGrid& elements);

/// Where the corners of all elements of a run rest, by id.
class RestPlaces {
 public:
  /// nullptr: it is no frame at rest. O(elements)
  [[nodiscard]] static std::shared_ptr<const RestPlaces> of(vtkUnstructuredGrid* elements);
  /// nullptr: there is no such element.
  [[nodiscard]] const Vector* corner(std::int64_t element, int number) const;
  /// Largest edge of the box around the model, m.
  [[nodiscard]] double size() const { return size_; }

 private:
  std::vector<Vector> corners_;  ///< 4 id + corner
  std::vector<bool> known_;
  double size_ = 0;
};

/// How displacements are drawn.
struct Deformation {
  static constexpr double kAutomatic = 0;
  double scale = 1;       ///< 1: true; kAutomatic: so that the largest is seen
  std::string rest_file;  ///< elements at rest, which displacements are counted from; read where rest is not known
  std::shared_ptr<const RestPlaces> rest;
  bool lacks_rest = false;  ///< that file is none, or no frame at rest: places are true
};

/// So that the largest displacement is seen on the model: 1, 2 or 5 times a power of ten, and never less than 1.
/// kAutomatic: nothing has moved yet.
[[nodiscard]] double automatic_scale(vtkUnstructuredGrid& elements, const RestPlaces& rest);

/// X + scale (x - X) of every corner, X at rest; where that is not known the corner stays. O(elements)
[[nodiscard]] vtkSmartPointer<vtkPoints> enlarged_elements(vtkUnstructuredGrid& elements, const RestPlaces& rest,
                                                           double scale);
/// The same of joints, which lie on the faces given by their ids.
[[nodiscard]] vtkSmartPointer<vtkPoints> enlarged_joints(vtkUnstructuredGrid& joints, const RestPlaces& rest,
                                                         double scale);

}  // namespace breccia::gui
