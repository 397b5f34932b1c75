#include "contact/contact_surface.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "contact/contactors.hpp"
#include "mesh/quality.hpp"
#include "model/plane.hpp"
#include "physics/contact/couples.hpp"
#include "physics/contact/geometry/field.hpp"

namespace breccia {

namespace {

/// A bit a face: it may carry points.
std::vector<std::uint8_t> carrying_faces(const ContactSearchParams& search, const ContactModel& model) {
  std::vector<std::uint8_t> carries(at(model.mesh.num_elements()), search.everywhere ? 0xF : 0);
  for (const Topology::Face& face : search.faces) {
    carries[at(face.element)] |= static_cast<std::uint8_t>(1 << face.face);
    const FaceLink& link = model.topology.links[at(face.element)][at(face.face)];
    if (link.inner()) carries[at(link.neighbour)] |= static_cast<std::uint8_t>(1 << link.face());
  }
  if (search.across < 0) return carries;
  for (Index e = 0; e < model.mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (on_side(model.mesh, e, f, search.across)) carries[at(e)] &= static_cast<std::uint8_t>(~(1U << f));
    }
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
      presses_(model.mesh.volume_groups.size(), false),
      pressed_(presses_) {
  const auto groups = model.mesh.volume_groups.size();
  DEMAND(search.breakable.size() == groups && model.params.laws.size() == groups * groups &&
             at(model.params.num_groups) == groups,
         std::to_string(groups) + " volume groups");
  for (std::size_t law = 0; law < model.params.laws.size(); ++law) {
    if (model.params.laws[law].active()) presses_[law / groups] = pressed_[law % groups] = true;
  }
  any_law_ = std::find(presses_.begin(), presses_.end(), true) != presses_.end();
}

double ContactSurface::choose_contactors(const ContactSearchParams& search) {
  const Contactors contactors =
      breccia::choose_contactors(search.breakable, model_.mesh, model_.topology, search.across);
  std::vector<Index> slots;
  for (Index e = 0; e < model_.mesh.num_elements(); ++e) {
    if (contactors.chosen[at(e)] != 0) slots.push_back(model_.slot_of(e));
  }
  set_contactors(model_.local, std::move(slots), contact_);
  contact_.body_length = mean_inradii(model_.mesh);
  contact_.body_extent = body_extents(model_.mesh);
  build_field(model_.params, model_.mesh, model_.local, contactors.surface, contact_);
  return contactors.size;
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
  return model_.params.law(static_cast<Index>(group_of(slot)), static_cast<Index>(group_of(other))).active();
}

bool ContactSurface::may_touch(Index point, Index contactor) const {
  const Index slot = contact_.points[at(point)].slot, other = contact_.contactors[at(contactor)];
  const std::vector<Index>& element = model_.local.mesh_element;
  return has_law(slot, other) && !clusters_.bonded(element[at(slot)], element[at(other)]);
}

}  // namespace breccia
