#include "render/cut.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace breccia::gui {
namespace {

/// Share of the reach of an element within which a corner lies in the plane: otherwise rounding makes slivers.
constexpr double kInPlane = 1e-9;

using Distances = std::array<double, 4>;

/// The polygon in which a plane cuts an element, in the order of its corners; empty: it touches an edge or a corner
/// alone. @param d  distances of the corners from the plane; those that stay have d < 0
std::vector<Vector> polygon_of(const std::array<Vector, 4>& x, const Distances& d) {
  std::vector<std::size_t> stay, go;
  for (std::size_t i = 0; i < 4; ++i) (d[i] < 0 ? stay : go).push_back(i);
  std::vector<Vector> polygon;
  for (std::size_t s = 0; s < stay.size(); ++s) {
    // Of two and two, the edges of the second are walked along backwards: the four points go round.
    const bool backwards = stay.size() == 2 && s == 1;
    for (std::size_t g = 0; g < go.size(); ++g) {
      const std::size_t a = go[backwards ? go.size() - 1 - g : g], b = stay[s];
      const Vector p = x[a] + d[a] / (d[a] - d[b]) * (x[b] - x[a]);
      if (polygon.empty() || p != polygon.back()) polygon.push_back(p);  // corners in the plane come twice
    }
  }
  if (polygon.size() > 3 && polygon.front() == polygon.back()) polygon.pop_back();
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

}  // namespace

Cut::Cut(vtkSmartPointer<vtkUnstructuredGrid> elements, const Vector& normal)
    : elements_(std::move(elements)), normal_(normal), reach_(static_cast<std::size_t>(elements_->GetNumberOfCells())) {
  for (std::size_t c = 0; c < reach_.size(); ++c) {
    const std::array<Vector, 4> x = corners_of(static_cast<vtkIdType>(c));
    const auto [low, high] =
        std::minmax({dot(normal_, x[0]), dot(normal_, x[1]), dot(normal_, x[2]), dot(normal_, x[3])});
    reach_[c] = {low, high};
  }
}

std::array<Vector, 4> Cut::corners_of(vtkIdType element) const {
  std::array<Vector, 4> x{};
  for (int i = 0; i < 4; ++i) elements_->GetPoint(4 * element + i, x[static_cast<std::size_t>(i)].data());
  return x;
}

vtkSmartPointer<vtkPolyData> Cut::faces(double offset) const {
  auto faces = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> rows, cells;
  for (std::size_t c = 0; c < reach_.size(); ++c) {
    const double tiny = kInPlane * (reach_[c][1] - reach_[c][0]);
    if (reach_[c][0] >= offset - tiny || reach_[c][1] < offset - tiny) continue;
    const auto row = static_cast<vtkIdType>(c);
    const std::array<Vector, 4> x = corners_of(row);
    Distances d{};
    for (std::size_t i = 0; i < 4; ++i) {
      d[i] = dot(normal_, x[i]) - offset;
      if (std::abs(d[i]) <= tiny) d[i] = 0;
    }
    const std::vector<Vector> polygon = polygon_of(x, d);
    if (polygon.empty()) continue;
    const vtkIdType cell = polygons->InsertNextCell(static_cast<int>(polygon.size()));
    for (const Vector& p : polygon) polygons->InsertCellPoint(points->InsertNextPoint(p.data()));
    rows->InsertNextId(row);
    cells->InsertNextId(cell);
  }
  faces->GetCellData()->CopyAllocate(elements_->GetCellData(), rows->GetNumberOfIds());
  faces->GetCellData()->CopyData(elements_->GetCellData(), rows, cells);
  faces->SetPoints(points);
  faces->SetPolys(polygons);
  return faces;
}

}  // namespace breccia::gui
