#include "contact/face_release.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "base/index.hpp"
#include "detection/point_body/couple_test.hpp"
#include "physics/contact/couples.hpp"
#include "physics/contact/geometry/field.hpp"

namespace breccia {

namespace {

template <class T, class Key>
void sort_unique(std::vector<T>& list, Key&& key) {
  std::sort(list.begin(), list.end(), [&](const T& a, const T& b) { return key(a) < key(b); });
  list.erase(std::unique(list.begin(), list.end(), [&](const T& a, const T& b) { return key(a) == key(b); }),
             list.end());
}

}  // namespace

std::vector<ContactCouple>& FaceRelease::release(std::span<const FreedFace> faces) {
  made_.clear();
  collect_sides(faces);
  if (sides_.empty()) return made_;
  store_clusters();
  surface_.break_faces(sides_, changed_);
  const std::size_t first = contact_.points.size();
  for (const Topology::Face& side : sides_) {
    surface_.add_points(side.element, side.face);
    free_corners_of(side);
  }
  sort_points(contact_);
  if (!search_.searched()) return made_;
  couple_new_points(first);
  couple_separated(first);
  return made_;
}

/// Both sides of every face that is not free yet, as far as this rank has them, each once.
void FaceRelease::collect_sides(std::span<const FreedFace> faces) {
  const ContactModel& model = surface_.model();
  sides_.clear();
  for (const FreedFace& freed : faces) {
    const Index element = model.local.mesh_element[at(freed.slot)];
    const FaceLink& link = model.topology.links[at(element)][at(freed.face)];
    if (link.free() || surface_.clusters().broken(element, freed.face)) continue;
    sides_.push_back({element, freed.face});
    if (link.inner()) sides_.push_back({link.neighbour, link.face()});
  }
  sort_unique(sides_, [](const Topology::Face& f) { return std::tuple(f.element, f.face); });
}

/// Corners at the nodes of the faces about to break, by node, with the clusters they belong to.
void FaceRelease::store_clusters() {
  const CornerClusters& clusters = surface_.clusters();
  nodes_.clear();
  for (const Topology::Face& side : sides_) {
    for (const int corner : kFaceCorners[at(side.face)])
      nodes_.push_back(surface_.model().mesh.elements[at(side.element)][at(corner)]);
  }
  sort_unique(nodes_, [](Index node) { return node; });
  old_clusters_.clear();
  for (const Index node : nodes_) {
    for (const Index id : clusters.corners_at(node)) old_clusters_.push_back(clusters.cluster(id / 4, id % 4));
  }
}

/// The corners of a freed face, with everything still bonded to them, lie on the free surface now.
void FaceRelease::free_corners_of(const Topology::Face& side) {
  const ContactModel& model = surface_.model();
  const CornerClusters& clusters = surface_.clusters();
  freed_.clear();
  for (const int corner : kFaceCorners[at(side.face)]) {
    const Index cluster = clusters.cluster(side.element, corner);
    for (const Index id : clusters.corners_at(model.mesh.elements[at(side.element)][at(corner)])) {
      if (clusters.cluster(id / 4, id % 4) == cluster) freed_.push_back(id);
    }
  }
  std::sort(freed_.begin(), freed_.end());
  for (auto id = freed_.begin(); id != freed_.end();) {
    const Index element = *id / 4;
    unsigned set = 0;
    for (; id != freed_.end() && *id / 4 == element; ++id) set |= 1U << (*id % 4);
    const Index contactor = contact_.contactor_of_slot[at(model.slot_of(element))];
    if (contactor >= 0) free_corners(model.params, contactor, set, contact_);
  }
}

/// Couples of the points from `first` on.
void FaceRelease::couple_new_points(std::size_t first) {
  for (std::size_t p = first; p < contact_.points.size(); ++p) {
    const auto point = static_cast<Index>(p);
    if (!surface_.may_press(contact_.points[p].slot)) continue;
    search_.contactors_of(search_.position(contact_.points[p]), contactors_);
    for (const Index contactor : contactors_) {
      if (surface_.may_touch(point, contactor)) made_.push_back({point, contactor});
    }
  }
}

/// Two elements that were bonded and are so no longer have parted at some node: there they were of one cluster and are
/// now of two. So nothing has to be kept of the pairs that were turned down as bonded.
/// @param first  points from here on are coupled already
void FaceRelease::couple_separated(std::size_t first) {
  std::size_t start = 0;
  for (const Index node : nodes_) {
    const std::span<const Index> corners = surface_.clusters().corners_at(node);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = i + 1; j < corners.size(); ++j) {
        if (old_clusters_[start + i] != old_clusters_[start + j]) continue;
        const Index a = corners[i] / 4, b = corners[j] / 4;
        if (surface_.clusters().bonded(a, b)) continue;
        couple_points_of(a, b, first);
        couple_points_of(b, a, first);
      }
    }
    start += corners.size();
  }
}

/// Couples of the points of one element, up to `first`, with another element not bonded to it.
void FaceRelease::couple_points_of(Index element, Index other, std::size_t first) {
  const ContactModel& model = surface_.model();
  const Index contactor = contact_.contactor_of_slot[at(model.slot_of(other))];
  if (contactor < 0 || !surface_.has_law(model.slot_of(element), model.slot_of(other))) return;
  std::optional<detection::CoupleTest> test;
  for (const Index face_start : surface_.first_points(element)) {
    if (face_start < 0 || at(face_start) >= first) continue;
    if (!test) test.emplace(search_.corners(contactor), search_.buffer());
    if (test->skipped()) return;
    for (Index p = face_start; p < face_start + face_rule(model.params.points_per_face).num_points; ++p) {
      if (test->holds(search_.position(contact_.points[at(p)]))) made_.push_back({p, contactor});
    }
  }
}

}  // namespace breccia
