#include <algorithm>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "contact/contact_search.hpp"
#include "physics/contact/contact_couples.hpp"

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

ContactSearch::ContactSearch(const ContactSearchParams& search, const Model& model, const Records& records,
                             ContactState& contact)
    : ContactSearch(search, model.contact, model.mesh, model.topology, model.local, contact, nullptr) {
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
    DEMAND(found != contact_.order.end() && contact_.id(*found) == id,
           "contact point " + std::to_string(id) + " is not there");
    return *found;
  };
  if (!records.offsets.empty()) {
    contact_.boundary_offset.assign(contact_.points.size(), std::numeric_limits<double>::infinity());
    for (const OffsetRecord& record : records.offsets)
      contact_.boundary_offset[at(point_with(record.point))] = record.offset;
  }
  adopt(records.couples);
}

TouchingCouple ContactSearch::restored(const CoupleRecord& record) const {
  TouchingCouple couple = record.couple;
  couple.point = couple.contactor = -1;
  const auto found = std::lower_bound(contact_.order.begin(), contact_.order.end(), record.point,
                                      [&](Index point, GlobalId id) { return contact_.id(point) < id; });
  if (found != contact_.order.end() && contact_.id(*found) == record.point) couple.point = *found;
  const auto contactor =
      std::lower_bound(contact_.contactors.begin(), contact_.contactors.end(), record.contactor,
                       [&](Index slot, GlobalId id) { return local_->element_of_slot[at(slot)] < id; });
  if (contactor != contact_.contactors.end() && local_->element_of_slot[at(*contactor)] == record.contactor) {
    couple.contactor = static_cast<Index>(contactor - contact_.contactors.begin());
  }
  return couple;
}

void ContactSearch::adopt(std::span<const CoupleRecord> touching) {
  std::vector<TouchingCouple>& known = contact_.touching;
  std::erase_if(known,
                [&](const TouchingCouple& c) { return !local_->is_original(contact_.points[at(c.point)].slot); });
  const std::ptrdiff_t own = std::ssize(known);
  for (const CoupleRecord& record : touching) {
    const TouchingCouple couple = restored(record);
    // What a point touches beyond this rank's elements is nobody's concern here.
    if (couple.point >= 0 && couple.contactor >= 0) known.push_back(couple);
  }
  const auto before = [&](const TouchingCouple& a, const TouchingCouple& b) {
    return contact_.before({a.point, a.contactor}, {b.point, b.contactor});
  };
  std::sort(known.begin() + own, known.end(), before);
  std::inplace_merge(known.begin(), known.begin() + own, known.end(), before);
}

std::vector<CoupleRecord> ContactSearch::touching_of(std::span<const Index> slots) const {
  std::vector<CoupleRecord> touching;
  const auto before = [&](Index slot, GlobalId element) { return local_->element_of_slot[at(slot)] < element; };
  auto next = slots.begin();
  for (const TouchingCouple& couple : contact_.touching) {
    const Index slot = contact_.points[at(couple.point)].slot;
    const GlobalId element = local_->element_of_slot[at(slot)];
    next = std::lower_bound(next, slots.end(), element, before);
    if (next == slots.end()) break;
    if (*next == slot) touching.push_back(record_of(couple, element));
  }
  return touching;
}

CoupleRecord ContactSearch::record_of(const TouchingCouple& couple, GlobalId element) const {
  return {element, local_->element_of_slot[at(contact_.contactors[at(couple.contactor)])], contact_.id(couple.point),
          couple};
}

void ContactSearch::restrict_to(std::vector<std::uint8_t> relevant) {
  DEMAND(!searched_, "couples are there already");
  contact_.relevant = std::move(relevant);
  constexpr int kLate = 1;
  moved_ = DisplacementWatch(kLate);
}

/// A point's couples stand in a row; they stay together, since what it touches decides what it may touch next.
void ContactSearch::keep_relevant() {
  std::vector<ContactCouple>& couples = contact_.couples;
  std::size_t kept = 0;
  for (std::size_t first = 0, end = 0; first < couples.size(); first = end) {
    bool matters = contact_.matters(contact_.points[at(couples[first].point)].slot);
    for (end = first; end < couples.size() && couples[end].point == couples[first].point; ++end) {
      matters = matters || contact_.matters(contact_.contactors[at(couples[end].contactor)]);
    }
    for (std::size_t i = first; i < end && matters; ++i) couples[kept++] = couples[i];
  }
  couples.resize(kept);
}

void ContactSearch::mark_coupled(std::vector<std::uint8_t>& marks) const {
  for (const ContactCouple& couple : contact_.couples) {
    marks[at(contact_.points[at(couple.point)].slot)] = 1;
    marks[at(contact_.contactors[at(couple.contactor)])] = 1;
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
    records.couples.push_back(record_of(couple, record.id));
  }
}

}  // namespace breccia
