#include "render/load_glyphs.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "render/body_centres.hpp"
#include "render/glyph_mesh.hpp"

namespace breccia::gui {
namespace {

constexpr std::size_t kMostGlyphs = 24;
/// Shares of the diagonal of the model, and of the length of a glyph.
constexpr double kLength = 0.07, kSupport = 0.5, kSupportWidth = 0.45, kFoot = 0.16, kRod = 0.05, kSeatsApart = 0.4;

/// A face where a glyph may stand.
struct Seat {
  Vector centre{}, normal{};
  int body = -1;
};

Seat seat_of(vtkPointSet& model, const std::array<vtkIdType, 3>& corners) {
  std::array<Vector, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) model.GetPoint(corners[i], x[i].data());
  return {(1.0 / 3) * (x[0] + x[1] + x[2]), unit(cross(x[1] - x[0], x[2] - x[0])), -1};
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

/// Its number as in the array "material"; that of no group where it is none.
int index_of(const std::vector<std::string>& volumes, const std::string& group) {
  return static_cast<int>(std::find(volumes.begin(), volumes.end(), group) - volumes.begin());
}

/// The nodes of a curve or point, each with the direction away from the middle of the model.
std::vector<Seat> nodes_of(vtkPolyData& skin, const SurfaceGroups& surfaces, const std::string& group) {
  const auto curve = static_cast<std::size_t>(std::find(surfaces.curves.begin(), surfaces.curves.end(), group) -
                                              surfaces.curves.begin());
  std::vector<Seat> seats;
  if (curve >= surfaces.places.size()) return seats;
  Vector middle{};
  skin.GetCenter(middle.data());
  for (const Vector& place : surfaces.places[curve]) seats.push_back({place, unit(place - middle), -1});
  return seats;
}

/// The faces of a group that are seen.
std::vector<Seat> seats_of(vtkPolyData& skin, const std::vector<std::string>& volumes, const SurfaceGroups& surfaces,
                           const std::string& group) {
  vtkDataArray* material = skin.GetCellData()->GetArray("material");
  vtkDataArray* id = skin.GetCellData()->GetArray("id");
  vtkDataArray* side = skin.GetCellData()->GetArray("side");
  vtkDataArray* body = skin.GetCellData()->GetArray("body");
  std::vector<Seat> seats;
  if (material == nullptr || id == nullptr || side == nullptr) return seats;
  const std::vector<std::int64_t> faces = faces_of(surfaces, group);
  const double volume = index_of(volumes, group);
  for (vtkIdType c = 0; c < skin.GetNumberOfCells(); ++c) {
    const auto face =
        4 * static_cast<std::int64_t>(id->GetComponent(c, 0)) + static_cast<std::int64_t>(side->GetComponent(c, 0));
    if (!(std::abs(material->GetComponent(c, 0) - volume) < 0.5) &&
        !std::binary_search(faces.begin(), faces.end(), face))
      continue;
    seats.push_back(seat_of(skin, {3 * c, 3 * c + 1, 3 * c + 2}));
    if (body != nullptr) seats.back().body = static_cast<int>(body->GetComponent(c, 0));
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

/// Some of them, each as far as possible from those chosen before. Of very many only every n-th is considered.
/// @param apart  no two are nearer to each other: arrows that overlap are a chain of heads
std::vector<Seat> spread(std::vector<Seat> seats, double apart) {
  constexpr std::size_t kEnough = 4000;
  if (const std::size_t each = seats.size() / kEnough; each > 1) {
    for (std::size_t i = 0; i < kEnough; ++i) seats[i] = seats[i * each];
    seats.resize(kEnough);
  }
  std::vector<Seat> taken;
  if (seats.empty()) return taken;
  std::vector<double> distance(seats.size(), std::numeric_limits<double>::max());
  std::size_t next = 0;
  while (taken.size() < kMostGlyphs && distance[next] > apart * apart) {
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
  if (load.shape == LoadShape::absorbing) {
    for (int wave = 1; wave <= 3; ++wave)
      mesh.add_disc(seat.centre + (0.25 * wave * length) * seat.normal, seat.normal, (0.4 - 0.1 * wave) * length,
                    kRod * length);
    return seat.centre + length * seat.normal;
  }
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
  return load.shape == LoadShape::random || load.shape == LoadShape::absorbing ||
         dot(load.direction, load.direction) > 0;
}

/// v_i = rate_i (x_i - c_i) at a face, c the centre of mass of the body.
Vector stretching_at(const Seat& seat, const Vector& rate, const BodyCentres& centres) {
  const auto centre = centres.find(seat.body);
  if (centre == centres.end()) return {};
  const Vector arm = seat.centre - centre->second;
  return {rate[0] * arm[0], rate[1] * arm[1], rate[2] * arm[2]};
}

/// Arrows whose lengths compare as the velocities do, none where it is next to nothing.
void add_stretching(GlyphMesh& mesh, LoadGlyphs& glyphs, const Load& load, const std::vector<Seat>& seats,
                    const BodyCentres& centres, double longest) {
  constexpr double kLeast = 0.1;  // of the longest
  double fastest = 0;
  for (const Seat& seat : seats) fastest = std::max(fastest, length(stretching_at(seat, load.direction, centres)));
  for (const Seat& seat : seats) {
    const Vector velocity = stretching_at(seat, load.direction, centres);
    if (!(length(velocity) > kLeast * fastest)) continue;
    const Vector way = (longest / fastest) * velocity;
    const bool onto = dot(way, seat.normal) < 0;  // an arrow is outside
    const Vector begin = onto ? seat.centre - way : seat.centre, end = begin + way;
    mesh.add_arrow(begin, end, 1);
    mesh.add_disc(begin, unit(way), kFoot * longest, kRod * longest);
    glyphs.places.push_back(onto ? begin : end);
  }
}

/// An arc about each body, wide enough to be outside of it, and its axis, which sticks out at both ends.
void add_spins(GlyphMesh& mesh, LoadGlyphs& glyphs, const Load& load, const std::vector<Seat>& seats,
               const BodyCentres& centres, double size) {
  struct Reach {
    double across = 0, low = 0, high = 0;
  };
  const Vector axis = unit(load.direction);
  std::map<int, Reach> reaches;
  for (const Seat& seat : seats) {
    const auto centre = centres.find(seat.body);
    if (centre == centres.end()) continue;
    const Vector arm = seat.centre - centre->second;
    const double along = dot(arm, axis);
    Reach& reach = reaches[seat.body];
    reach.across = std::max(reach.across, length(arm - along * axis));
    reach.low = std::min(reach.low, along);
    reach.high = std::max(reach.high, along);
  }
  std::vector<Seat> middles;
  for (const auto& [body, reach] : reaches) middles.push_back({centres.at(body), axis, body});
  constexpr double kWidth = 0.06, kRoom = 0.3, kCorners = 1.15;  // reaches are those of the middles of faces
  const double width = kWidth * size;
  for (const Seat& middle : spread(std::move(middles), 0)) {
    const Reach& reach = reaches.at(middle.body);
    const Vector foot = middle.centre + (reach.low - 0.5 * size) * axis;
    mesh.add(foot, middle.centre + (reach.high + 0.5 * size) * axis, width, width);
    glyphs.places.push_back(mesh.add_turn(middle.centre, axis, kCorners * reach.across + kRoom * size, width));
  }
}

/// kg/m3, (volumes); 0: not known.
std::vector<double> densities_of(const Load& load, const std::vector<std::string>& volumes) {
  std::vector<double> densities;
  for (const std::string& volume : volumes) {
    const auto known = load.densities.find(volume);
    densities.push_back(known == load.densities.end() ? 0 : known->second);
  }
  return densities;
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
    if (seats.empty()) seats = nodes_of(skin, surfaces, load.group);
    glyphs.inner = seats.empty() && elements != nullptr;
    if (glyphs.inner) seats = inner_seats_of(*elements, surfaces, load.group);
    const BodyCentres centres = load.shape == LoadShape::stretch || load.shape == LoadShape::spin
                                    ? centres_of(elements, densities_of(load, volumes))
                                    : BodyCentres();
    if (load.shape == LoadShape::spin) {
      add_spins(mesh, glyphs, load, seats, centres, length);
    } else if (seats = spread(std::move(seats), kSeatsApart * length); load.shape == LoadShape::stretch) {
      add_stretching(mesh, glyphs, load, seats, centres, length);
    } else {
      for (const Seat& seat : seats) glyphs.places.push_back(add_glyph(mesh, load, seat, glyphs.places.size(), length));
    }
  }
  glyphs.mesh = mesh.take();
  return glyphs;
}

}  // namespace breccia::gui
