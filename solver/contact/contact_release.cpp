#include <algorithm>
#include <optional>
#include <tuple>

#include "contact/contact_search.hpp"
#include "detection/point_body/couple_test.hpp"
#include "physics/contact/contact_couples.hpp"
#include "physics/contact/contact_field.hpp"

/// The incremental part of ContactSearch: what follows from faces that fracture has freed.
namespace breccia {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

bool ContactSearch::release_faces(std::span<const FreedFace> faces) {
  collect_sides(faces);
  if (sides_.empty()) return false;
  note_clusters();
  clusters_.break_faces(sides_, changed_);
  const std::size_t first = contact_.points.size();
  for (const Topology::Face& side : sides_) {
    add_points_of(side.element, side.face);
    free_corners_of(side);
  }
  sort_points(contact_);
  if (!searched_) return false;
  made_.clear();
  couple_new_points(first);
  couple_separated(first);
  return add_made();
}

/// Both sides of every face that is not free yet, each once.
void ContactSearch::collect_sides(std::span<const FreedFace> faces) {
  sides_.clear();
  for (const FreedFace& freed : faces) {
    const Index element = local_->mesh_element[at(freed.slot)];
    const FaceLink& link = topology_->links[at(element)][at(freed.face)];
    if (!link.inner() || clusters_.broken(element, freed.face)) continue;
    sides_.push_back({element, freed.face});
    sides_.push_back({link.neighbour, link.face()});
  }
  const auto key = [](const Topology::Face& f) { return std::tuple(f.element, f.face); };
  std::sort(sides_.begin(), sides_.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  sides_.erase(
      std::unique(sides_.begin(), sides_.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      sides_.end());
}

/// Corners at the nodes of the faces about to break, by node, with the clusters they belong to.
void ContactSearch::note_clusters() {
  nodes_.clear();
  for (const Topology::Face& side : sides_) {
    for (const int corner : kFaceCorners[at(side.face)])
      nodes_.push_back(mesh_->elements[at(side.element)][at(corner)]);
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  old_clusters_.clear();
  for (const Index node : nodes_) {
    for (const Index id : clusters_.corners_at(node)) old_clusters_.push_back(clusters_.cluster(id / 4, id % 4));
  }
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

/// Two elements that were bonded and are so no longer have parted at some node: there they were of one cluster and are
/// now of two. So nothing has to be kept of the pairs that were turned down as bonded.
/// @param first  points from here on are coupled already
void ContactSearch::couple_separated(std::size_t first) {
  std::size_t start = 0;
  for (const Index node : nodes_) {
    const std::span<const Index> corners = clusters_.corners_at(node);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = i + 1; j < corners.size(); ++j) {
        if (old_clusters_[start + i] != old_clusters_[start + j]) continue;
        const Index a = corners[i] / 4, b = corners[j] / 4;
        if (clusters_.bonded(a, b)) continue;
        couple_points_of(a, b, first);
        couple_points_of(b, a, first);
      }
    }
    start += corners.size();
  }
}

/// Couples of the points of one element, up to `first`, with another element not bonded to it.
void ContactSearch::couple_points_of(Index element, Index other, std::size_t first) {
  const Index slot = local_->slot_of_element[at(element)], other_slot = local_->slot_of_element[at(other)];
  const Index contactor = contact_.contactor_of_slot[at(other_slot)];
  if (contactor < 0 || !has_law(slot, other_slot)) return;
  const FaceRule& rule = face_rule(params_->points_per_face);
  std::optional<detection::CoupleTest> test;
  for (const Index face_start : first_point_[at(element)]) {
    if (face_start < 0 || at(face_start) >= first) continue;
    if (!test) test.emplace(corners_[at(contactor)], buffer_);
    if (test->skipped()) return;
    for (Index p = face_start; p < face_start + rule.num_points; ++p) {
      if (test->holds(at_point(rule, contact_.points[at(p)], reference_.data()))) made_.push_back({p, contactor});
    }
  }
}

/// Brings `made_` into the couples. None is there yet: its point is new, or was bonded to the contactor until now.
/// Returns what release_faces() does.
bool ContactSearch::add_made() {
  std::sort(made_.begin(), made_.end(),
            [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); });
  made_.erase(std::unique(made_.begin(), made_.end()), made_.end());
  const auto is_of_others = [&](const ContactCouple& c) {
    return !contact_.matters(contact_.points[at(c.point)].slot) ||
           !contact_.matters(contact_.contactors[at(c.contactor)]);
  };
  const auto before = [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); };
  const auto is_kept = [&](Index point) {
    if (contact_.matters(contact_.points[at(point)].slot)) return true;
    const auto found =
        std::lower_bound(contact_.couples.begin(), contact_.couples.end(), ContactCouple{point, 0}, before);
    return found != contact_.couples.end() && found->point == point;
  };
  // A couple that matters makes its point's others matter.
  const bool pulls = std::any_of(made_.begin(), made_.end(), [&](const ContactCouple& c) {
    return contact_.matters(contact_.contactors[at(c.contactor)]) && !is_kept(c.point);
  });
  if (pulls) {
    contact_.couples.swap(all_couples_);
    const auto middle = contact_.couples.insert(contact_.couples.end(), made_since_.begin(), made_since_.end());
    std::sort(middle, contact_.couples.end(), before);
    std::inplace_merge(contact_.couples.begin(), middle, contact_.couples.end(), before);
    made_since_.clear();
    add_fresh_couples(made_, contact_);
    all_couples_ = contact_.couples;
    keep_relevant();
    couples_replaced(contact_);
    return true;
  }
  if (!contact_.relevant.empty()) made_since_.insert(made_since_.end(), made_.begin(), made_.end());
  std::erase_if(made_, [&](const ContactCouple& c) { return !is_kept(c.point); });
  add_fresh_couples(made_, contact_);
  return std::any_of(made_.begin(), made_.end(), is_of_others);
}

}  // namespace breccia
