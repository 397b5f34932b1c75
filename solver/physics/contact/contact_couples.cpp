#include "physics/contact/contact_couples.hpp"

#include <algorithm>

namespace breccia {

namespace {

auto in_order(const ContactState& contact) {
  return [&contact](const ContactCouple& a, const ContactCouple& b) { return contact.before(a, b); };
}

void merge_into(std::vector<ContactCouple>& couples, const std::vector<ContactCouple>& more, const ContactState& contact) {
  const auto middle = static_cast<std::ptrdiff_t>(couples.size());
  couples.insert(couples.end(), more.begin(), more.end());
  std::inplace_merge(couples.begin(), couples.begin() + middle, couples.end(), in_order(contact));
}

}  // namespace

void set_contactors(const LocalMesh& local, std::vector<Index> slots, ContactState& contact) {
  contact.contactors = std::move(slots);
  contact.contactor_of_slot.assign(static_cast<std::size_t>(local.num_slots), -1);
  for (std::size_t c = 0; c < contact.contactors.size(); ++c) {
    contact.contactor_of_slot[static_cast<std::size_t>(contact.contactors[c])] = static_cast<Index>(c);
  }
  contact.ramp_of_contactor.assign(contact.contactors.size(), -1);
  contact.place.assign(contact.contactors.size(), -1);
}

void add_face_points(const ContactParams& params, const LocalMesh& local, Index slot, int face, ContactState& contact) {
  append_points(face_rule(params.points_per_face), local, slot, face, contact.points);
}

void sort_points(ContactState& contact) {
  const auto by_id = [&](Index a, Index b) { return contact.id(a) < contact.id(b); };
  const auto middle = static_cast<std::ptrdiff_t>(contact.order.size());
  while (contact.order.size() < contact.points.size()) contact.order.push_back(static_cast<Index>(contact.order.size()));
  if (middle == static_cast<std::ptrdiff_t>(contact.order.size())) return;
  std::sort(contact.order.begin() + middle, contact.order.end(), by_id);
  std::inplace_merge(contact.order.begin(), contact.order.begin() + middle, contact.order.end(), by_id);
}

void couples_replaced(ContactState& contact) {
  std::fill(contact.place.begin(), contact.place.end(), -1);
  for (const ContactCouple& couple : contact.couples) contact.place[static_cast<std::size_t>(couple.contactor)] = 0;
  contact.in_couples.clear();
  for (std::size_t c = 0; c < contact.place.size(); ++c) {
    if (contact.place[c] < 0) continue;
    contact.place[c] = static_cast<Index>(contact.in_couples.size());
    contact.in_couples.push_back(static_cast<Index>(c));
  }
}

void add_fresh_couples(const std::vector<ContactCouple>& made, ContactState& contact) {
  if (made.empty()) return;
  merge_into(contact.couples, made, contact);
  merge_into(contact.fresh, made, contact);
  for (const ContactCouple& couple : made) {
    Index& place = contact.place[static_cast<std::size_t>(couple.contactor)];
    if (place >= 0) continue;
    place = static_cast<Index>(contact.in_couples.size());
    contact.in_couples.push_back(couple.contactor);
  }
}

}  // namespace breccia
