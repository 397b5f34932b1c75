#include "contact/initial_overlap.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include "base/index.hpp"
#include "detection/point_body/search.hpp"
#include "mesh/geometry.hpp"
#include "mesh/tetrahedron.hpp"
#include "mesh/triangle_tree.hpp"
#include "physics/contact/geometry/field.hpp"
#include "physics/contact/geometry/outward.hpp"

namespace breccia {
namespace {

Index group_of(const LocalMesh& local, Index slot) { return local.block_group[at(slot / kLanes)]; }

/// A place of an element that may be inside another volume. Middles of elements show that volumes coincide, whose
/// surfaces lie on each other.
struct Place {
  enum Kind { point, corner, middle };
  Vec3 x;
  Index element;
  Kind kind;
  Index node = -1;  ///< that it is at, of a corner, and of a contact point at one
};

std::size_t num_volumes(const Mesh& mesh) {
  Index last = -1;
  for (Index e = 0; e < mesh.num_elements(); ++e) last = std::max(last, mesh.volume_of(e));
  return static_cast<std::size_t>(last + 1);
}

/// Faces without a neighbour that carry contact points.
std::vector<Topology::Face> pointed_faces(const Model& model) {
  std::vector<Topology::Face> faces;
  const auto add = [&](Index e, int f) {
    if (model.topology.links[at(e)][at(f)].free()) faces.push_back({e, f});
  };
  if (!model.contact_everywhere) {
    for (const Topology::Face& face : model.contact_faces) add(face.element, face.face);
    return faces;
  }
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) add(e, f);
  }
  return faces;
}

std::vector<Place> places_of(const Model& model) {
  const FaceRule& rule = face_rule(model.contact.points_per_face);
  std::vector<std::pair<Index, Index>> corners;  // node, some element there
  std::vector<Place> places;
  for (const Topology::Face& face : pointed_faces(model)) {
    const std::array<Vec3, 4> x = geometry::corners_of(model.mesh, face.element);
    const std::array<int, 3>& f = kFaceCorners[at(face.face)];
    for (std::size_t k = 0; k < at(rule.num_points); ++k) {
      const std::array<double, 3>& shape = rule.shape[k];
      const Vec3 point = shape[0] * x[at(f[0])] + shape[1] * x[at(f[1])] + shape[2] * x[at(f[2])];
      const int corner = corner_of_face(shape);
      const Index node = corner < 0 ? -1 : model.mesh.elements[at(face.element)][at(f[at(corner)])];
      places.push_back({point, face.element, Place::point, node});
    }
    places.push_back({0.25 * (x[0] + x[1] + x[2] + x[3]), face.element, Place::middle});
    for (const int c : f) corners.emplace_back(model.mesh.elements[at(face.element)][at(c)], face.element);
  }
  std::sort(corners.begin(), corners.end());
  const auto last =
      std::unique(corners.begin(), corners.end(), [](const auto& p, const auto& q) { return p.first == q.first; });
  for (auto c = corners.begin(); c != last; ++c)
    places.push_back({model.mesh.nodes[at(c->first)], c->second, Place::corner, c->first});
  return places;
}

/// A place inside an element of another volume.
struct Hit {
  std::int32_t place;
  Index element;
};

std::vector<Hit> hits_of(const Model& model, const std::vector<Place>& places) {
  const Mesh& mesh = model.mesh;
  std::vector<Vec3> points;
  points.reserve(places.size());
  for (const Place& place : places) points.push_back(place.x);
  std::vector<detection::Corners> corners;
  corners.reserve(at(mesh.num_elements()));
  for (Index e = 0; e < mesh.num_elements(); ++e) corners.push_back(geometry::corners_of(mesh, e));
  std::vector<detection::Couple> couples;
  detection::make_search(detection::Algorithm::packed_tree, 0)->search(points, corners, 0.0, couples);
  std::vector<Hit> hits;
  for (const detection::Couple& couple : couples) {
    const std::size_t entered = at(couple.contactor), own = at(places[at(couple.point)].element);
    if (mesh.volume_of(couple.contactor) == mesh.volume_of(places[at(couple.point)].element)) continue;
    if (!model.contact.law(mesh.element_group[own], mesh.element_group[entered]).active()) continue;
    // Volumes that are glued beside a crack have the nodes of its front in common.
    const auto& nodes = mesh.elements[entered];
    if (std::find(nodes.begin(), nodes.end(), places[at(couple.point)].node) != nodes.end()) continue;
    const std::array<Vec3, 4>& x = corners[entered];
    const auto lambda =
        barycentric(prepare(x, geometry::tetra_volume(x[0], x[1], x[2], x[3])), points[at(couple.point)]);
    if (inside(lambda)) hits.push_back({couple.point, couple.contactor});
  }
  return hits;
}

