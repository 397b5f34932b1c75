#include "render/deformation.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>

#include "render/frame_data.hpp"

namespace breccia::gui {

bool is_at_rest(vtkUnstructuredGrid& elements) {
  vtkDataArray* displacement = elements.GetCellData()->GetArray("displacement");
  if (displacement == nullptr) return false;
  for (vtkIdType c = 0; c < displacement->GetNumberOfTuples(); ++c)
    for (int a = 0; a < displacement->GetNumberOfComponents(); ++a)
      if (displacement->GetComponent(c, a) != 0) return false;
  return true;
}

std::shared_ptr<const RestPlaces> RestPlaces::of(vtkUnstructuredGrid* elements) {
  vtkDataArray* id = elements == nullptr ? nullptr : elements->GetCellData()->GetArray("id");
  if (id == nullptr || !is_at_rest(*elements)) return nullptr;
  auto rest = std::make_shared<RestPlaces>();
  for (vtkIdType c = 0; c < elements->GetNumberOfCells(); ++c) {
    const auto own = static_cast<std::size_t>(id->GetComponent(c, 0));
    if (own >= rest->known_.size()) {
      rest->known_.resize(own + 1);
      rest->corners_.resize(4 * (own + 1));
    }
    rest->known_[own] = true;
    for (int i = 0; i < 4; ++i)
      elements->GetPoint(4 * c + i, rest->corners_[4 * own + static_cast<std::size_t>(i)].data());
  }
  const double* box = elements->GetBounds();
  rest->size_ = std::max({box[1] - box[0], box[3] - box[2], box[5] - box[4]});
  return rest;
}

const Vector* RestPlaces::corner(std::int64_t element, int number) const {
  const auto own = static_cast<std::size_t>(element);
  return element >= 0 && own < known_.size() && known_[own] ? &corners_[4 * own + static_cast<std::size_t>(number)]
                                                            : nullptr;
}

double automatic_scale(vtkUnstructuredGrid& elements, const RestPlaces& rest) {
  constexpr double kSeen = 0.05;  // of the size of the model
  vtkDataArray* displacement = elements.GetCellData()->GetArray("displacement");
  double most = 0;
  for (vtkIdType c = 0; displacement != nullptr && c < displacement->GetNumberOfTuples(); ++c)
    most = std::max(most, length({displacement->GetComponent(c, 0), displacement->GetComponent(c, 1),
                                  displacement->GetComponent(c, 2)}));
  if (!(most > 0)) return Deformation::kAutomatic;
  const double wanted = kSeen * rest.size() / most;
  if (!(wanted > 1)) return 1;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  return power * (wanted >= 5 * power ? 5 : wanted >= 2 * power ? 2 : 1);
}

namespace {

/// @param corners  points of a cell; @param rest_of  cell and number of the point to its place at rest
template <class RestOf>
vtkSmartPointer<vtkPoints> enlarged(vtkUnstructuredGrid& cells, int corners, double scale, RestOf&& rest_of) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->DeepCopy(cells.GetPoints());
  for (vtkIdType c = 0; c < cells.GetNumberOfCells(); ++c)
    for (int i = 0; i < corners; ++i) {
      const Vector* rest = rest_of(c, i);
      if (rest == nullptr) continue;
      Vector x{};
      points->GetPoint(corners * c + i, x.data());
      points->SetPoint(corners * c + i, (*rest + scale * (x - *rest)).data());
    }
  return points;
}

std::int64_t id_of(vtkUnstructuredGrid& cells, vtkIdType c) {
  vtkDataArray* id = cells.GetCellData()->GetArray("id");
  return id == nullptr ? -1 : static_cast<std::int64_t>(id->GetComponent(c, 0));
}

}  // namespace

vtkSmartPointer<vtkPoints> enlarged_elements(vtkUnstructuredGrid& elements, const RestPlaces& rest, double scale) {
  return enlarged(elements, 4, scale, [&](vtkIdType c, int i) { return rest.corner(id_of(elements, c), i); });
}

vtkSmartPointer<vtkPoints> enlarged_joints(vtkUnstructuredGrid& joints, const RestPlaces& rest, double scale) {
  return enlarged(joints, 3, scale, [&](vtkIdType c, int i) -> const Vector* {
    const std::int64_t id = id_of(joints, c);  // 4 * element + face
    if (id < 0) return nullptr;
    return rest.corner(id / 4, kTetraFaces[static_cast<std::size_t>(id % 4)][static_cast<std::size_t>(i)]);
  });
}

}  // namespace breccia::gui
