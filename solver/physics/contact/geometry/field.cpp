#include "physics/contact/geometry/field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.hpp"

namespace breccia {

namespace {

void drop_finished_ramps(ContactState& contact) {
  std::size_t kept = 0;
  for (const FieldRamp& ramp : contact.ramps) {
    const bool done = std::all_of(ramp.remaining.begin(), ramp.remaining.end(), [](Index n) { return n == 0; });
    contact.ramp_of_contactor[at(ramp.contactor)] = done ? -1 : static_cast<Index>(kept);
    CornerSets& sets = contact.field[at(ramp.contactor)].sets;
    if (done) {
      sets = largest_sets(sets) | (sets & kFractured);
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

/// One function of an element on the surface. @param weight  of the set, 0 to 1
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

/// Calls f(row) for each side of an element that cannot break: those of its own faces first.
template <class F>
void for_each_distance(const FieldValues& values, const std::array<double, 4>& height, F&& f) {
  for (const std::size_t a : {3, 2, 1, 0}) {
    if ((values.sets >> (15U ^ 1U << a) & 1) == 0) continue;
    std::array<double, 4> row{};
    row[a] = height[a];
    f(row);
  }
  for (std::size_t k = 0; k < num_planes(values.sets); ++k) f(values.sides[k]);
}

OverlapShape exact_shape(const FieldValues& values, const std::array<double, 4>& height) {
  OverlapShape shape;
  for_each_distance(values, height, [&](const std::array<double, 4>& row) { shape.add(row); });
  if (shape.rows == 0) shape.add(values.depth);
  return shape;
}

OverlapFunction least_distance(const FieldValues& values, const std::array<double, 4>& height,
                               const std::array<double, 4>& lambda) {
  const auto value = [&](const std::array<double, 4>& row) {
    return lambda[0] * row[0] + lambda[1] * row[1] + lambda[2] * row[2] + lambda[3] * row[3];
  };
  OverlapFunction least{value(values.depth), values.depth};
  bool first = true;
  for_each_distance(values, height, [&](const std::array<double, 4>& row) {
    const double g = value(row);
    if (first || g < least.g) least = {g, row};
    first = false;
  });
  return least;
}

OverlapShape body_shape(const ContactParams& params, const std::array<double, 4>& height, const FieldValues& values,
                        const ComingSets* coming) {
  if (values.is_exact()) return exact_shape(values, height);
  OverlapShape shape;
  bool whole = false;  // a set that counts in full
  const bool has_sides = (values.sets & kFractured) == 0;
  for_each_side(values.sets, [&](unsigned set, int place) {
    const Index remaining = coming != nullptr ? (*coming)[set] : 0;
    whole = whole || remaining == 0;
    shape.add(row_of(values, height, set, 1 - static_cast<double>(remaining) / params.ramp_steps));
    if (has_sides && 0 <= place && at(place) < kMostSides) shape.set_side(values.sides[at(place)]);
  });
  if (!whole) shape.add(values.depth);
  return shape;
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
  values.sets = surface.sets[at(element)];
  values.sides = surface.sides[at(element)];
  return values;
}

void free_corners(const ContactParams& params, Index contactor, unsigned set, ContactState& contact) {
  if (params.field != OverlapField::body) return;
  CornerSets& sets = contact.field[at(contactor)].sets;
  // The usual call is for corners that lie on the surface already: leave without touching the list of ramps.
  if (covers(sets, set)) return;
  sets |= 1 << set | kFractured;
  ramp_of(contactor, contact).remaining[set] = params.ramp_steps;
}

void advance_field(ContactState& contact) {
  drop_finished_ramps(contact);
  for (FieldRamp& ramp : contact.ramps) {
    ramp.before = ramp.remaining;
    for (Index& remaining : ramp.remaining) remaining = std::max(remaining - 1, 0);
  }
}

OverlapFunction least_function_of_sets(const std::array<double, 4>& height, const FieldValues& values,
                                       const std::array<double, 4>& lambda) {
  if (values.is_exact()) return least_distance(values, height, lambda);
  std::array<double, 4> by_depth{}, by_height{};
  for (std::size_t a = 0; a < 4; ++a) {
    by_depth[a] = lambda[a] * values.depth[a];
    by_height[a] = lambda[a] * std::min(values.depth[a], height[a]);
  }
  double least = std::numeric_limits<double>::infinity();
  unsigned set_of_least = 0;
  for_each_set(values.sets, [&](unsigned set) {
    const std::array<double, 4>& term = is_face(set) ? by_height : by_depth;
    double g = 0;
    for (std::size_t a = 0; a < 4; ++a) g += has_corner(set, a) ? 0.0 : term[a];
    if (!(g < least)) return;
    least = g;
    set_of_least = set;
  });
  if (set_of_least == 0) return {by_depth[0] + by_depth[1] + by_depth[2] + by_depth[3], values.depth};
  return {least, row_of(values, height, set_of_least, 1.0)};
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
  if (params.field == OverlapField::body) return body_shape(params, height, values, coming);
  OverlapShape shape;
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
