#include "physics/contact/step/elements.hpp"

#include <algorithm>
#include <optional>

#include "base/index.hpp"
#include "physics/contact/step/surface.hpp"

namespace breccia {
namespace {

/// Bits of the corners whose motion is prescribed.
std::uint8_t held_corners(const ContactStepModel& model, Index slot) {
  unsigned held = 0;
  for (int c = 0; c < 4; ++c) {
    if (model.held[at(model.mesh.corner_node(slot, c))] != 0) held |= 1U << c;
  }
  return static_cast<std::uint8_t>(held);
}

std::int32_t surface_sides(const ContactStepModel& model, Index slot) {
  const Index contactor = model.state != nullptr ? model.state->contactor_of_slot[at(slot)] : -1;
  return contactor >= 0 ? std::int32_t{model.state->field[at(contactor)].sides} : -1;
}

/// Copies a part; whether anything is different.
bool replace(std::span<const std::uint8_t> now, std::vector<std::uint8_t>& kept) {
  if (std::equal(now.begin(), now.end(), kept.begin(), kept.end())) return false;
  kept.assign(now.begin(), now.end());
  return true;
}

}  // namespace

void ContactElements::raise_largest(const ContactStepModel& model, const Entry& entry) {
  double* numbers = &largest_[Largest::count * at(model.mesh.block_group[at(entry.slot / kLanes)])];
  const auto raise = [&](std::size_t number, const std::array<double, 4>& values) {
    numbers[number] = std::max(numbers[number], *std::max_element(values.begin(), values.end()));
  };
  raise(Largest::area_over_mass, entry.element.area_over_mass);
  raise(Largest::per_mass, entry.element.per_mass);
  raise(Largest::steepness, entry.element.steepness);
  raise(Largest::area, entry.element.area);
  const double per_length = 1.0 / model.body_length[at(model.mesh.slot_body[at(entry.slot)])];
  numbers[Largest::per_length] = std::max(numbers[Largest::per_length], per_length);
}

void ContactElements::update(const ContactStepModel& model) {
  const LocalMesh& mesh = model.mesh;
  place_.resize(at(mesh.num_slots), -1);
  largest_.resize(Largest::count * at(model.params.num_groups), 0.0);
  const bool own_held = replace(model.held.first(at(mesh.num_own_nodes())), own_held_);
  const bool shared_held = replace(model.held.subspan(at(mesh.num_own_nodes())), shared_held_);
  const bool shared_open = replace(std::span(model.faces.open).subspan(at(mesh.num_own_slots)), shared_open_);
  const bool all_shared = shared_held || shared_open;
  std::optional<ContactSurface> own, shared;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (!mesh.is_original(s)) continue;
    Index& place = place_[at(s)];
    if (model.faces.open[at(s)] == 0) {
      if (place >= 0) list_[at(place)].cause.open = 0;
      continue;
    }
    if (place < 0) {
      place = static_cast<Index>(list_.size());
      list_.push_back({.slot = s, .cause = {}, .element = {}});
    }
    Entry& entry = list_[at(place)];
    const bool is_shared = s >= mesh.num_own_slots, known = entry.cause.open != 0;
    const bool same_held = known && !(is_shared ? shared_held : own_held);
    const Cause cause{.open = model.faces.open[at(s)],
                      .held = same_held ? entry.cause.held : held_corners(model, s),
                      .sides = surface_sides(model, s)};
    if (known && entry.cause == cause && !(is_shared && all_shared)) continue;
    std::optional<ContactSurface>& surface = is_shared ? shared : own;
    if (!surface) surface.emplace(model, is_shared);
    entry.cause = cause;
    entry.element = surface->element(s);
    raise_largest(model, entry);
  }
}

}  // namespace breccia
