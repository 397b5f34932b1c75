#include "render/frame_data.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
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

#include "render/cracks.hpp"
#include "render/fragment_sizes.hpp"

namespace breccia::gui {
namespace {

/// Distance over an edge of a face from which a crack is drawn open.
constexpr double kApart = 0.01;

using Point = std::array<double, 3>;

Point at(vtkUnstructuredGrid& grid, vtkIdType point) {
  Point p{};
  grid.GetPoint(point, p.data());
  return p;
}

/// Arrays of elements that nothing here is drawn or counted by.
constexpr std::array<const char*, 3> kNotDrawn{"neighbour", "mass", "cost"};

/// A place to begin at in a table of a power of two.
std::size_t hashed(std::uint64_t key, std::size_t mask) {
  key *= 0x9E3779B97F4A7C15ULL;  // spreads neighbours (2^64 over the golden section)
  return static_cast<std::size_t>(key ^ (key >> 32U)) & mask;
}

/// Numbers keys in the order in which they come; a key that has come before has its number. The table grows with the
/// number of different keys, of which there are few: lookups hit the cache.
class Numbers {
 public:
  std::int64_t of(std::uint64_t key) {
    std::size_t i = place_of(key);
    if (slots_[i].number >= 0) return slots_[i].number;
    if (2 * static_cast<std::size_t>(count_) >= slots_.size()) {
      std::vector<Slot> old(2 * slots_.size());
      old.swap(slots_);
      for (const Slot& slot : old)
        if (slot.number >= 0) slots_[place_of(slot.key)] = slot;
      i = place_of(key);
    }
    slots_[i] = {key, count_};
    return count_++;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::int64_t number = -1;
  };
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
    std::size_t i = hashed(key, slots_.size() - 1);
    while (slots_[i].number >= 0 && slots_[i].key != key) i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1024);
  std::int64_t count_ = 0;
};

/// Where all corners rest.
std::vector<Point> corners_at_rest(vtkUnstructuredGrid& grid, vtkDataArray* displacement) {
  std::vector<Point> rest(static_cast<std::size_t>(4 * grid.GetNumberOfCells()));
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    Point moved{};
    if (displacement != nullptr)
      for (int a = 0; a < 3; ++a) moved[static_cast<std::size_t>(a)] = displacement->GetComponent(c, a);
    for (vtkIdType i = 4 * c; i < 4 * c + 4; ++i) {
      const Point p = at(grid, i);
      for (std::size_t a = 0; a < 3; ++a) rest[static_cast<std::size_t>(i)][a] = p[a] - moved[a];
    }
  }
  return rest;
}

/// A number for every place at which corners rest; places closer than a millionth of the model are one.
std::vector<std::int64_t> places_of(vtkUnstructuredGrid& grid, vtkDataArray* displacement) {
  constexpr double kGrains = 1e6;
  constexpr unsigned kBits = 21;  // more than that many
  const std::vector<Point> rest = corners_at_rest(grid, displacement);
  constexpr double kFar = std::numeric_limits<double>::max();
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Point& p : rest)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  const double grain = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300}) / kGrains;
  Numbers numbers;
  std::vector<std::int64_t> place;
  place.reserve(rest.size());
  for (const Point& p : rest) {
    std::uint64_t key = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double grains = (p[a] - low[a]) / grain;
      key = key << kBits | (grains > 0 ? static_cast<std::uint64_t>(std::llround(std::min(grains, kGrains))) : 0);
    }
    place.push_back(numbers.of(key));
  }
  return place;
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_vtkhdf(const std::string& file) {
  static std::mutex one_reader;  // HDF5 as it comes is not made for several threads
  const std::scoped_lock alone(one_reader);
  vtkNew<vtkHDFReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0) return nullptr;
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  for (const char* name : kNotDrawn) reader->GetCellDataArraySelection()->DisableArray(name);
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
  inner_.reserve(sides.capacity() / 2);
  std::vector<bool> is_inner(sides.capacity());
  // Sides that wait for their other one, in a chain for each place: the first side, and the next one of each.
  std::vector<std::int64_t> first(place.size(), -1), next(sides.capacity(), -1);
  const auto find_other = [&](std::size_t own) {
    const auto& key = sides[own].key;
    std::int64_t* link = &first[static_cast<std::size_t>(key[1])];
    for (; *link >= 0; link = &next[static_cast<std::size_t>(*link)]) {
      const auto other = static_cast<std::size_t>(*link);
      if (sides[other].key != key) continue;
      inner_.push_back({sides[other].face, sides[own].face});
      is_inner[other] = is_inner[own] = true;
      *link = next[other];
      return;
    }
    *link = static_cast<std::int64_t>(own);
  };
  for (vtkIdType c = 0; c < rest.GetNumberOfCells(); ++c) {
    const std::int64_t element = id == nullptr ? c : static_cast<std::int64_t>(first_component(id, c));
    for (int f = 0; f < 4; ++f) {
      const auto place_of = [&](std::int8_t corner) { return place[static_cast<std::size_t>(4 * c + corner)]; };
      std::array<std::int8_t, 3> order{};
      for (std::size_t i = 0; i < 3; ++i)
        order[i] = static_cast<std::int8_t>(kTetraFaces[static_cast<std::size_t>(f)][i]);
      std::sort(order.begin(), order.end(), [&](std::int8_t a, std::int8_t b) { return place_of(a) < place_of(b); });
      sides.push_back({{static_cast<std::int64_t>(first_component(body, c)), place_of(order[0]), place_of(order[1]),
                        place_of(order[2])},
                       {element, f, order}});
      find_other(sides.size() - 1);
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!is_inner[i]) outer_.push_back(sides[i].face);
}

