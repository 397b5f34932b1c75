#include <algorithm>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "physics/contact/contact_couples.hpp"
#include "simulation/contact_search.hpp"

/// The part of ContactSearch that hands histories over from one decomposition to the next.
namespace breccia {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Points have the id 24 element + 6 face + k.
constexpr GlobalId kPointsAnElement = 24;

/// The entries of a list that belong to an element.
template <class T>
std::span<const T> entries_of(const std::vector<T>& list, GlobalId first, GlobalId end, auto&& id_of) {
  const auto before = [&](const T& entry, GlobalId id) { return id_of(entry) < id; };
  const auto from = std::lower_bound(list.begin(), list.end(), first, before);
  return {from, std::lower_bound(from, list.end(), end, before)};
}

}  // namespace

ContactSearch::ContactSearch(const ContactSearchParams& search, const Model& model, const Records& records)
    : ContactSearch(search, model.contact, model.mesh, model.topology, model.local, nullptr) {
  size_ = model.whole.contactor_size;
  restore_contactors(records);
  contact_.body_length = model.whole.body_length;
  add_free_points();
  std::vector<Topology::Face> released;
  for (Index e = 0; e < mesh_->num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if ((records.elements[at(e)].released >> f & 1) == 0 || topology_->links[at(e)][at(f)].free()) continue;
      released.push_back({e, f});
      add_points_of(e, f);
    }
  }
  clusters_.break_faces(released, changed_);
  sort_points(contact_);
  restore_histories(records);
}

void ContactSearch::restore_contactors(const Records& records) {
  std::vector<Index> slots;
  for (Index e = 0; e < mesh_->num_elements(); ++e) {
    if (records.elements[at(e)].contactor == 0) continue;
    slots.push_back(local_->slot_of_element[at(e)]);
    contact_.field.push_back(records.elements[at(e)].field);
  }
  set_contactors(*local_, std::move(slots), contact_);
  for (const RampRecord& record : records.ramps) {
    FieldRamp ramp = record.ramp;
    ramp.contactor = contact_.contactor_of_slot[at(local_->slot_of_element[at(records.place_of(record.element))])];
    contact_.ramp_of_contactor[at(ramp.contactor)] = static_cast<Index>(contact_.ramps.size());
    contact_.ramps.push_back(ramp);
  }
}

void ContactSearch::restore_histories(const Records& records) {
  const auto point_with = [&](GlobalId id) {
    const auto found = std::lower_bound(contact_.order.begin(), contact_.order.end(), id,
                                        [&](Index point, GlobalId wanted) { return contact_.id(point) < wanted; });
    DEMAND(found != contact_.order.end() && contact_.id(*found) == id, "contact point " + std::to_string(id) + " is not there");
    return *found;
  };
  if (!records.offsets.empty()) {
    contact_.boundary_offset.assign(contact_.points.size(), std::numeric_limits<double>::infinity());
    for (const OffsetRecord& record : records.offsets) contact_.boundary_offset[at(point_with(record.point))] = record.offset;
  }
  for (const CoupleRecord& record : records.couples) {
    const Index place = records.place_of(record.contactor);
    if (place < 0) continue;  // what the point touches is nobody's concern here
    TouchingCouple couple = record.couple;
    couple.point = point_with(record.point);
    couple.contactor = contact_.contactor_of_slot[at(local_->slot_of_element[at(place)])];
    contact_.touching.push_back(couple);
  }
}

void ContactSearch::remember(Index element, ElementRecord& record, Records& records) const {
  for (int f = 0; f < 4; ++f) {
    if (clusters_.broken(element, f)) record.released |= static_cast<std::uint8_t>(1U << f);
  }
  const Index contactor = contact_.contactor_of_slot[at(local_->slot_of_element[at(element)])];
  if (contactor >= 0) {
    record.contactor = 1;
    record.field = contact_.field[at(contactor)];
    const Index ramp = contact_.ramp_of_contactor[at(contactor)];
    if (ramp >= 0) records.ramps.push_back({record.id, contact_.ramps[at(ramp)]});
  }
  const GlobalId first = kPointsAnElement * record.id, end = first + kPointsAnElement;
  for (const Index point : entries_of(contact_.order, first, end, [&](Index p) { return contact_.id(p); })) {
    if (at(point) < contact_.boundary_offset.size()) {
      records.offsets.push_back({record.id, contact_.id(point), contact_.boundary_offset[at(point)]});
    }
  }
  for (const TouchingCouple& couple :
       entries_of(contact_.touching, first, end, [&](const TouchingCouple& c) { return contact_.id(c.point); })) {
    const GlobalId other = local_->element_of_slot[at(contact_.contactors[at(couple.contactor)])];
    records.couples.push_back({record.id, other, contact_.id(couple.point), couple});
  }
}

}  // namespace breccia
