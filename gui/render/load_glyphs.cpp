#include "render/load_glyphs.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "render/vectors.hpp"

namespace breccia::gui {
namespace {

constexpr std::size_t kMostGlyphs = 24;
/// Shares of the diagonal of the model, and of the length of a glyph.
constexpr double kLength = 0.07, kShaft = 0.035, kHead = 0.1, kHeadLength = 0.35, kSupport = 0.5, kSupportWidth = 0.45;
constexpr int kSides = 10;

/// A face where a glyph may stand.
struct Seat {
  Vector centre{}, normal{};
};

Seat seat_of(vtkPointSet& model, const std::array<vtkIdType, 3>& corners) {
  std::array<Vector, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) model.GetPoint(corners[i], x[i].data());
  return {(1.0 / 3) * (x[0] + x[1] + x[2]), unit(cross(x[1] - x[0], x[2] - x[0]))};
}

/// 4 * id of the element + side, of a surface group, ascending; none: it is a volume.
std::vector<std::int64_t> faces_of(const SurfaceGroups& surfaces, const std::string& group) {
  const auto surface =
      static_cast<std::size_t>(std::find(surfaces.names.begin(), surfaces.names.end(), group) - surfaces.names.begin());
  if (surface >= surfaces.faces.size()) return {};
  std::vector<std::int64_t> faces = surfaces.faces[surface];
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// The faces of a group that are seen.
std::vector<Seat> seats_of(vtkPolyData& skin, const std::vector<std::string>& volumes, const SurfaceGroups& surfaces,
                           const std::string& group) {
  vtkDataArray* material = skin.GetCellData()->GetArray("material");
  vtkDataArray* id = skin.GetCellData()->GetArray("id");
  vtkDataArray* side = skin.GetCellData()->GetArray("side");
  std::vector<Seat> seats;
  if (material == nullptr || id == nullptr || side == nullptr) return seats;
  const std::vector<std::int64_t> faces = faces_of(surfaces, group);
  const auto volume = static_cast<double>(std::find(volumes.begin(), volumes.end(), group) - volumes.begin());
  for (vtkIdType c = 0; c < skin.GetNumberOfCells(); ++c) {
    const auto face =
        4 * static_cast<std::int64_t>(id->GetComponent(c, 0)) + static_cast<std::int64_t>(side->GetComponent(c, 0));
    if (!(std::abs(material->GetComponent(c, 0) - volume) < 0.5) &&
        !std::binary_search(faces.begin(), faces.end(), face))
      continue;
    seats.push_back(seat_of(skin, {3 * c, 3 * c + 1, 3 * c + 2}));
  }
  return seats;
}

/// Rows of elements by their ids: mostly the id itself, but frames of several ranks have them in other orders.
class RowOfElement {
 public:
  explicit RowOfElement(vtkDataArray& id) : id_(id) {}

  /// @return  -1: there is no such element
  [[nodiscard]] vtkIdType operator()(std::int64_t element) {
    if (element >= 0 && element < id_.GetNumberOfTuples() && is_at(element, element)) return element;
    if (rows_.empty())
      for (vtkIdType row = 0; row < id_.GetNumberOfTuples(); ++row)
        rows_.emplace(static_cast<std::int64_t>(id_.GetComponent(row, 0)), row);
    const auto found = rows_.find(element);
    return found == rows_.end() ? -1 : found->second;
  }

 private:
  [[nodiscard]] bool is_at(vtkIdType row, std::int64_t element) const {
    return static_cast<std::int64_t>(id_.GetComponent(row, 0)) == element;
  }
  vtkDataArray& id_;
  std::unordered_map<std::int64_t, vtkIdType> rows_;
};

/// The faces of a surface group within the model.
std::vector<Seat> inner_seats_of(vtkUnstructuredGrid& elements, const SurfaceGroups& surfaces,
                                 const std::string& group) {
  std::vector<Seat> seats;
  vtkDataArray* id = elements.GetCellData()->GetArray("id");
  if (id == nullptr) return seats;
  RowOfElement row_of(*id);
  for (const std::int64_t face : faces_of(surfaces, group)) {
    const vtkIdType row = row_of(face / 4);
    if (row < 0) continue;
    std::array<vtkIdType, 3> corners{};  // every element has its own points
    for (std::size_t i = 0; i < 3; ++i) corners[i] = 4 * row + kTetraFaces[static_cast<std::size_t>(face % 4)][i];
    seats.push_back(seat_of(elements, corners));
  }
  return seats;
}

/// Some of them, each as far as can be from those taken before. Of very many every so-manieth is looked at.
std::vector<Seat> spread(std::vector<Seat> seats) {
  constexpr std::size_t kEnough = 4000;
  if (const std::size_t each = seats.size() / kEnough; each > 1) {
    for (std::size_t i = 0; i < kEnough; ++i) seats[i] = seats[i * each];
    seats.resize(kEnough);
  }
  std::vector<Seat> taken;
  if (seats.empty()) return taken;
  std::vector<double> distance(seats.size(), std::numeric_limits<double>::max());
  std::size_t next = 0;
  while (taken.size() < kMostGlyphs && distance[next] > 0) {
    taken.push_back(seats[next]);
    const Vector centre = seats[next].centre;
    for (std::size_t i = 0; i < seats.size(); ++i) {
      const Vector way = seats[i].centre - centre;
      distance[i] = std::min(distance[i], dot(way, way));
    }
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return taken;
}

/// Cones and rods of triangles.
class GlyphMesh {
 public:
  /// A frustum between two places. @param from, to  radii
  void add(const Vector& begin, const Vector& end, double from, double to) {
    const Vector along = unit(end - begin);
    const Vector across = unit(cross(along, std::abs(along[0]) < 0.8 ? Vector{1, 0, 0} : Vector{0, 1, 0}));
    const Vector third = cross(along, across);
    std::array<std::array<vtkIdType, kSides>, 2> ring{};
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2 * M_PI * k / kSides;
      const Vector out = std::cos(angle) * across + std::sin(angle) * third;
      ring[0][static_cast<std::size_t>(k)] = points_->InsertNextPoint((begin + from * out).data());
      ring[1][static_cast<std::size_t>(k)] = points_->InsertNextPoint((end + to * out).data());
    }
    const std::array<vtkIdType, 2> middle{points_->InsertNextPoint(begin.data()), points_->InsertNextPoint(end.data())};
    for (std::size_t k = 0; k < kSides; ++k) {
      const std::size_t n = (k + 1) % kSides;
      triangle(ring[0][k], ring[0][n], ring[1][n]);
      triangle(ring[0][k], ring[1][n], ring[1][k]);
      triangle(middle[0], ring[0][n], ring[0][k]);
      triangle(middle[1], ring[1][k], ring[1][n]);
    }
  }

  void add_arrow(const Vector& begin, const Vector& end, int heads) {
    const Vector way = end - begin;
    const double length = std::sqrt(dot(way, way));
    add(begin, end - kHeadLength * way, kShaft * length, kShaft * length);
    for (int head = 0; head < heads; ++head) {
      const Vector tip = end - (0.8 * kHeadLength * head) * way;
      add(tip - kHeadLength * way, tip, kHead * length, 0);
    }
  }

  [[nodiscard]] vtkSmartPointer<vtkPolyData> take() {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(points_);
    mesh->SetPolys(triangles_);
    return mesh;
  }

 private:
  void triangle(vtkIdType a, vtkIdType b, vtkIdType c) {
    const std::array<vtkIdType, 3> corners{a, b, c};
    triangles_->InsertNextCell(3, corners.data());
  }

  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> triangles_;
};

/// Directions that are spread evenly over the sphere, the same ones in every picture.
Vector any_direction(std::size_t number) {
  constexpr double kGoldenAngle = 2.399963229728653;
  const double z = 1 - 2 * (static_cast<double>(number * 7 % kMostGlyphs) + 0.5) / kMostGlyphs,
               r = std::sqrt(1 - z * z);
  const double angle = kGoldenAngle * static_cast<double>(number);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Draws the glyph of one seat. Returns the end that is away from the model.
Vector add_glyph(GlyphMesh& mesh, const Load& load, const Seat& seat, std::size_t number, double length) {
  if (load.shape == LoadShape::support) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (!load.axes[a]) continue;
      Vector out{};
      out[a] = seat.normal[a] < 0 ? -kSupport * length : kSupport * length;
      mesh.add(seat.centre + out, seat.centre, 0.5 * kSupportWidth * kSupport * length, 0);
    }
    return seat.centre + kSupport * length * seat.normal;
  }
  const bool pressure = load.shape == LoadShape::pressure;
  const Vector along = pressure                          ? (load.direction[0] < 0 ? 1 : -1) * seat.normal
                       : load.shape == LoadShape::random ? any_direction(number)
                                                         : unit(load.direction);
  // An arrow is outside: onto the face, or away from it.
  const bool onto = dot(along, seat.normal) < 0;
  const Vector begin = onto ? seat.centre - length * along : seat.centre, end = begin + length * along;
  mesh.add_arrow(begin, end, load.shape == LoadShape::double_arrow || load.shape == LoadShape::random ? 2 : 1);
  return onto ? begin : end;
}

bool is_seen(const Load& load) {
  if (load.shape == LoadShape::support) return load.axes[0] || load.axes[1] || load.axes[2];
  return load.shape == LoadShape::random || dot(load.direction, load.direction) > 0;
}

}  // namespace

