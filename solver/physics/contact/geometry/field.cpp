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

/// Whether all faces of an element around some of its corners are free and count in full: it has come off what lies
/// beside it there.
bool has_come_off(const FieldValues& values, unsigned corners, const ComingSets& coming) {
  for (std::size_t a = 0; a < 4; ++a) {
    const unsigned face = face_set(a);
    if ((face & corners) != corners || has_face(values.sides, a)) continue;
    if ((values.sides >> face & 1) == 0 || coming[face] > 0) return false;
  }
  return true;
}

/// The field of an element whose ramp has ended.
void end_ramp(FieldValues& values) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < num_planes(values.sides); ++k) {
    if (!has_come_off(values, corners_on(values.planes[k]), {})) values.planes[kept++] = values.planes[k];
  }
  std::fill(values.planes.begin() + static_cast<std::ptrdiff_t>(kept), values.planes.end(), std::array<double, 4>{});
  values.sides = largest_sets(values.sides) | (values.sides & kOwnFaces) | with_planes(kept);
}

void drop_finished_ramps(ContactState& contact) {
  std::size_t kept = 0;
  for (const FieldRamp& ramp : contact.ramps) {
    const bool done = std::all_of(ramp.remaining.begin(), ramp.remaining.end(), [](Index n) { return n == 0; });
    contact.ramp_of_contactor[at(ramp.contactor)] = done ? -1 : static_cast<Index>(kept);
    if (done) {
      end_ramp(contact.field[at(ramp.contactor)]);
    } else {
      contact.ramps[kept++] = FieldRamp(ramp);
    }
  }
  contact.ramps.resize(kept);
}

FieldRamp& ramp_of(Index contactor, ContactState& contact) {
  Index& place = contact.ramp_of_contactor[at(contactor)];
  if (place < 0) {
    place = static_cast<Index>(contact.ramps.size());
    contact.ramps.push_back({contactor, {}, {}});
  }
  return contact.ramps[at(place)];
}

bool has_corner(unsigned set, std::size_t a) { return (set >> a & 1U) != 0; }
/// Whether a set has three corners; without std::popcount, which is a call in the baseline instruction set.
bool is_face(unsigned set) { return (kFaceSets >> set & 1U) != 0; }

/// The function of a set that fracture has added. @param weight  of the set, 0 to 1
std::array<double, 4> row_of(const FieldValues& values, const std::array<double, 4>& height, unsigned set,
                             double weight) {
  std::array<double, 4> row = values.depth;
  for (std::size_t a = 0; a < 4; ++a) {
    if (has_corner(set, a)) {
      row[a] *= 1 - weight;
    } else if (is_face(set)) {
      row[a] = std::min(row[a], height[a]);
    }
  }
  return row;
}

/// Calls f(row) for every function of an element: its faces, the further sides, what fracture has added.
/// @param coming  of a ramp, or null: none
template <class F>
void for_each_function(const FieldValues& values, const std::array<double, 4>& height, int ramp_steps,
                       const ComingSets* coming, F&& f) {
  bool whole = false;  // one that counts in full
  for (const std::size_t a : {3, 2, 1, 0}) {
    if (!has_face(values.sides, a)) continue;
    whole = true;
    std::array<double, 4> row{};
    row[a] = height[a];
    f(row);
  }
  for (std::size_t k = 0; k < num_planes(values.sides); ++k) {
    if (coming != nullptr && has_come_off(values, corners_on(values.planes[k]), *coming)) continue;
    whole = true;
    f(values.planes[k]);
  }
  for_each_set(values.sides, [&](unsigned set) {
    const Index remaining = coming != nullptr ? (*coming)[set] : 0;
    whole = whole || remaining == 0;
    f(row_of(values, height, set, 1 - static_cast<double>(remaining) / ramp_steps));
  });
  if (!whole) f(values.depth);
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
  contact.ramps.clear();
  contact.ramp_of_contactor.assign(contact.contactors.size(), -1);
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
  if (params.field != OverlapField::body) return;
  SurfaceSides& sides = contact.field[at(contactor)].sides;
  // The usual call is for corners that lie on the surface already: leave without touching the list of ramps.
  if (on_one_face(sides, set)) return;
  sides |= 1 << set;
  ramp_of(contactor, contact).remaining[set] = params.ramp_steps;
}

void advance_field(ContactState& contact) {
  drop_finished_ramps(contact);
  for (FieldRamp& ramp : contact.ramps) {
    ramp.before = ramp.remaining;
    for (Index& remaining : ramp.remaining) remaining = std::max(remaining - 1, 0);
  }
}

OverlapFunction least_of_all_functions(const std::array<double, 4>& height, const FieldValues& values,
                                       const std::array<double, 4>& lambda) {
  OverlapFunction least{std::numeric_limits<double>::infinity(), {}};
  for_each_function(values, height, 1, nullptr, [&](const std::array<double, 4>& row) {
    const double g = row_value(row, lambda);
    if (g < least.g) least = {g, row};
  });
  return least;
}

OverlapShape overlap_shape(const ContactParams& params, const LocalMesh& local, const ContactState& contact,
                           Index contactor, Instant instant) {
  const Index slot = contact.contactors[at(contactor)], ramp = contact.ramp_of_contactor[at(contactor)];
  const double length = contact.body_length[at(local.slot_body[at(slot)])];
  const FieldValues& values = contact.field[at(contactor)];
  const std::array<double, 4>& height = contact.height[at(contactor)];
  if (ramp < 0) return overlap_shape(params, height, values, length);
  const FieldRamp& coming = contact.ramps[at(ramp)];
  return overlap_shape(params, height, values, length, instant == Instant::now ? &coming.remaining : &coming.before);
}

OverlapShape overlap_shape(const ContactParams& params, const std::array<double, 4>& height, const FieldValues& values,
                           double length, const ComingSets* coming) {
  OverlapShape shape;
  if (params.field == OverlapField::body) {
    for_each_function(values, height, params.ramp_steps, coming,
                      [&](const std::array<double, 4>& row) { shape.add(row); });
    return shape;
  }
  std::array<double, 4> face{};
  switch (params.field) {
    case OverlapField::body:
      break;
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
