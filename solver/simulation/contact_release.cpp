#include <algorithm>
#include <tuple>

#include "detection/point_body/couple_test.hpp"
#include "physics/contact/contact_couples.hpp"
#include "physics/contact/contact_field.hpp"
#include "simulation/contact_search.hpp"

/// The incremental part of ContactSearch: what follows from faces that fracture has freed.
namespace breccia {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void ContactSearch::release_faces(std::span<const FreedFace> faces) {
  collect_sides(faces);
  if (sides_.empty()) return;
  clusters_.break_faces(sides_, changed_);
  const std::size_t first = contact_.points.size();
  for (const Topology::Face& side : sides_) {
    add_points_of(side.element, side.face);
    free_corners_of(side);
  }
  sort_points(contact_);
  if (!searched_) return;
  made_.clear();
  couple_new_points(first);
  couple_separated();
  add_found();
}

/// Both sides of every face that is not free yet, each once.
void ContactSearch::collect_sides(std::span<const FreedFace> faces) {
  sides_.clear();
  for (const FreedFace& freed : faces) {
    const auto element = static_cast<Index>(local_->element_of_slot[at(freed.slot)]);
    const FaceLink& link = topology_->links[at(element)][at(freed.face)];
    if (link.free() || clusters_.broken(element, freed.face)) continue;
    sides_.push_back({element, freed.face});
    sides_.push_back({link.neighbour, link.face()});
  }
  const auto key = [](const Topology::Face& f) { return std::tuple(f.element, f.face); };
  std::sort(sides_.begin(), sides_.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  sides_.erase(std::unique(sides_.begin(), sides_.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
               sides_.end());
}

/// The corners of a freed face, with everything still bonded to them, lie on the free surface now.
void ContactSearch::free_corners_of(const Topology::Face& side) {
  for (const int corner : kFaceCorners[at(side.face)]) {
    const Index cluster = clusters_.cluster(side.element, corner);
    for (const Index id : clusters_.corners_at(mesh_->elements[at(side.element)][at(corner)])) {
      if (clusters_.cluster(id / 4, id % 4) != cluster) continue;
      const Index contactor = contact_.contactor_of_slot[at(local_->slot_of_element[at(id / 4)])];
      if (contactor >= 0) free_corner(*params_, *local_, contactor, id % 4, contact_);
    }
  }
}

/// Couples of the points from `first` on.
void ContactSearch::couple_new_points(std::size_t first) {
  if (first == contact_.points.size()) return;
  if (!grid_built_) grid_.build(corners_, buffer_);
  grid_built_ = true;
  const FaceRule& rule = face_rule(params_->points_per_face);
  for (std::size_t p = first; p < contact_.points.size(); ++p) {
    const auto point = static_cast<Index>(p);
    grid_.couples_of(at_point(rule, contact_.points[p], reference_.data()), contactors_of_point_);
    for (const Index contactor : contactors_of_point_) {
      if (may_touch(point, contactor)) made_.push_back({point, contactor});
    }
  }
}

/// Two elements that were bonded and are so no longer have parted around some node, and there the corner of one of them has
/// changed its cluster: nothing has to be kept of the pairs turned down as bonded.
void ContactSearch::couple_separated() {
  for (const Index id : changed_) {
    const Index element = id / 4, corner = id % 4;
    const Index contactor = contact_.contactor_of_slot[at(local_->slot_of_element[at(element)])];
    for (const Index other : clusters_.corners_at(mesh_->elements[at(element)][at(corner)])) {
      const Index neighbour = other / 4;
      if (clusters_.cluster(neighbour, other % 4) == clusters_.cluster(element, corner)) continue;
      if (clusters_.bonded(element, neighbour)) continue;
      const Index other_contactor = contact_.contactor_of_slot[at(local_->slot_of_element[at(neighbour)])];
      if (other_contactor >= 0) couple_points_of(element, other_contactor);
      if (contactor >= 0) couple_points_of(neighbour, contactor);
    }
  }
}

/// Couples of all points of an element with one contactor not bonded to it.
void ContactSearch::couple_points_of(Index element, Index contactor) {
  const Index slot = local_->slot_of_element[at(element)];
  if (!has_law(slot, contact_.contactors[at(contactor)])) return;
  const auto first = std::lower_bound(contact_.order.begin(), contact_.order.end(), GlobalId{24} * element,
                                      [&](Index p, GlobalId id) { return contact_.id(p) < id; });
  if (first == contact_.order.end() || contact_.points[at(*first)].slot != slot) return;
  const detection::CoupleTest test(corners_[at(contactor)], buffer_);
  if (test.skipped()) return;
  const FaceRule& rule = face_rule(params_->points_per_face);
  for (auto p = first; p != contact_.order.end() && contact_.points[at(*p)].slot == slot; ++p) {
    if (test.holds(at_point(rule, contact_.points[at(*p)], reference_.data()))) made_.push_back({*p, contactor});
  }
}

/// Brings `made_` into the couples; pairs already there stay as they are.
void ContactSearch::add_found() {
  const auto in_order = [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); };
  std::sort(made_.begin(), made_.end(), in_order);
  made_.erase(std::unique(made_.begin(), made_.end()), made_.end());
  std::erase_if(made_, [&](const ContactCouple& couple) {
    return std::binary_search(contact_.couples.begin(), contact_.couples.end(), couple, in_order);
  });
  add_fresh_couples(made_, contact_);
}

}  // namespace breccia