LoadGlyphs draw_load(vtkPolyData& skin, vtkUnstructuredGrid* elements, const std::vector<std::string>& volumes,
                     const SurfaceGroups& surfaces, const Load& load) {
  LoadGlyphs glyphs;
  GlyphMesh mesh;
  const double diagonal = skin.GetLength(), length = kLength * diagonal;
  if (!is_seen(load)) return glyphs;
  if (load.group.empty()) {  // one arrow beside the model, larger than others
    Vector centre{};
    skin.GetCenter(centre.data());
    std::array<double, 6> box{};
    skin.GetBounds(box.data());
    const Vector along = unit(load.direction);
    double reach = 0;  // of the box that way
    for (std::size_t a = 0; a < 3; ++a) reach += 0.5 * std::abs(along[a]) * (box[2 * a + 1] - box[2 * a]);
    const Vector end = centre - (reach + 0.2 * length) * along;
    glyphs.places = {end - 1.5 * length * along};
    mesh.add_arrow(glyphs.places[0], end, 1);
  } else {
    std::vector<Seat> seats = seats_of(skin, volumes, surfaces, load.group);
    glyphs.inner = seats.empty() && elements != nullptr;
    if (glyphs.inner) seats = inner_seats_of(*elements, surfaces, load.group);
    for (const Seat& seat : spread(std::move(seats)))
      glyphs.places.push_back(add_glyph(mesh, load, seat, glyphs.places.size(), length));
  }
  glyphs.mesh = mesh.take();
  return glyphs;
}

}  // namespace breccia::gui