namespace {

/// Triangles of element faces with the arrays of their elements.
class FaceWriter {
 public:
  FaceWriter(vtkUnstructuredGrid& elements, bool arrays) : elements_(elements), arrays_(arrays) {
    vtkDataArray* id = elements.GetCellData()->GetArray("id");
    for (vtkIdType c = 0; c < elements.GetNumberOfCells(); ++c) {
      const auto own = static_cast<std::size_t>(id == nullptr ? static_cast<double>(c) : first_component(id, c));
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
  if (is_at_rest(elements)) return writer.take();
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

namespace {

/// Moves what is drawn away from its place at rest.
void enlarge(FrameData& frame) {
  Deformation& how = frame.deformation;
  if (how.scale == 1 || how.lacks_rest) return;
  if (how.rest == nullptr) how.rest = RestPlaces::of(read_vtkhdf(how.rest_file));
  how.lacks_rest = how.rest == nullptr;
  if (how.lacks_rest) return;
  if (how.scale == Deformation::kAutomatic) how.scale = automatic_scale(*frame.elements, *how.rest);
  if (how.scale == 1 || how.scale == Deformation::kAutomatic) return;
  frame.drawn = vtkSmartPointer<vtkUnstructuredGrid>::New();
  frame.drawn->ShallowCopy(frame.elements);
  frame.drawn->SetPoints(enlarged_elements(*frame.elements, *how.rest, how.scale));
  if (frame.joints == nullptr) return;
  frame.joints->SetPoints(enlarged_joints(*frame.joints, *how.rest, how.scale));
  frame.damaged->SetPoints(frame.joints->GetPoints());
}

}  // namespace

FrameData load_frame(const std::string& elements_file, const std::string& joints_file, double time,
                     std::shared_ptr<const Skin> faces, Deformation deformation) {
  FrameData frame;
  frame.time = time;
  const auto elements = read_vtkhdf(elements_file);
  if (elements == nullptr) return frame;
  if (faces == nullptr) faces = std::make_shared<Skin>(*elements);
  frame.faces = faces;
  frame.is_broken = add_fragment_sizes(*elements);
  frame.elements = frame.drawn = elements;
  if (const auto joints = joints_file.empty() ? nullptr : read_vtkhdf(joints_file);
      joints != nullptr && joints->GetNumberOfCells() > 0) {
    frame.joints = joints;
    frame.damaged = damaged_joints(*joints);
  }
  frame.deformation = std::move(deformation);
  enlarge(frame);
  frame.skin = faces->draw(*frame.drawn);
  return frame;
}

void set_ranks(FrameData& frame, const std::vector<int>& owner) {
  const auto set = [&](vtkDataSet& cells) {
    vtkDataArray* id = cells.GetCellData()->GetArray("id");
    if (id == nullptr) return;
    vtkNew<vtkIntArray> ranks;
    ranks->SetName("rank");
    for (vtkIdType c = 0; c < cells.GetNumberOfCells(); ++c) {
      const auto element = static_cast<std::size_t>(id->GetComponent(c, 0));
      ranks->InsertNextValue(element < owner.size() ? owner[element] : 0);
    }
    cells.GetCellData()->RemoveArray("rank");
    cells.GetCellData()->AddArray(ranks);
  };
  set(*frame.skin);
  // Others may be reading the elements as they are.
  auto elements = vtkSmartPointer<vtkUnstructuredGrid>::New();
  elements->ShallowCopy(frame.elements);
  set(*elements);
  frame.elements = frame.drawn = elements;
}

}  // namespace breccia::gui
