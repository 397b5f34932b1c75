#include "render/frame_data.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkHDFReader.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <tuple>

namespace breccia::gui {
namespace {

/// Distances over edges of a face: from where on one looks into a crack, and from where on it is a gap.
constexpr double kApart = 0.01, kFarApart = 0.2;

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

/// Unlike GetTuple1 this may be called from several threads.
double value(vtkDataArray* array, vtkIdType i) { return array == nullptr ? 0.0 : array->GetComponent(i, 0); }

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_vtkhdf(const std::string& file) {
  static std::mutex one_reader;  // HDF5 as it comes is not made for several threads
  const std::scoped_lock alone(one_reader);
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
    Face face;
  };
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(4 * rest.GetNumberOfCells()));
  for (vtkIdType c = 0; c < rest.GetNumberOfCells(); ++c) {
    const std::int64_t element = id == nullptr ? c : static_cast<std::int64_t>(value(id, c));
    for (int f = 0; f < 4; ++f) {
      const auto place_of = [&](std::int8_t corner) { return place[static_cast<std::size_t>(4 * c + corner)]; };
      std::array<std::int8_t, 3> order{};
      for (std::size_t i = 0; i < 3; ++i)
        order[i] = static_cast<std::int8_t>(kTetraFaces[static_cast<std::size_t>(f)][i]);
      std::sort(order.begin(), order.end(), [&](std::int8_t a, std::int8_t b) { return place_of(a) < place_of(b); });
      sides.push_back(
          {{static_cast<std::int64_t>(value(body, c)), place_of(order[0]), place_of(order[1]), place_of(order[2])},
           {element, f, order}});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.key, a.face.element, a.face.side) < std::tie(b.key, b.face.element, b.face.side);
  });
  for (std::size_t i = 0; i < sides.size();) {
    if (i + 1 < sides.size() && sides[i + 1].key == sides[i].key) {
      inner_.push_back({sides[i].face, sides[i + 1].face});
      i += 2;
    } else {
      outer_.push_back(sides[i++].face);
    }
  }
}

namespace {

/// Triangles of element faces with the arrays of their elements.
class FaceWriter {
 public:
  FaceWriter(vtkUnstructuredGrid& elements, bool arrays) : elements_(elements), arrays_(arrays) {
    vtkDataArray* id = elements.GetCellData()->GetArray("id");
    for (vtkIdType c = 0; c < elements.GetNumberOfCells(); ++c) {
      const auto own = static_cast<std::size_t>(id == nullptr ? static_cast<double>(c) : value(id, c));
      if (row_.size() <= own) row_.resize(own + 1, -1);
      row_[own] = c;
    }
    if (arrays_) skin_->GetCellData()->CopyAllocate(elements.GetCellData());
  }

  /// Its place in the frame; -1: the frame has no such element.
  [[nodiscard]] vtkIdType row(std::int64_t element) const {
    return element >= 0 && static_cast<std::size_t>(element) < row_.size() ? row_[static_cast<std::size_t>(element)]
                                                                           : -1;
  }

  void add(vtkIdType c, int side) {
    if (c < 0) return;
    std::array<vtkIdType, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] =
          points_->InsertNextPoint(at(elements_, 4 * c + kTetraFaces[static_cast<std::size_t>(side)][i]).data());
    const vtkIdType cell = triangles_->InsertNextCell(3, corners.data());
    if (!arrays_) return;
    skin_->GetCellData()->CopyData(elements_.GetCellData(), c, cell);
    sides_->InsertNextValue(static_cast<signed char>(side));
  }

  [[nodiscard]] vtkSmartPointer<vtkPolyData> take() {
    skin_->SetPoints(points_);
    skin_->SetPolys(triangles_);
    if (!arrays_) return skin_;
    sides_->SetName("side");
    skin_->GetCellData()->AddArray(sides_);
    return skin_;
  }

