#include <vtkCellData.h>

#include <algorithm>
#include <limits>

#include "render/scene.hpp"

// The plane that cuts the model open, and parts of ranks that are moved apart.

namespace breccia::gui {

void Scene::set_cut(const std::optional<CutPlane>& plane) {
  const bool changes_range = plane.has_value() != cut_plane_.has_value();
  cut_plane_ = plane;
  for (vtkPolyDataMapper* mapper :
       {skin_mapper_.Get(), broken_mapper_.Get(), marked_mapper_.Get(), chosen_mapper_.Get()}) {
    mapper->RemoveAllClippingPlanes();
    if (plane) mapper->AddClippingPlane(clip_);
  }
  if (plane) {  // VTK keeps what its normal points to
    clip_->SetNormal(-plane->normal[0], -plane->normal[1], -plane->normal[2]);
    const Vector origin = plane->offset * plane->normal;
    clip_->SetOrigin(origin.data());
  }
  if (!has_data()) return;
  changes_range ? colour() : draw_cut();
}

/// In the colours that the skin has.
void Scene::draw_cut() {
  const bool any = cut_plane_.has_value() && frame_.drawn != nullptr;
  cut_->SetVisibility(any);
  cut_mapper_->SetInputData(nullptr);
  if (!any) return;
  if (!through_ || through_->normal() != cut_plane_->normal) through_.emplace(exploded_elements(), cut_plane_->normal);
  const auto faces = through_->faces(cut_plane_->offset);
  if (shown_) faces->GetCellData()->AddArray(shown_(*faces->GetCellData()));
  cut_mapper_->SetInputData(faces);
}

vtkIdType Scene::num_cut() const {
  return cut_->GetVisibility() != 0 ? cut_mapper_->GetInput()->GetNumberOfPolys() : 0;
}

vtkCellData* Scene::cut_values() const { return num_cut() > 0 ? cut_mapper_->GetInput()->GetCellData() : nullptr; }

std::array<double, 2> Scene::extent(const Vector& normal) const {
  if (!has_data() || num_faces() == 0) return {0, 0};
  constexpr double kFar = std::numeric_limits<double>::max();
  std::array<double, 2> reach{kFar, -kFar};
  vtkPolyData& skin = *skin_mapper_->GetInput();
  for (vtkIdType i = 0; i < skin.GetNumberOfPoints(); ++i) {
    Vector p{};
    skin.GetPoint(i, p.data());
    reach[0] = std::min(reach[0], dot(normal, p));
    reach[1] = std::max(reach[1], dot(normal, p));
  }
  return reach;
}

void Scene::set_explode(double share) {
  explode_ = share;
  through_.reset();
  if (has_data()) colour();
  draw_loads();
}

/// How far the part of each rank is moved.
std::map<int, Vector> Scene::explode_ways() const {
  vtkDataArray* rank = frame_.skin->GetCellData()->GetArray("rank");
  if (explode_ <= 0 || rank == nullptr) return {};
  struct Sum {
    Vector x{};
    double n = 0;
  };
  std::map<int, Sum> parts;
  Sum all;
  for (vtkIdType c = 0; c < frame_.skin->GetNumberOfCells(); ++c) {
    Vector p{};
    frame_.skin->GetPoint(3 * c, p.data());  // each triangle has its own three points
    for (Sum* sum : {&parts[static_cast<int>(rank->GetComponent(c, 0))], &all}) {
      sum->x = sum->x + p;
      sum->n += 1;
    }
  }
  std::map<int, Vector> ways;
  for (const auto& [number, part] : parts) ways[number] = explode_ * ((1 / part.n) * part.x - (1 / all.n) * all.x);
  return ways;
}

namespace {

/// @param corners  points of each cell, which are its own
void move_apart(vtkPointSet& cells, vtkIdType corners, const std::map<int, Vector>& ways) {
  vtkDataArray* rank = cells.GetCellData()->GetArray("rank");
  if (ways.empty() || rank == nullptr) return;
  vtkNew<vtkPoints> moved;
  moved->DeepCopy(cells.GetPoints());
  for (vtkIdType c = 0; c < cells.GetNumberOfCells(); ++c) {
    const auto way = ways.find(static_cast<int>(rank->GetComponent(c, 0)));
    if (way == ways.end()) continue;  // a rank whose elements all lie within the model
    for (vtkIdType i = corners * c; i < corners * (c + 1); ++i) {
      Vector p{};
      cells.GetPoint(i, p.data());
      moved->SetPoint(i, (p + way->second).data());
    }
  }
  cells.SetPoints(moved);
}

}  // namespace

vtkSmartPointer<vtkPolyData> Scene::exploded() const {
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->ShallowCopy(frame_.skin);
  move_apart(*out, 3, explode_ways());
  return out;
}

vtkSmartPointer<vtkUnstructuredGrid> Scene::exploded_elements() const {
  const std::map<int, Vector> ways = explode_ways();
  if (ways.empty()) return frame_.drawn;
  auto out = vtkSmartPointer<vtkUnstructuredGrid>::New();
  out->ShallowCopy(frame_.drawn);
  move_apart(*out, 4, ways);
  return out;
}

}  // namespace breccia::gui
