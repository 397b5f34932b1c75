#include "simulation/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "mesh/point_distance.hpp"
#include "physics/contact/contact_couples.hpp"
#include "physics/contact/contact_field.hpp"

namespace breccia {

namespace {

constexpr double kSmallestBuffer = 0.1, kLargestBuffer = 0.4;  ///< shares of the mean size, see the class comment
constexpr double kBufferSteps = 20;                            ///< steps that a chosen buffer should last for
/// A search is done when the nodes have really used up this share of their allowance; else the bound is brought down.
constexpr double kUsedUp = 0.75;

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

ContactSearch::ContactSearch(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
                             const Topology& topology, const LocalMesh& local)
    : ContactSearch(search, params, mesh, topology, local, nullptr) {
  choose_contactors();
  add_free_points();
  sort_points(contact_);
}

/// What needs no history: who may carry points.
ContactSearch::ContactSearch(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
                             const Topology& topology, const LocalMesh& local, std::nullptr_t)
    : search_(search),
      params_(&params),
      mesh_(&mesh),
      topology_(&topology),
      local_(&local),
      clusters_(mesh, topology),
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

void ContactSearch::update(const State& state, double max_speed, double dt) {
  if (due(state, max_speed, dt, {})) search(state, max_speed * dt);
  verify(state);
}

bool ContactSearch::due(const State& state, double max_speed, double dt, const Communicator& communicator) {
  if (!any_law_) return false;
  moved_ += max_speed * dt;
  const double allowed = 0.5 * buffer_;
  if (!searched_) return true;
  if (moved_ <= allowed) return false;
  moved_ = communicator.max(largest_displacement(state));
  return !(moved_ <= kUsedUp * allowed);
}

double ContactSearch::largest_displacement(const State& state) const {
  const double* now = state.position.data();
  const double* then = reference_.data();
  double largest = 0;
  for (std::size_t block = 0; block < reference_.size(); block += 3 * kLanes) {
    for (std::size_t lane = block; lane < block + kLanes; ++lane) {
      if (local_->counted[block / 3 + (lane - block)] == 0) continue;
      const double x = now[lane] - then[lane], y = now[lane + 8] - then[lane + 8], z = now[lane + 16] - then[lane + 16];
      const double square = x * x + y * y + z * z;
      largest = square > largest ? square : largest;
    }
  }
  return std::sqrt(largest);
}

double ContactSearch::used_up(const State& state) const { return std::min(1.0, largest_displacement(state) / (0.5 * buffer_)); }

void ContactSearch::search(const State& state, double step_length) {
  buffer_ = search_.buffer > 0
                ? search_.buffer
                : std::clamp(2 * kBufferSteps * step_length, kSmallestBuffer * size_, kLargestBuffer * size_);
  reference_ = state.position;
  corners_.clear();
  for (const Index slot : contact_.contactors) corners_.push_back(load_corners(*local_, reference_.data(), slot));
  choose_searched();
  positions_.clear();
  const FaceRule& rule = face_rule(params_->points_per_face);
  for (const Index p : searched_points_) positions_.push_back(at_point(rule, contact_.points[at(p)], reference_.data()));

  detection_->search(positions_, searched_corners_, buffer_, found_);
  contact_.couples.clear();
  for (const detection::Couple& c : found_) {
    const Index point = searched_points_[at(c.point)], contactor = searched_contactors_[at(c.contactor)];
    if (may_touch(point, contactor)) contact_.couples.push_back({point, contactor});
  }
  if (!contact_.relevant.empty()) {
    all_couples_ = contact_.couples;
    keep_relevant();
  }
  couples_replaced(contact_);
  searched_ = true;
  grid_built_ = false;
  moved_ = 0;
  ++num_searches_;
}

namespace {

/// Box of positions.
struct Extent {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;

  void add(const Vec3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  [[nodiscard]] bool near(const Extent& other, double distance) const {
    return ((lower - other.upper).array() <= distance).all() && ((other.lower - upper).array() <= distance).all();
  }
};

Extent extent_of(const detection::Corners& corners) {
  Extent extent;
  for (const Vec3& x : corners) extent.add(x);
  return extent;
}

}  // namespace

/// Points that may be in a couple with an element that matters, no further than the buffer from the box around those elements,
/// and all contactors that may be in a couple with one of these points, no further than twice the buffer; and some more.
void ContactSearch::choose_searched() {
  if (contact_.relevant.empty()) {
    searched_points_ = contact_.order;
    searched_contactors_.resize(contact_.contactors.size());
    std::iota(searched_contactors_.begin(), searched_contactors_.end(), 0);
    searched_corners_ = corners_;
    return;
  }
  Extent ours;
  for (Index s = 0; s < local_->num_slots; ++s) {
    if (!contact_.matters(s)) continue;
    for (const Vec3& x : load_corners(*local_, reference_.data(), s)) ours.add(x);
  }
  searched_contactors_.clear();
  searched_corners_.clear();
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    if (!extent_of(corners_[c]).near(ours, 3 * buffer_)) continue;
    searched_contactors_.push_back(static_cast<Index>(c));
    searched_corners_.push_back(corners_[c]);
  }
  searched_points_.clear();
  const FaceRule& rule = face_rule(params_->points_per_face);
  for (const Index p : contact_.order) {
    Extent point;
    point.add(at_point(rule, contact_.points[at(p)], reference_.data()));
    if (point.near(ours, 1.5 * buffer_)) searched_points_.push_back(p);
  }
}

void ContactSearch::verify(const State& state) const {
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
