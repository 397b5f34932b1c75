#include "render/body_centres.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <array>
#include <cmath>

namespace breccia::gui {

BodyCentres centres_of(vtkUnstructuredGrid* elements, const std::vector<double>& densities) {
  struct Sum {
    Vector moment{};
    double mass = 0;
  };
  BodyCentres centres;
  if (elements == nullptr) return centres;
  vtkDataArray* material = elements->GetCellData()->GetArray("material");
  vtkDataArray* body = elements->GetCellData()->GetArray("body");
  if (material == nullptr || body == nullptr) return centres;
  std::map<int, Sum> sums;
  for (vtkIdType c = 0; c < elements->GetNumberOfCells(); ++c) {
    const auto group = static_cast<std::size_t>(material->GetComponent(c, 0));
    const double density = group < densities.size() && densities[group] > 0 ? densities[group] : 1;
    std::array<Vector, 4> x{};  // every element has its own points
    for (std::size_t i = 0; i < 4; ++i) elements->GetPoint(4 * c + static_cast<vtkIdType>(i), x[i].data());
    const double mass =
        density * std::abs(dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])));  // six times, in both sums
    Sum& sum = sums[static_cast<int>(body->GetComponent(c, 0))];
    sum.mass += mass;
    sum.moment = sum.moment + (0.25 * mass) * (x[0] + x[1] + x[2] + x[3]);
  }
  for (const auto& [number, sum] : sums)
    if (sum.mass > 0) centres[number] = (1 / sum.mass) * sum.moment;
  return centres;
}

}  // namespace breccia::gui