/// Free surfaces of volumes, each built at its first request.
class Surfaces {
 public:
  explicit Surfaces(const Model& model) : mesh_(model.mesh), trees_(num_volumes(model.mesh)) {
    for (Index e = 0; e < mesh_.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        if (model.topology.links[at(e)][at(f)].free()) faces_.push_back({mesh_.volume_of(e), {e, f}});
      }
    }
    std::stable_sort(faces_.begin(), faces_.end(), [](const auto& p, const auto& q) { return p.volume < q.volume; });
  }
  [[nodiscard]] double distance(Index volume, const Vec3& x) {
    if (!trees_[at(volume)]) trees_[at(volume)] = std::make_unique<TriangleTree>(triangles_of(volume));
    return trees_[at(volume)]->distance(x, std::numeric_limits<double>::infinity());
  }

 private:
  struct Face {
    Index volume;
    Topology::Face face;
  };
  [[nodiscard]] std::vector<Triangle> triangles_of(Index volume) const {
    std::vector<Triangle> triangles;
    const auto first =
        std::lower_bound(faces_.begin(), faces_.end(), volume, [](const Face& f, Index v) { return f.volume < v; });
    for (auto f = first; f != faces_.end() && f->volume == volume; ++f) {
      const auto& corners = mesh_.elements[at(f->face.element)];
      const auto node = [&](std::size_t i) { return mesh_.nodes[at(corners[at(kFaceCorners[at(f->face.face)][i])])]; };
      triangles.push_back({node(0), node(1), node(2)});
    }
    return triangles;
  }

  const Mesh& mesh_;
  std::vector<Face> faces_;  ///< by volume
  std::vector<std::unique_ptr<TriangleTree>> trees_;
};

/// One entry for each pair of volumes that has a hit beyond the tolerance.
std::vector<BodyOverlap> by_volumes(const Model& model, const std::vector<Place>& places,
                                    const std::vector<Hit>& hits) {
  const Mesh& mesh = model.mesh;
  Surfaces surfaces(model);
  std::map<std::pair<Index, Index>, BodyOverlap> found;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Hit& hit = hits[i];
    const Place& place = places[at(hit.place)];
    const Index own = mesh.volume_of(place.element), other = mesh.volume_of(hit.element);
    const double depth = surfaces.distance(other, place.x);
    const double length = model.whole.body_length[at(mesh.element_body[at(hit.element)])];
    if (!(depth > kOverlapTolerance * length)) continue;
    BodyOverlap& overlap = found[std::minmax(own, other)];
    const Index bodies[] = {mesh.element_body[at(place.element)], mesh.element_body[at(hit.element)]};
    overlap.body = bodies[own < other ? 0 : 1];
    overlap.other = bodies[own < other ? 1 : 0];
    const Index groups[] = {mesh.element_group[at(place.element)], mesh.element_group[at(hit.element)]};
    overlap.group = groups[own < other ? 0 : 1];
    overlap.other_group = groups[own < other ? 1 : 0];
    const bool counted = i > 0 && hits[i - 1].place == hit.place && mesh.volume_of(hits[i - 1].element) == other;
    if (!counted && place.kind == Place::point) ++overlap.points;
    if (!counted && place.kind == Place::corner) ++overlap.corners;
    if (!(depth > overlap.depth)) continue;
    overlap.depth = depth;
    overlap.length = length;
    overlap.place = place.x;
  }
  std::vector<BodyOverlap> overlaps;
  overlaps.reserve(found.size());
  for (const auto& [volumes, overlap] : found) overlaps.push_back(overlap);
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const BodyOverlap& p, const BodyOverlap& q) { return p.depth > q.depth; });
  return overlaps;
}

}  // namespace

std::vector<BodyOverlap> initial_overlaps(const Model& model) {
  if (!model.has_contact || num_volumes(model.mesh) < 2) return {};
  const std::vector<Place> places = places_of(model);
  const std::vector<Hit> hits = hits_of(model, places);
  return hits.empty() ? std::vector<BodyOverlap>{} : by_volumes(model, places, hits);
}

void relax_initial_overlaps(const ContactParams& params, const LocalMesh& local, const Field<double>& position,
                            ContactState& contact) {
  const bool asked = std::any_of(params.initial_overlaps.begin(), params.initial_overlaps.end(),
                                 [](InitialOverlap o) { return o == InitialOverlap::relax; });
  if (!asked) return;
  const FaceRule& rule = face_rule(params.points_per_face);
  std::vector<Vec3> points;
  for (const Index p : contact.order) points.push_back(at_point(rule, contact.points[at(p)], position.data()));
  std::vector<detection::Corners> corners;
  for (const Index slot : contact.contactors) corners.push_back(load_corners(local, position.data(), slot));
  std::vector<detection::Couple> couples;
  detection::make_search(detection::Algorithm::packed_tree, 0)->search(points, corners, 0.0, couples);
  for (const detection::Couple& couple : couples) {
    const Index point = contact.order[at(couple.point)], slot = contact.contactors[at(couple.contactor)];
    const Index own = contact.points[at(point)].slot;
    const Index group = group_of(local, own), other = group_of(local, slot);
    if (local.slot_body[at(own)] == local.slot_body[at(slot)] || !params.law(group, other).active() ||
        params.initial_overlap(group, other) != InitialOverlap::relax)
      continue;
    const PreparedTetra tetra = prepare(corners[at(couple.contactor)], local.volume[at(slot)]);
    const auto lambda = barycentric(tetra, points[at(couple.point)]);
    if (!inside(lambda)) continue;
    const OverlapShape shape = overlap_shape(params, local, contact, couple.contactor);
    const Outward outward = outward_at(rule, local, contact, contact.points[at(point)],
                                       [&](Index node) { return load_node(position.data(), node); });
    const double overlap = overlap_value(
        shape, lambda, has_sides(params, contact, couple.contactor) ? rows_for(shape, tetra, outward) : kAllRows);
    if (overlap > 0) contact.touching.push_back({point, couple.contactor, {.offset = overlap}});
  }
}

}  // namespace breccia
