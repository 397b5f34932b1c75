#include "physics/contact/contact_field.hpp"

#include <algorithm>
#include <cmath>

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

/// A point at the incentre has lambda_a = r / h_a, and these add up to 1.
double inradius(const LocalMesh& local, Index slot) {
  const std::array<double, 4> inverse = inverse_heights(local, slot);
  return 1 / (inverse[0] + inverse[1] + inverse[2] + inverse[3]);
}

bool exists(const LocalMesh& local, Index slot) { return local.element_of_slot[static_cast<std::size_t>(slot)] >= 0; }

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

std::vector<double> mean_inradii(const LocalMesh& local) {
  const Index bodies =
      local.slot_body.empty() ? 0 : 1 + *std::max_element(local.slot_body.begin(), local.slot_body.end());
  std::vector<double> sum(static_cast<std::size_t>(bodies), 0.0), count(static_cast<std::size_t>(bodies), 0.0);
  for (Index s = 0; s < local.num_slots; ++s) {
    if (!exists(local, s)) continue;
    const auto body = static_cast<std::size_t>(local.slot_body[static_cast<std::size_t>(s)]);
    sum[body] += inradius(local, s);
    count[body] += 1;
  }
  for (std::size_t b = 0; b < sum.size(); ++b) sum[b] /= std::max(count[b], 1.0);
  return sum;
}

void build_field(const ContactParams& params, const LocalMesh& local, std::span<const double> surface_distance,
                 ContactState& contact) {
  contact.body_length = mean_inradii(local);
  contact.field.assign(contact.contactors.size(), FieldValues{});
  contact.ramps.clear();
  contact.ramp_of_contactor.assign(contact.contactors.size(), -1);
  if (params.field != OverlapField::body) return;
  for (std::size_t c = 0; c < contact.contactors.size(); ++c) {
    const Index slot = contact.contactors[c];
    FieldValues& values = contact.field[c];
    for (std::size_t a = 0; a < 4; ++a) {
      const auto vertex = static_cast<std::size_t>(local.vertex[static_cast<std::size_t>(slot)][a]);
      values[a] = surface_distance[vertex];
    }
    values[kBubble] = all_on_surface(values) ? inradius(local, slot) : 0.0;
  }
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
