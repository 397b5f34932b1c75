#pragma once

#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <optional>

namespace breccia::gui {

/// Triangles of the damaged joints of a frame that are worth one: where the sides have moved far apart, their faces are
/// seen instead.
[[nodiscard]] vtkSmartPointer<vtkPolyData> damaged_joints(vtkUnstructuredGrid& joints);

/// Of those the cracks, which are the joints that have failed, and those that hold with at least so much damage.
/// @param least_damage  0 to 1; none: the cracks alone
[[nodiscard]] vtkSmartPointer<vtkPolyData> cracks_among(vtkPolyData& damaged,
                                                        const std::optional<double>& least_damage);

/// Of a cell or point, the first component; 0 where there is no such array.
[[nodiscard]] double first_component(vtkDataArray* array, vtkIdType i);

}  // namespace breccia::gui
