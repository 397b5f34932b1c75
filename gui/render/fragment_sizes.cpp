#include "render/fragment_sizes.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

#include "render/vectors.hpp"

namespace breccia::gui {
namespace {

double volume_of(vtkUnstructuredGrid& elements, vtkIdType c) {
  std::array<Vector, 4> x;
  for (int i = 0; i < 4; ++i) elements.GetPoint(4 * c + i, x[static_cast<std::size_t>(i)].data());
  return std::abs(dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]))) / 6;
}

}  // namespace

bool add_fragment_sizes(vtkUnstructuredGrid& elements) {
  vtkDataArray* fragment = elements.GetCellData()->GetArray("fragment");
  vtkDataArray* body = elements.GetCellData()->GetArray("body");
  if (fragment == nullptr || body == nullptr) return false;
  const auto number = [](vtkDataArray& of, vtkIdType c) { return static_cast<std::int64_t>(of.GetComponent(c, 0)); };
  std::unordered_map<std::int64_t, double> volume;
  std::unordered_set<std::int64_t> bodies;
  for (vtkIdType c = 0; c < elements.GetNumberOfCells(); ++c) {
    volume[number(*fragment, c)] += volume_of(elements, c);
    bodies.insert(number(*body, c));
  }
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName(kFragmentSize);
  sizes->SetNumberOfValues(elements.GetNumberOfCells());
  for (vtkIdType c = 0; c < elements.GetNumberOfCells(); ++c)
    sizes->SetValue(c, std::cbrt(6 / M_PI * volume[number(*fragment, c)]));
  elements.GetCellData()->AddArray(sizes);
  return volume.size() > bodies.size();
}

}  // namespace breccia::gui
