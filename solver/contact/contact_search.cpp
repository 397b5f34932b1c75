#include "contact/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "contact/cell_marks.hpp"
#include "mesh/point_distance.hpp"
#include "physics/contact/contact_couples.hpp"
#include "physics/contact/contact_field.hpp"

namespace breccia {

namespace {

constexpr double kSmallestBuffer = 0.1, kLargestBuffer = 0.4;  ///< shares of the mean size, see the class comment
constexpr double kBufferSteps = 20;                            ///< steps that a chosen buffer should last for

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Index group_of(const LocalMesh& local, Index slot) { return local.block_group[at(slot / kLanes)]; }

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

}  // namespace

double largest_buffer(double asked, double contactor_size) {
  return asked > 0 ? asked : kLargestBuffer * contactor_size;
}

ContactSearch::ContactSearch(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
                             const Topology& topology, const LocalMesh& local, ContactState& contact)
    : ContactSearch(search, params, mesh, topology, local, contact, nullptr) {
  choose_contactors();
  add_free_points();
  sort_points(contact_);
}

/// What needs no history: who may carry points.
ContactSearch::ContactSearch(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
                             const Topology& topology, const LocalMesh& local, ContactState& contact, std::nullptr_t)
    : search_(search),
      params_(&params),
      mesh_(&mesh),
      topology_(&topology),
      local_(&local),
      clusters_(mesh, topology),
      contact_(contact),
      detection_(detection::make_search(search.algorithm, search.cell)),
      carries_(at(mesh.num_elements()), search.everywhere ? 0xF : 0),
      first_point_(at(mesh.num_elements()), {-1, -1, -1, -1}) {
  const auto groups = mesh.volume_groups.size();
  DEMAND(search.breakable.size() == groups && params.laws.size() == groups * groups && at(params.num_groups) == groups,
         std::to_string(groups) + " volume groups");
  any_law_ = std::any_of(params.laws.begin(), params.laws.end(), [](const ContactLaw& law) { return law.active(); });
  for (const Topology::Face& face : search.faces) {
    carries_[at(face.element)] |= static_cast<std::uint8_t>(1 << face.face);
    const FaceLink& link = topology.links[at(face.element)][at(face.face)];
    if (link.inner()) carries_[at(link.neighbour)] |= static_cast<std::uint8_t>(1 << link.face());
  }
}

void ContactSearch::add_free_points() {
  for (Index e = 0; e < mesh_->num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (topology_->links[at(e)][at(f)].free()) add_points_of(e, f);
    }
  }
}

void ContactSearch::choose_contactors() {
  const std::vector<double> distance = nodal_surface_distance(*mesh_, *topology_);
  const std::vector<bool> between = nodes_between_groups(*mesh_);
  std::vector<Index> slots;
  double volume = 0;
  for (Index e = 0; e < mesh_->num_elements(); ++e) {
    const auto& nodes = mesh_->elements[at(e)];
    const bool exposed =
        search_.breakable[at(mesh_->element_group[at(e)])] ||
        std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return distance[at(n)] == 0 || between[at(n)]; });
    if (!exposed) continue;
    slots.push_back(local_->slot_of_element[at(e)]);
    volume += local_->volume[at(slots.back())];
  }
  size_ = slots.empty() ? 0 : std::cbrt(6 * std::sqrt(2.0) * volume / static_cast<double>(slots.size()));
  set_contactors(*local_, std::move(slots), contact_);
  build_field(*params_, *local_, distance, contact_);
}

void ContactSearch::add_points_of(Index element, int face) {
  if ((carries_[at(element)] >> face & 1) == 0) return;
  first_point_[at(element)][at(face)] = static_cast<Index>(contact_.points.size());
  add_face_points(*params_, *local_, local_->slot_of_element[at(element)], face, contact_);
}

bool ContactSearch::has_law(Index slot, Index other) const {
  return params_->law(group_of(*local_, slot), group_of(*local_, other)).active();
}

bool ContactSearch::may_touch(Index point, Index contactor) const {
  const Index slot = contact_.points[at(point)].slot, other = contact_.contactors[at(contactor)];
  return has_law(slot, other) && !clusters_.bonded(local_->mesh_element[at(slot)], local_->mesh_element[at(other)]);
}

void ContactSearch::update(const NodalState& state, double max_speed, double dt) {
  if (due(state, max_speed * dt, {})) search(state, max_speed * dt);
  verify(state);
}

bool ContactSearch::due(const NodalState& state, double step_length, const Communicator& communicator) {
  if (!any_law_) return false;
  if (!searched_) return true;
  moved_.step(step_length);
  return moved_.used_up(0.5 * buffer_, 0, *local_, state.position, reference_, communicator);
}

double ContactSearch::used_up(const NodalState& state, const Communicator& communicator) const {
  return std::min(1.0, relative_displacement(*local_, state.position, reference_, communicator) / (0.5 * buffer_));
}

double ContactSearch::buffer_for(double step_length) const {
  const double largest = largest_buffer(search_.buffer, size_);
  return search_.buffer > 0 ? largest : std::clamp(2 * kBufferSteps * step_length, kSmallestBuffer * size_, largest);
}

