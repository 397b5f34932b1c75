#include "physics/contact/step/elements.hpp"

#include <algorithm>
#include <optional>

#include "base/index.hpp"
#include "physics/contact/step/surface.hpp"

namespace breccia {
namespace {

ContactElements::Cause cause_of(const ContactStepModel& model, Index slot) {
  unsigned held = 0;
  for (int c = 0; c < 4; ++c) {
    if (model.held[at(model.mesh.corner_node(slot, c))] != 0) held |= 1U << c;
  }
  const Index contactor = model.state != nullptr ? model.state->contactor_of_slot[at(slot)] : -1;
  return {.open = model.faces.open[at(slot)],
          .held = static_cast<std::uint8_t>(held),
          .sets = contactor >= 0 ? std::int32_t{model.state->field[at(contactor)].sets} : -1};
}

/// Copies from `first` on; whether anything is different.
bool replace(std::span<const std::uint8_t> all, Index first, std::vector<std::uint8_t>& kept) {
  const auto now = all.subspan(at(first));
  if (std::equal(now.begin(), now.end(), kept.begin(), kept.end())) return false;
  kept.assign(now.begin(), now.end());
  return true;
}

}  // namespace

bool ContactElements::shared_changed(const ContactStepModel& model) {
  const bool open = replace(model.faces.open, model.mesh.num_own_slots, shared_open_);
  return replace(model.held, model.mesh.num_own_nodes(), shared_held_) || open;
}

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
  const bool all_shared = shared_changed(model);
  std::optional<ContactSurface> own, shared;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (!mesh.is_original(s)) continue;
    Index& place = place_[at(s)];
    if (model.faces.open[at(s)] == 0) {
      if (place >= 0) list_[at(place)].cause.open = 0;
      continue;
    }
    const bool is_shared = s >= mesh.num_own_slots, known = place >= 0;
    if (!known) {
      place = static_cast<Index>(list_.size());
      list_.push_back({.slot = s, .cause = {}, .element = {}});
    }
    Entry& entry = list_[at(place)];
    const Cause cause = cause_of(model, s);
    if (known && entry.cause == cause && !(is_shared && all_shared)) continue;
    std::optional<ContactSurface>& surface = is_shared ? shared : own;
    if (!surface) surface.emplace(model, is_shared);
    entry.cause = cause;
    entry.element = surface->element(s);
    raise_largest(model, entry);
  }
}

}  // namespace breccia