 private:
  vtkUnstructuredGrid& elements_;
  bool arrays_;
  std::vector<vtkIdType> row_;
  vtkSmartPointer<vtkPolyData> skin_ = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> triangles_;
  vtkNew<vtkSignedCharArray> sides_;
};

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// The cracks that are worth a triangle of their own: where the sides have gone far, their faces are seen instead.
vtkSmartPointer<vtkPolyData> cracks_of(vtkUnstructuredGrid& joints) {
  vtkDataArray* opening = joints.GetCellData()->GetArray("opening");
  auto cracks = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCellArray> triangles;
  cracks->SetPoints(joints.GetPoints());
  cracks->GetCellData()->CopyAllocate(joints.GetCellData());
  for (vtkIdType c = 0; c < joints.GetNumberOfCells(); ++c) {
    const std::array<vtkIdType, 3> corners{3 * c, 3 * c + 1, 3 * c + 2};
    const double edge = std::sqrt(squared_distance(at(joints, corners[0]), at(joints, corners[1])));
    if (value(opening, c) > kFarApart * edge) continue;
    const vtkIdType cell = triangles->InsertNextCell(3, corners.data());
    cracks->GetCellData()->CopyData(joints.GetCellData(), c, cell);
  }
  cracks->SetPolys(triangles);
  return cracks;
}

/// Whether two faces that rest on each other are that no more. @param a, b  rows of their elements
bool are_apart(vtkUnstructuredGrid& elements, vtkIdType a, const std::array<std::int8_t, 3>& in_a, vtkIdType b,
               const std::array<std::int8_t, 3>& in_b) {
  const double edge = squared_distance(at(elements, 4 * a + in_a[0]), at(elements, 4 * a + in_a[1]));
  for (std::size_t i = 0; i < 3; ++i)
    if (squared_distance(at(elements, 4 * a + in_a[i]), at(elements, 4 * b + in_b[i])) > kApart * kApart * edge)
      return true;
  return false;
}

}  // namespace

vtkSmartPointer<vtkPolyData> Skin::draw(vtkUnstructuredGrid& elements) const {
  FaceWriter writer(elements, true);
  for (const Face& face : outer_) writer.add(writer.row(face.element), face.side);
  for (const auto& [a, b] : inner_) {
    const vtkIdType in_a = writer.row(a.element), in_b = writer.row(b.element);
    if (in_a < 0 || in_b < 0 || !are_apart(elements, in_a, a.order, in_b, b.order)) continue;
    writer.add(in_a, a.side);
    writer.add(in_b, b.side);
  }
  return writer.take();
}

vtkSmartPointer<vtkPolyData> Skin::draw_part(vtkUnstructuredGrid& elements, const std::vector<bool>& chosen) const {
  FaceWriter writer(elements, false);
  const auto row = [&](const Face& face) {
    const vtkIdType found = writer.row(face.element);
    return found >= 0 && chosen[static_cast<std::size_t>(found)] ? found : -1;
  };
  for (const Face& face : outer_) writer.add(row(face), face.side);
  for (const auto& [a, b] : inner_) {
    const vtkIdType in_a = row(a), in_b = row(b);
    if (in_a >= 0 && in_b >= 0 && !are_apart(elements, in_a, a.order, in_b, b.order)) continue;
    writer.add(in_a, a.side);
    writer.add(in_b, b.side);
  }
  return writer.take();
}

FrameData load_frame(const std::string& elements_file, const std::string& joints_file, double time,
                     std::shared_ptr<const Skin> faces) {
  FrameData frame;
  frame.time = time;
  const auto elements = read_vtkhdf(elements_file);
  if (elements == nullptr) return frame;
  if (faces == nullptr) faces = std::make_shared<Skin>(*elements);
  frame.faces = faces;
  frame.elements = elements;
  frame.skin = faces->draw(*elements);
  if (joints_file.empty()) return frame;
  if (const auto joints = read_vtkhdf(joints_file); joints != nullptr && joints->GetNumberOfCells() > 0) {
    frame.joints = joints;
    frame.broken = cracks_of(*joints);
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