void ContactSearch::search(const NodalState& state, double step_length, std::span<const std::uint8_t> current) {
  buffer_ = buffer_for(step_length);
  reference_ = state.position;
  detection::Corners far;
  far.fill(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  corners_.clear();
  for (const Index slot : contact_.contactors) {
    corners_.push_back(current.empty() || current[at(slot)] != 0 ? load_corners(*local_, reference_.data(), slot)
                                                                 : far);
  }
  choose_searched(current);
  positions_.clear();
  const FaceRule& rule = face_rule(params_->points_per_face);
  for (const Index p : searched_points_)
    positions_.push_back(at_point(rule, contact_.points[at(p)], reference_.data()));

  detection_->search(positions_, searched_corners_, buffer_, found_);
  contact_.couples.clear();
  for (const detection::Couple& c : found_) {
    const Index point = searched_points_[at(c.point)], contactor = searched_contactors_[at(c.contactor)];
    if (may_touch(point, contactor)) contact_.couples.push_back({point, contactor});
  }
  if (!contact_.relevant.empty()) {
    all_couples_ = contact_.couples;
    made_since_.clear();
    keep_relevant();
  }
  couples_replaced(contact_);
  searched_ = true;
  grid_built_ = false;
  moved_.restart();
  ++num_searches_;
}

Extent ContactSearch::extent(const Field<double>& position) const {
  Extent extent;
  for (Index s = 0; s < local_->num_slots; ++s) {
    if (!contact_.matters(s)) continue;
    for (const Vec3& x : load_corners(*local_, position.data(), s)) extent.add(x);
  }
  return extent;
}

detection::Corners ContactSearch::corners_of(Index slot) const {
  const Index contactor = contact_.contactor_of_slot[at(slot)];
  return contactor >= 0 ? corners_[at(contactor)] : load_corners(*local_, reference_.data(), slot);
}

/// All points and contactors of elements that matter, and what may be in couples with these.
void ContactSearch::choose_searched(std::span<const std::uint8_t> current) {
  if (contact_.relevant.empty()) {
    searched_points_ = contact_.order;
    searched_contactors_.resize(contact_.contactors.size());
    std::iota(searched_contactors_.begin(), searched_contactors_.end(), 0);
    searched_corners_ = corners_;
    return;
  }
  choose_foreign(current);
  searched_contactors_.clear();
  searched_corners_.clear();
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Index slot = contact_.contactors[c];
    if (!contact_.matters(slot) && foreign_[at(slot)] == 0) continue;
    searched_contactors_.push_back(static_cast<Index>(c));
    searched_corners_.push_back(corners_[c]);
  }
  searched_points_.clear();
  for (const Index p : contact_.order) {
    const Index slot = contact_.points[at(p)].slot;
    if (contact_.matters(slot) || foreign_[at(slot)] > 1) searched_points_.push_back(p);
  }
}

/// Elements that do not matter by themselves: 2 if their points may be in a couple with one that does, no further than
/// the buffer from it, 1 if they may be in a couple with such a point, no further than twice the buffer.
void ContactSearch::choose_foreign(std::span<const std::uint8_t> current) {
  const std::size_t slots = at(local_->num_slots);
  foreign_.assign(slots, 0);
  extents_.resize(slots);
  Extent ours, region;
  for (Index s = 0; s < local_->num_slots; ++s) {
    if (!contact_.matters(s)) continue;
    extents_[at(s)] = extent_of(corners_of(s));
    ours.add(extents_[at(s)]);
  }
  for (Index s = 0; s < local_->num_slots; ++s) {
    if (contact_.matters(s) || local_->element_of_slot[at(s)] < 0 || (!current.empty() && current[at(s)] == 0))
      continue;
    extents_[at(s)] = extent_of(corners_of(s));
    if (!extents_[at(s)].near(ours, kContactorReach * buffer_)) continue;
    foreign_[at(s)] = 1;
    region.add(extents_[at(s)]);
  }
  const double cell = std::max(size_, buffer_);
  CellMarks near(region, cell), nearest(region, cell);
  for (Index s = 0; s < local_->num_slots; ++s) {
    if (!contact_.matters(s) || !extents_[at(s)].near(region, kContactorReach * buffer_)) continue;
    near.mark(extents_[at(s)], kContactorReach * buffer_);
    nearest.mark(extents_[at(s)], kPointReach * buffer_);
  }
  for (std::size_t s = 0; s < slots; ++s) {
    if (foreign_[s] != 0) foreign_[s] = nearest.any(extents_[s]) ? 2 : near.any(extents_[s]) ? 1 : 0;
  }
}

void ContactSearch::verify(const NodalState& state) const {
  if (!search_.verify) return;
  const FaceRule& rule = face_rule(params_->points_per_face);
  for (std::size_t c = 0; c < contact_.contactors.size(); ++c) {
    const Index slot = contact_.contactors[c];
    const auto contactor = static_cast<Index>(c);
    const PreparedTetra tetra = prepare(load_corners(*local_, state.position.data(), slot), local_->volume[at(slot)]);
    for (const Index p : contact_.order) {
      if (!inside(barycentric(tetra, at_point(rule, contact_.points[at(p)], state.position.data())))) continue;
      if (!may_touch(p, contactor)) continue;
      if (!contact_.matters(contact_.points[at(p)].slot) && !contact_.matters(slot)) continue;
      const bool known =
          std::binary_search(contact_.couples.begin(), contact_.couples.end(), ContactCouple{p, contactor},
                             [&](const ContactCouple& a, const ContactCouple& b) { return contact_.before(a, b); });
      DEMAND(known, "contact point " + std::to_string(contact_.id(p)) + " of element " +
                        std::to_string(contact_.id(p) / 24) + " touches element " +
                        std::to_string(local_->element_of_slot[at(slot)]) + " but they are no couple");
    }
  }
}

}  // namespace breccia
