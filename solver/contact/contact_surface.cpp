#include "contact/contact_surface.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "mesh/point_distance.hpp"
#include "physics/contact/contact_couples.hpp"
#include "physics/contact/contact_field.hpp"

namespace breccia {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Nodes at which elements of several groups meet.
std::vector<bool> nodes_between_groups(const Mesh& mesh) {
  std::vector<Index> group(at(mesh.num_nodes()), -1);
  std::vector<bool> between(group.size(), false);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (const Index node : mesh.elements[at(e)]) {
      if (group[at(node)] < 0) group[at(node)] = mesh.element_group[at(e)];
      if (group[at(node)] != mesh.element_group[at(e)]) between[at(node)] = true;
    }
  }
  return between;
}

/// A bit a face: it may carry points.
std::vector<std::uint8_t> carrying_faces(const ContactSearchParams& search, const ContactModel& model) {
  std::vector<std::uint8_t> carries(at(model.mesh.num_elements()), search.everywhere ? 0xF : 0);
  for (const Topology::Face& face : search.faces) {
    carries[at(face.element)] |= static_cast<std::uint8_t>(1 << face.face);
    const FaceLink& link = model.topology.links[at(face.element)][at(face.face)];
    if (link.inner()) carries[at(link.neighbour)] |= static_cast<std::uint8_t>(1 << link.face());
  }
  return carries;
}

}  // namespace

ContactSurface::ContactSurface(const ContactSearchParams& search, const ContactModel& model, ContactState& contact)
    : model_(model),
      contact_(contact),
      clusters_(model.mesh, model.topology),
      carries_(carrying_faces(search, model)),
      first_point_(carries_.size(), {-1, -1, -1, -1}),
      any_law_(std::any_of(model.params.laws.begin(), model.params.laws.end(),
                           [](const ContactLaw& law) { return law.active(); })) {
  const auto groups = model.mesh.volume_groups.size();
  DEMAND(search.breakable.size() == groups && model.params.laws.size() == groups * groups &&
             at(model.params.num_groups) == groups,
         std::to_string(groups) + " volume groups");
}

double ContactSurface::choose_contactors(const ContactSearchParams& search) {
  const auto& [params, mesh, topology, local] = model_;
  const std::vector<double> distance = nodal_surface_distance(mesh, topology);
  const std::vector<bool> between = nodes_between_groups(mesh);
  std::vector<Index> slots;
  double volume = 0;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& nodes = mesh.elements[at(e)];
    const bool exposed =
        search.breakable[at(mesh.element_group[at(e)])] ||
        std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return distance[at(n)] == 0 || between[at(n)]; });
    if (!exposed) continue;
    slots.push_back(model_.slot_of(e));
    volume += local.volume[at(slots.back())];
  }
  const auto number = static_cast<double>(slots.size());
  set_contactors(local, std::move(slots), contact_);
  build_field(params, local, distance, contact_);
  return number > 0 ? std::cbrt(6 * std::sqrt(2.0) * volume / number) : 0;
}

void ContactSurface::add_free_points() {
  for (Index e = 0; e < model_.mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (model_.topology.links[at(e)][at(f)].free()) add_points(e, f);
    }
  }
}

void ContactSurface::add_points(Index element, int face) {
  if ((carries_[at(element)] >> face & 1) == 0) return;
  first_point_[at(element)][at(face)] = static_cast<Index>(contact_.points.size());
  add_face_points(model_.params, model_.local, model_.slot_of(element), face, contact_);
}

void ContactSurface::break_faces(std::span<const Topology::Face> sides, std::vector<Index>& changed) {
  clusters_.break_faces(sides, changed);
}

bool ContactSurface::has_law(Index slot, Index other) const {
  const auto group_of = [&](Index s) { return model_.local.block_group[at(s / kLanes)]; };
  return model_.params.law(group_of(slot), group_of(other)).active();
}

bool ContactSurface::may_touch(Index point, Index contactor) const {
  const Index slot = contact_.points[at(point)].slot, other = contact_.contactors[at(contactor)];
  const std::vector<Index>& element = model_.local.mesh_element;
  return has_law(slot, other) && !clusters_.bonded(element[at(slot)], element[at(other)]);
}

}  // namespace breccia
