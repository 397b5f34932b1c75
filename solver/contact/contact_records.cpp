#include <algorithm>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/index.hpp"
#include "contact/contact_search.hpp"
#include "physics/contact/couples.hpp"
#include "physics/contact/geometry/point.hpp"

/// The part of ContactSearch that stores its state in records and restores it from them.
namespace breccia {

namespace {

/// The entries of a list that belong to an element.
template <class T>
std::span<const T> entries_of(const std::vector<T>& list, GlobalId first, GlobalId end, auto&& id_of) {
  const auto before = [&](const T& entry, GlobalId id) { return id_of(entry) < id; };
  const auto from = std::lower_bound(list.begin(), list.end(), first, before);
  return {from, std::lower_bound(from, list.end(), end, before)};
}

/// The couple of a record, with -1 for a point or contactor that is not on this rank
TouchingCouple restored(const CoupleRecord& record, const ContactState& contact, const LocalMesh& local) {
  TouchingCouple couple = record.couple;
  couple.point = couple.contactor = -1;
  const auto point = std::lower_bound(contact.order.begin(), contact.order.end(), record.point,
                                      [&](Index p, GlobalId id) { return contact.id(p) < id; });
  if (point != contact.order.end() && contact.id(*point) == record.point) couple.point = *point;
  const auto contactor =
      std::lower_bound(contact.contactors.begin(), contact.contactors.end(), record.contactor,
                       [&](Index slot, GlobalId id) { return local.element_of_slot[at(slot)] < id; });
  if (contactor != contact.contactors.end() && local.element_of_slot[at(*contactor)] == record.contactor) {
    couple.contactor = static_cast<Index>(contactor - contact.contactors.begin());
  }
  return couple;
}

CoupleRecord record_of(const TouchingCouple& couple, GlobalId element, const ContactState& contact,
                       const LocalMesh& local) {
  return {element, local.element_of_slot[at(contact.contactors[at(couple.contactor)])], contact.id(couple.point),
          couple};
}

}  // namespace

ContactSearch::ContactSearch(const ContactSearchParams& search, const Model& model, const Records& records,
                             ContactState& contact)
    : verify_(search.verify),
      contact_(contact),
      surface_(search, {model.contact, model.mesh, model.topology, model.local}, contact),
      search_(search, surface_, contact, model.whole.contactor_size),
      kept_(contact),
      release_(surface_, search_, contact) {
  restore_contactors(records);
  contact_.body_length = model.whole.body_length;
  contact_.body_extent = model.whole.body_extent;
  contact_.near = search_.always_found();
  contact_.travel = 0;
  surface_.add_free_points();
  restore_faces(records);
  sort_points(contact_);
  restore_offsets(records);
  adopt(records.couples);
}

void ContactSearch::restore_contactors(const Records& records) {
  const ContactModel& model = surface_.model();
  std::vector<Index> slots;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    if (records.elements[at(e)].contactor == 0) continue;
    slots.push_back(model.slot_of(e));
    contact_.field.push_back(records.elements[at(e)].field);
  }
  set_contactors(model.local, std::move(slots), contact_);
}

/// Faces that fracture has freed.
void ContactSearch::restore_faces(const Records& records) {
  const ContactModel& model = surface_.model();
  std::vector<Topology::Face> released;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if ((records.elements[at(e)].released >> f & 1) == 0 || model.topology.links[at(e)][at(f)].free()) continue;
      released.push_back({e, f});
      surface_.add_points(e, f);
    }
  }
  std::vector<Index> changed;
  surface_.break_faces(released, changed);
}

void ContactSearch::restore_offsets(const Records& records) {
  if (records.offsets.empty()) return;
  contact_.boundary_offset.assign(contact_.points.size(), std::numeric_limits<double>::infinity());
  for (const OffsetRecord& record : records.offsets) {
    const auto found = std::lower_bound(contact_.order.begin(), contact_.order.end(), record.point,
                                        [&](Index point, GlobalId id) { return contact_.id(point) < id; });
    DEMAND(found != contact_.order.end() && contact_.id(*found) == record.point,
           "contact point " + std::to_string(record.point) + " is not there");
    contact_.boundary_offset[at(*found)] = record.offset;
  }
}

void ContactSearch::adopt(std::span<const CoupleRecord> touching) {
  const LocalMesh& local = surface_.model().local;
  std::vector<TouchingCouple>& known = contact_.touching;
  std::erase_if(known, [&](const TouchingCouple& c) { return !local.is_original(contact_.points[at(c.point)].slot); });
  const std::ptrdiff_t own = std::ssize(known);
  for (const CoupleRecord& record : touching) {
    const TouchingCouple couple = restored(record, contact_, local);
    // What a point touches beyond this rank's elements exerts no force here.
    if (couple.point >= 0 && couple.contactor >= 0 && concerns(couple)) known.push_back(couple);
  }
  const auto before = [&](const TouchingCouple& a, const TouchingCouple& b) {
    return contact_.before({a.point, a.contactor}, {b.point, b.contactor});
  };
  std::sort(known.begin() + own, known.end(), before);
  std::inplace_merge(known.begin(), known.begin() + own, known.end(), before);
}

/// Whether forces here depend on what a point has touched: on those of a kept point, and where it presses for the last
/// time. All else would be gathered in every step for nothing.
bool ContactSearch::concerns(const TouchingCouple& couple) const {
  return kept_.is_kept(couple.point) || contact_.evaluated(contact_.contactors[at(couple.contactor)]);
}

std::vector<CoupleRecord> ContactSearch::touching_of(std::span<const Index> slots) const {
  const LocalMesh& local = surface_.model().local;
  std::vector<CoupleRecord> touching;
  const auto before = [&](Index slot, GlobalId element) { return local.element_of_slot[at(slot)] < element; };
  auto next = slots.begin();
  for (const TouchingCouple& couple : contact_.touching) {
    const Index slot = contact_.points[at(couple.point)].slot;
    const GlobalId element = local.element_of_slot[at(slot)];
    next = std::lower_bound(next, slots.end(), element, before);
    if (next == slots.end()) break;
    if (*next == slot) touching.push_back(record_of(couple, element, contact_, local));
  }
  return touching;
}

void ContactSearch::store(Index element, ElementRecord& record, Records& records) const {
  const ContactModel& model = surface_.model();
  for (int f = 0; f < 4; ++f) {
    if (clusters().broken(element, f)) record.released |= static_cast<std::uint8_t>(1U << f);
  }
  const Index contactor = contact_.contactor_of_slot[at(model.slot_of(element))];
  if (contactor >= 0) {
    record.contactor = 1;
    record.field = contact_.field[at(contactor)];
  }
  const GlobalId first = kPointsAnElement * record.id, end = first + kPointsAnElement;
  for (const Index point : entries_of(contact_.order, first, end, [&](Index p) { return contact_.id(p); })) {
    if (at(point) < contact_.boundary_offset.size()) {
      records.offsets.push_back({record.id, contact_.id(point), contact_.boundary_offset[at(point)]});
    }
  }
  for (const TouchingCouple& couple :
       entries_of(contact_.touching, first, end, [&](const TouchingCouple& c) { return contact_.id(c.point); })) {
    records.couples.push_back(record_of(couple, record.id, contact_, model.local));
  }
}

}  // namespace breccia
