#include "render/frame_data.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkHDFReader.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace breccia::gui {
namespace {

/// Corners of the face opposite to corner i, seen from outside in the same sense.
constexpr std::array<std::array<int, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

using Point = std::array<double, 3>;

Point at(vtkUnstructuredGrid& grid, vtkIdType point) {
  Point p{};
  grid.GetPoint(point, p.data());
  return p;
}

/// A number for every place at which corners rest; places closer than a millionth of the model are one.
std::vector<std::int64_t> places_of(vtkUnstructuredGrid& grid, vtkDataArray* displacement) {
  const vtkIdType cells = grid.GetNumberOfCells();
  std::array<double, 6> box{};
  grid.GetBounds(box.data());
  const double size = std::max({box[1] - box[0], box[3] - box[2], box[5] - box[4], 1e-300});
  const double grain = 1e-6 * size;
  using Key = std::array<std::int64_t, 3>;
  std::vector<std::pair<Key, std::int64_t>> keys(static_cast<std::size_t>(4 * cells));
  for (vtkIdType c = 0; c < cells; ++c) {
    Point moved{};
    if (displacement != nullptr) displacement->GetTuple(c, moved.data());
    for (vtkIdType i = 0; i < 4; ++i) {
      const Point p = at(grid, 4 * c + i);
      Key key{};
      for (std::size_t a = 0; a < 3; ++a) key[a] = std::llround((p[a] - moved[a]) / grain);
      keys[static_cast<std::size_t>(4 * c + i)] = {key, 4 * c + i};
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int64_t> place(keys.size());
  std::int64_t number = -1;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k == 0 || keys[k].first != keys[k - 1].first) ++number;
    place[static_cast<std::size_t>(keys[k].second)] = number;
  }
  return place;
}

double value(vtkDataArray* array, vtkIdType i) { return array == nullptr ? 0.0 : array->GetTuple1(i); }

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_vtkhdf(const std::string& file) {
  vtkNew<vtkHDFReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0) return nullptr;
  reader->SetFileName(file.c_str());
  reader->Update();
  return vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
}

Skin::Skin(vtkUnstructuredGrid& rest) {
  vtkDataArray* body = rest.GetCellData()->GetArray("body");
  vtkDataArray* id = rest.GetCellData()->GetArray("id");
  const std::vector<std::int64_t> place = places_of(rest, rest.GetCellData()->GetArray("displacement"));
  struct Side {
    std::array<std::int64_t, 4> key;  // body and the three places in order
    vtkIdType cell;
    int side;
  };
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(4 * rest.GetNumberOfCells()));
  for (vtkIdType c = 0; c < rest.GetNumberOfCells(); ++c) {
    for (int f = 0; f < 4; ++f) {
      std::array<std::int64_t, 4> key{static_cast<std::int64_t>(value(body, c)), 0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i)
        key[i + 1] = place[static_cast<std::size_t>(4 * c + kFaces[static_cast<std::size_t>(f)][i])];
      std::sort(key.begin() + 1, key.end());
      sides.push_back({key, c, f});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.key, a.cell, a.side) < std::tie(b.key, b.cell, b.side);
  });
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    if (end == i + 1) {
      const vtkIdType c = sides[i].cell;
      faces_.push_back({id == nullptr ? c : static_cast<std::int64_t>(id->GetTuple1(c)), sides[i].side});
    }
    i = end;
  }
}

vtkSmartPointer<vtkPolyData> Skin::draw(vtkUnstructuredGrid& elements) const {
  vtkDataArray* id = elements.GetCellData()->GetArray("id");
  std::vector<vtkIdType> row;
  for (vtkIdType c = 0; c < elements.GetNumberOfCells(); ++c) {
    const auto own = static_cast<std::size_t>(id == nullptr ? static_cast<double>(c) : id->GetTuple1(c));
    if (row.size() <= own) row.resize(own + 1, -1);
    row[own] = c;
  }
  auto skin = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  skin->GetCellData()->CopyAllocate(elements.GetCellData(), static_cast<vtkIdType>(faces_.size()));
  for (const Face& face : faces_) {
    if (face.element < 0 || static_cast<std::size_t>(face.element) >= row.size()) continue;
    const vtkIdType c = row[static_cast<std::size_t>(face.element)];
    if (c < 0) continue;
    std::array<vtkIdType, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = points->InsertNextPoint(at(elements, 4 * c + kFaces[static_cast<std::size_t>(face.side)][i]).data());
    const vtkIdType cell = triangles->InsertNextCell(3, corners.data());
    skin->GetCellData()->CopyData(elements.GetCellData(), c, cell);
  }
  skin->SetPoints(points);
  skin->SetPolys(triangles);
  return skin;
}

FrameData load_frame(const std::string& elements_file, const std::string& joints_file, double time,
                     std::shared_ptr<const Skin> faces) {
  FrameData frame;
  frame.time = time;
  const auto elements = read_vtkhdf(elements_file);
  if (elements == nullptr) return frame;
  if (faces == nullptr) faces = std::make_shared<Skin>(*elements);
  frame.faces = faces;
  frame.skin = faces->draw(*elements);
  if (joints_file.empty()) return frame;
  if (const auto joints = read_vtkhdf(joints_file); joints != nullptr && joints->GetNumberOfCells() > 0) {
    frame.broken = vtkSmartPointer<vtkPolyData>::New();
    frame.broken->SetPoints(joints->GetPoints());
    frame.broken->SetPolys(joints->GetCells());
    frame.broken->GetCellData()->ShallowCopy(joints->GetCellData());
  }
  return frame;
}

void set_ranks(vtkPolyData& skin, const std::vector<int>& owner) {
  vtkDataArray* id = skin.GetCellData()->GetArray("id");
  if (id == nullptr) return;
  vtkNew<vtkIntArray> ranks;
  ranks->SetName("rank");
  for (vtkIdType c = 0; c < skin.GetNumberOfCells(); ++c) {
    const auto element = static_cast<std::size_t>(id->GetTuple1(c));
    ranks->InsertNextValue(element < owner.size() ? owner[element] : 0);
  }
  skin.GetCellData()->RemoveArray("rank");
  skin.GetCellData()->AddArray(ranks);
}

}  // namespace breccia::gui
