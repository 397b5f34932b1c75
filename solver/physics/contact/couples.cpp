#include "physics/contact/couples.hpp"

#include <algorithm>
#include <limits>

#include "base/index.hpp"
#include "physics/contact/geometry/field.hpp"

namespace breccia {

namespace {

auto in_order(const ContactState& contact) {
  return [&contact](const ContactCouple& a, const ContactCouple& b) { return contact.before(a, b); };
}

/// Merges a few sorted entries into many: each finds its place by bisection, what lies between them moves in one piece.
template <class T, class Before>
void merge_few(std::vector<T>& many, const std::vector<T>& few, Before&& before) {
  auto end = static_cast<std::ptrdiff_t>(many.size());
  many.resize(many.size() + few.size());
  for (auto left = static_cast<std::ptrdiff_t>(few.size()); left-- > 0;) {
    const T& entry = few[static_cast<std::size_t>(left)];
    const auto place = std::upper_bound(many.begin(), many.begin() + end, entry, before) - many.begin();
    std::move_backward(many.begin() + place, many.begin() + end, many.begin() + end + left + 1);
    many[static_cast<std::size_t>(place + left)] = entry;
    end = place;
  }
}

/// @param points  out
void group_by_point(const std::vector<ContactCouple>& couples, std::vector<PointCouples>& points) {
  points.clear();
  for (const ContactCouple& couple : couples) {
    if (points.empty() || points.back().point != couple.point)
      points.push_back({couple.point, 0, std::numeric_limits<double>::infinity()});
    ++points.back().count;
    points.back().apart_until = std::min(points.back().apart_until, couple.apart_until);
  }
}

/// Points with further couples, by ascending id: those that had some already keep their place, the others come between.
void add_points(const std::vector<PointCouples>& points, ContactState& contact) {
  const auto by_id = [&](const PointCouples& a, const PointCouples& b) {
    return contact.id(a.point) < contact.id(b.point);
  };
  std::vector<PointCouples>& all = contact.by_point;
  std::vector<PointCouples> added;
  for (const PointCouples& here : points) {
    const auto found = std::lower_bound(all.begin(), all.end(), here, by_id);
    if (found == all.end() || found->point != here.point) {
      added.push_back(here);
    } else {
      found->count += here.count;
      found->apart_until = std::min(found->apart_until, here.apart_until);
    }
  }
  merge_few(all, added, by_id);
}

AwakeCouple awake_of(const ContactCouple& couple, Index index, const ContactState& contact) {
  return {index, couple.point, couple.contactor, contact.contactors[at(couple.contactor)], couple.apart_until};
}

/// Couples that are about to be merged into the others join those awake, which get their indices after that.
void add_awake(const std::vector<ContactCouple>& made, ContactState& contact) {
  std::vector<AwakeCouple>& awake = contact.awake;
  auto end = static_cast<std::ptrdiff_t>(awake.size());
  awake.resize(awake.size() + made.size());
  auto couples_end = contact.couples.end();
  for (auto left = static_cast<std::ptrdiff_t>(made.size()); left-- > 0;) {
    const ContactCouple& couple = made[at(left)];
    couples_end = std::upper_bound(contact.couples.begin(), couples_end, couple, in_order(contact));
    const auto place = static_cast<Index>(couples_end - contact.couples.begin());
    for (; end > 0 && awake[at(end - 1)].couple >= place; --end) {
      AwakeCouple& moved = awake[at(end + left)];
      moved = awake[at(end - 1)];
      moved.couple += static_cast<Index>(left + 1);
    }
    awake[at(end + left)] = awake_of(couple, place + static_cast<Index>(left), contact);
  }
}

}  // namespace

void set_contactors(const LocalMesh& local, std::vector<Index> slots, ContactState& contact) {
  contact.contactors = std::move(slots);
  contact.contactor_of_slot.assign(static_cast<std::size_t>(local.num_slots), -1);
  contact.height.clear();
  for (const Index slot : contact.contactors) contact.height.push_back(heights(local, slot));
  for (std::size_t c = 0; c < contact.contactors.size(); ++c) {
    contact.contactor_of_slot[static_cast<std::size_t>(contact.contactors[c])] = static_cast<Index>(c);
  }
  contact.change_of_contactor.assign(contact.contactors.size(), -1);
  contact.elements = StepElements(local.num_slots);
}

void add_face_points(const ContactParams& params, const LocalMesh& local, Index slot, int face, ContactState& contact) {
  append_points(face_rule(params.points_per_face), local, slot, face, contact.points);
}

void sort_points(ContactState& contact) {
  const auto by_id = [&](Index a, Index b) { return contact.id(a) < contact.id(b); };
  std::vector<Index> added;
  for (std::size_t p = contact.order.size(); p < contact.points.size(); ++p) added.push_back(static_cast<Index>(p));
  std::sort(added.begin(), added.end(), by_id);
  merge_few(contact.order, added, by_id);
}

void couples_replaced(ContactState& contact) {
  contact.awake.clear();
  contact.awake_until = -std::numeric_limits<double>::infinity();
  group_by_point(contact.couples, contact.by_point);
}

void add_fresh_couples(const std::vector<ContactCouple>& made, ContactState& contact) {
  if (made.empty()) return;
  add_awake(made, contact);
  merge_few(contact.couples, made, in_order(contact));
  merge_few(contact.fresh, made, in_order(contact));
  std::vector<PointCouples> points;
  group_by_point(made, points);
  add_points(points, contact);
}

void put_awake_back(ContactState& contact) {
  for (const AwakeCouple& here : contact.awake) contact.couples[at(here.couple)].apart_until = here.apart_until;
  contact.awake.clear();
  contact.awake_until = -std::numeric_limits<double>::infinity();
}

void wake_couples(double ahead, ContactState& contact) {
  put_awake_back(contact);
  const bool all = !(contact.travel < std::numeric_limits<double>::infinity());
  contact.awake_until = contact.travel + ahead;
  const auto sleeps = [&](double apart_until) { return !all && !(apart_until < contact.awake_until); };
  Index first = 0;
  for (PointCouples& point : contact.by_point) {
    const Index end = first + point.count;
    if (!sleeps(point.apart_until)) {
      point.apart_until = std::numeric_limits<double>::infinity();
      for (Index k = first; k < end; ++k) {
        const ContactCouple& couple = contact.couples[at(k)];
        point.apart_until = std::min(point.apart_until, couple.apart_until);
        if (!sleeps(couple.apart_until)) contact.awake.push_back(awake_of(couple, k, contact));
      }
    }
    first = end;
  }
}

}  // namespace breccia
