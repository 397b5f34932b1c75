#include "render/cracks.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>

#include <array>

#include "render/vectors.hpp"

namespace breccia::gui {
namespace {

/// Opening over an edge of the face from where on a crack is a gap.
constexpr double kFarApart = 0.2;

/// The triangles that are kept, with their arrays. @param keeps  of the number of a cell
template <class Keeps>
vtkSmartPointer<vtkPolyData> triangles_of(vtkPointSet& joints, const Keeps& keeps) {
  auto kept = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCellArray> triangles;
  kept->SetPoints(joints.GetPoints());
  kept->GetCellData()->CopyAllocate(joints.GetCellData());
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < joints.GetNumberOfCells(); ++c) {
    if (!keeps(c)) continue;
    joints.GetCellPoints(c, corners);
    kept->GetCellData()->CopyData(joints.GetCellData(), c, triangles->InsertNextCell(corners));
  }
  kept->SetPolys(triangles);
  return kept;
}

}  // namespace

double first_component(vtkDataArray* array, vtkIdType i) { return array == nullptr ? 0.0 : array->GetComponent(i, 0); }

vtkSmartPointer<vtkPolyData> damaged_joints(vtkUnstructuredGrid& joints) {
  vtkDataArray* opening = joints.GetCellData()->GetArray("opening");
  return triangles_of(joints, [&](vtkIdType c) {
    Vector a{}, b{};  // each joint has its own three points
    joints.GetPoint(3 * c, a.data());
    joints.GetPoint(3 * c + 1, b.data());
    return first_component(opening, c) <= kFarApart * length(a - b);
  });
}

vtkSmartPointer<vtkPolyData> cracks_among(vtkPolyData& damaged, const std::optional<double>& least_damage) {
  vtkDataArray* broken = damaged.GetCellData()->GetArray("broken");
  vtkDataArray* damage = damaged.GetCellData()->GetArray("damage");
  return triangles_of(damaged, [&](vtkIdType c) {
    return first_component(broken, c) > 0 || (least_damage && first_component(damage, c) >= *least_damage);
  });
}

}  // namespace breccia::gui
