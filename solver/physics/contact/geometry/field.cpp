#include "physics/contact/geometry/field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.hpp"

namespace breccia {

namespace {

/// The corners of an element that lie on a side, which its distances are measured from.
unsigned corners_on(const std::array<double, 4>& distances) {
  unsigned corners = 0;
  for (unsigned a = 0; a < 4; ++a) corners |= distances[a] == 0 ? 1U << a : 0U;
  return corners;
}

/// Whether all faces of an element around some of its corners are free: it has come off what lies beside it there.
bool has_come_off(SurfaceSides sides, unsigned corners) {
  for (std::size_t a = 0; a < 4; ++a) {
    const unsigned face = face_set(a);
    if ((face & corners) == corners && !has_face(sides, a) && (sides >> face & 1) == 0) return false;
  }
  return true;
}

void add_side(unsigned set, FieldValues& values) {
  values.sides |= 1 << set;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < num_planes(values.sides); ++k) {
    if (!has_come_off(values.sides, corners_on(values.planes[k]))) values.planes[kept++] = values.planes[k];
  }
  std::fill(values.planes.begin() + static_cast<std::ptrdiff_t>(kept), values.planes.end(), std::array<double, 4>{});
  values.sides = largest_sets(values.sides) | (values.sides & kOwnFaces) | with_planes(kept);
}

bool has_corner(unsigned set, std::size_t a) { return (set >> a & 1U) != 0; }
/// Whether a set has three corners; without std::popcount, which is a call in the baseline instruction set.
bool is_face(unsigned set) { return (kFaceSets >> set & 1U) != 0; }

/// The function of a set that fracture has added.
std::array<double, 4> row_of(const FieldValues& values, const std::array<double, 4>& height, unsigned set) {
  std::array<double, 4> row{};
  for (std::size_t a = 0; a < 4; ++a) {
    if (!has_corner(set, a)) row[a] = is_face(set) ? std::min(values.depth[a], height[a]) : values.depth[a];
  }
  return row;
}

/// Calls f(row) for every function of an element: its faces, the further sides, what fracture has added.
template <class F>
void for_each_function(const FieldValues& values, const std::array<double, 4>& height, F&& f) {
  if (values.sides == 0) f(values.depth);
  for (const std::size_t a : {3, 2, 1, 0}) {
    if (!has_face(values.sides, a)) continue;
    std::array<double, 4> row{};
    row[a] = height[a];
    f(row);
  }
  for (std::size_t k = 0; k < num_planes(values.sides); ++k) f(values.planes[k]);
  for_each_set(values.sides, [&](unsigned set) { f(row_of(values, height, set)); });
}

}  // namespace

std::array<double, 4> heights(const LocalMesh& local, Index slot) {
  const double* m = local.gradient.data() + at(slot / kLanes) * 9 * kLanes + slot % kLanes;
  Vec3 sum = Vec3::Zero();
  std::array<double, 4> height{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 row(m[8 * (3 * c)], m[8 * (3 * c + 1)], m[8 * (3 * c + 2)]);
    height[c + 1] = 1 / row.norm();
    sum += row;
  }
  height[0] = 1 / sum.norm();
  return height;
}

void build_field(const ContactParams& params, const Mesh& mesh, const LocalMesh& local, const SurfaceDepth& surface,
                 ContactState& contact) {
  contact.field.clear();
  contact.changed.clear();
  contact.change_of_contactor.assign(contact.contactors.size(), -1);
  for (const Index slot : contact.contactors)
    contact.field.push_back(field_at_rest(params.field, mesh, local.mesh_element[at(slot)], surface));
}

FieldValues field_at_rest(OverlapField field, const Mesh& mesh, Index element, const SurfaceDepth& surface) {
  FieldValues values;
  if (field != OverlapField::body) return values;
  for (std::size_t a = 0; a < 4; ++a) {
    const Index node = mesh.elements[at(element)][a];
    values.depth[a] = surface.depth[at(node)];
    for (std::size_t i = 0; i < 3; ++i) values.normal[a][i] = surface.normal[at(node)][static_cast<Eigen::Index>(i)];
  }
  values.sides = surface.sides[at(element)];
  values.planes = surface.planes[at(element)];
  return values;
}

void free_corners(const ContactParams& params, Index contactor, unsigned set, ContactState& contact) {
  FieldValues& values = contact.field[at(contactor)];
  if (params.field != OverlapField::body || on_one_face(values.sides, set)) return;
  Index& change = contact.change_of_contactor[at(contactor)];
  if (change < 0) {
    change = static_cast<Index>(contact.changed.size());
    contact.changed.push_back({contactor, values});
  }
  add_side(set, values);
}

void end_changes(ContactState& contact) {
  for (const ChangedField& change : contact.changed) contact.change_of_contactor[at(change.contactor)] = -1;
  contact.changed.clear();
}

OverlapFunction least_of_all_functions(const std::array<double, 4>& height, const FieldValues& values,
                                       const std::array<double, 4>& lambda) {
  OverlapFunction least{std::numeric_limits<double>::infinity(), {}};
  for_each_function(values, height, [&](const std::array<double, 4>& row) {
    const double g = row_value(row, lambda);
    if (g < least.g) least = {g, row};
  });
  return least;
}

OverlapShape overlap_shape(const ContactParams& params, const LocalMesh& local, const ContactState& contact,
                           Index contactor, Instant instant) {
  const Index slot = contact.contactors[at(contactor)], change = contact.change_of_contactor[at(contactor)];
  const double length = contact.body_length[at(local.slot_body[at(slot)])];
  const bool is_before = instant == Instant::step_before && change >= 0;
  const FieldValues& values = is_before ? contact.changed[at(change)].before : contact.field[at(contactor)];
  return overlap_shape(params, contact.height[at(contactor)], values, length);
}

OverlapShape overlap_shape(const ContactParams& params, const std::array<double, 4>& height, const FieldValues& values,
                           double length) {
  OverlapShape shape;
  std::array<double, 4> face{};
  switch (params.field) {
    case OverlapField::body:
      for_each_function(values, height, [&](const std::array<double, 4>& row) { shape.add(row); });
      return shape;
    case OverlapField::tet_potential:
      face.fill(4 * length);
      break;
    case OverlapField::tet_distance:
      face = height;
      break;
  }
  for (std::size_t a = 0; a < 4; ++a) {
    std::array<double, 4> row{};
    row[a] = face[a];
    shape.add(row);
  }
  return shape;
}

}  // namespace breccia
