#include "physics/contact/contact_field.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/geometry.hpp"

namespace breccia {

namespace {

constexpr std::size_t kBubble = 4;

/// 1 / height over face a in the reference configuration = length of the gradient of lambda_a.
std::array<double, 4> inverse_heights(const LocalMesh& local, Index slot) {
  const double* m = local.gradient.data() + static_cast<std::size_t>(slot / kLanes) * 9 * kLanes + slot % kLanes;
  Vec3 sum = Vec3::Zero();
  std::array<double, 4> inverse{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 row(m[8 * (3 * c)], m[8 * (3 * c + 1)], m[8 * (3 * c + 2)]);
    inverse[c + 1] = row.norm();
    sum += row;
  }
  inverse[0] = sum.norm();
  return inverse;
}

double inradius(const LocalMesh& local, Index slot) {
  return geometry::inradius(load_corners(local, local.reference.data(), slot));
}

bool all_on_surface(const FieldValues& values) {
  return values[0] == 0 && values[1] == 0 && values[2] == 0 && values[3] == 0;
}

FieldRamp& ramp_of(ContactState& contact, Index contactor) {
  const auto c = static_cast<std::size_t>(contactor);
  Index& place = contact.ramp_of_contactor[c];
  if (place < 0) {
    place = static_cast<Index>(contact.ramps.size());
    contact.ramps.push_back({contactor, {}, contact.field[c], contact.field[c]});
  }
  return contact.ramps[static_cast<std::size_t>(place)];
}

bool at_rest(const FieldRamp& ramp) {
  return std::all_of(ramp.remaining.begin(), ramp.remaining.end(), [](Index n) { return n == 0; });
}

void drop_finished_ramps(ContactState& contact) {
  std::size_t kept = 0;
  for (const FieldRamp& ramp : contact.ramps) {
    const bool done = at_rest(ramp);
    contact.ramp_of_contactor[static_cast<std::size_t>(ramp.contactor)] = done ? -1 : static_cast<Index>(kept);
    if (!done) contact.ramps[kept++] = ramp;
  }
  contact.ramps.resize(kept);
}

}  // namespace

void build_field(const ContactParams& params, const LocalMesh& local, std::span<const double> surface_distance,
                 ContactState& contact) {
  contact.field.assign(contact.contactors.size(), FieldValues{});
  contact.ramps.clear();
  contact.ramp_of_contactor.assign(contact.contactors.size(), -1);
  for (std::size_t c = 0; c < contact.contactors.size(); ++c) {
    const Index slot = contact.contactors[c];
    std::array<double, 4> distance{};
    for (std::size_t a = 0; a < 4; ++a)
      distance[a] = surface_distance[static_cast<std::size_t>(local.vertex[static_cast<std::size_t>(slot)][a])];
    contact.field[c] = field_at_rest(params.field, distance, load_corners(local, local.reference.data(), slot));
  }
}

FieldValues field_at_rest(OverlapField field, const std::array<double, 4>& surface_distance,
                          const std::array<Vec3, 4>& corners) {
  if (field != OverlapField::body) return {};
  FieldValues values{surface_distance[0], surface_distance[1], surface_distance[2], surface_distance[3], 0.0};
  if (all_on_surface(values)) values[kBubble] = geometry::inradius(corners);
  return values;
}

void free_corner(const ContactParams& params, const LocalMesh& local, Index contactor, int corner,
                 ContactState& contact) {
  if (params.field != OverlapField::body) return;
  const auto a = static_cast<std::size_t>(corner);
  // The usual call is for a corner that lies on the surface already: leave without touching the list of ramps.
  if (contact.field[static_cast<std::size_t>(contactor)][a] == 0) return;
  FieldRamp& ramp = ramp_of(contact, contactor);
  if (ramp.target[a] == 0) return;
  ramp.target[a] = 0;
  ramp.remaining[a] = params.ramp_steps;
  if (!all_on_surface(ramp.target)) return;
  ramp.target[kBubble] = inradius(local, contact.contactors[static_cast<std::size_t>(contactor)]);
  ramp.remaining[kBubble] = params.ramp_steps;
}

void advance_field(ContactState& contact) {
  drop_finished_ramps(contact);
  for (FieldRamp& ramp : contact.ramps) {
    FieldValues& now = contact.field[static_cast<std::size_t>(ramp.contactor)];
    ramp.before = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (ramp.remaining[i] == 0) continue;
      now[i] = ramp.remaining[i] == 1 ? ramp.target[i] : now[i] + (ramp.target[i] - now[i]) / ramp.remaining[i];
      --ramp.remaining[i];
    }
  }
}

OverlapShape overlap_shape(OverlapField field, const LocalMesh& local, Index slot, const FieldValues& values,
                           double length) {
  OverlapShape shape;
  switch (field) {
    case OverlapField::body:
      shape.nodal = {values[0], values[1], values[2], values[3]};
      shape.face.fill(4 * values[kBubble]);
      break;
    case OverlapField::tet_potential:
      shape.face.fill(4 * length);
      break;
    case OverlapField::tet_distance: {
      const std::array<double, 4> inverse = inverse_heights(local, slot);
      for (std::size_t a = 0; a < 4; ++a) shape.face[a] = 1 / inverse[a];
      break;
    }
  }
  return shape;
}

}  // namespace breccia
