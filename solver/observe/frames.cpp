#include "observe/frames.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "observe/corner_values.hpp"
#include "observe/shown_memory.hpp"
#include "physics/cauchy_stress.hpp"
#include "physics/contact/geometry/overlap.hpp"

namespace breccia {
namespace {

Vec3 centroid(const LocalMesh& local, const double* field, Index slot) {
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < 4; ++c) sum += load_node(field, local.corner_node(slot, c));
  return 0.25 * sum;
}

/// Adds what elements remember to a part of the frame whose elements are there, in the order of `slots`.
void add_memory(const Domain& domain, const std::vector<Index>& slots, Frame::Elements& out) {
  for (const ShownNumber& number : shown_numbers(domain.model)) {
    std::vector<double>& values = out.state.emplace_back(Frame::StateField{number.name, 1, {}}).values;
    for (const Index slot : slots) values.push_back(number.of(domain, slot));
  }
}

/// What is known of an element, its points excepted.
void add_cell(const Domain& domain, const Fragments& fragments, Index slot, Frame::Elements& out) {
  const LocalMesh& local = domain.model.local;
  const double* x = domain.state.nodes.position.data();
  const double* v = domain.state.nodes.velocity.data();
  const Index group = local.block_group[at(slot / kLanes)];
  out.id.push_back(local.element_of_slot[at(slot)]);
  out.body.push_back(local.slot_body[at(slot)]);
  out.material.push_back(group);
  out.rank.push_back(domain.exchange.communicator().rank());
  out.fragment.push_back(fragments.of_slot[at(slot)]);
  const Mat3 stress =
      cauchy_stress(local, domain.model.elastic[at(group)], slot, x, v, material_memory(domain.state.elements));
  const auto six = components(stress);
  out.stress.insert(out.stress.end(), six.begin(), six.end());
  out.von_mises.push_back(von_mises(stress));
  append(out.principal, principal_stresses(stress));
  append(out.velocity, centroid(local, v, slot));
  append(out.displacement, centroid(local, x, slot) - centroid(local, local.reference.data(), slot));
}

/// Ids of the elements that are or were connected across the four faces.
void add_neighbours(const Model& model, Index slot, std::vector<std::int64_t>& out) {
  for (int face = 0; face < 4; ++face)
    out.push_back(neighbour_id(model.mesh, model.topology, model.local.mesh_element[at(slot)], face));
}

void add_elements(const Domain& domain, const Fragments& fragments, Frame::Elements& out) {
  const LocalMesh& local = domain.model.local;
  std::vector<Index> slots;
  for (const Index slot : local.slot_of_element) {
    if (!local.is_original(slot)) continue;
    for (int c = 0; c < 4; ++c)
      append(out.points, load_node(domain.state.nodes.position.data(), local.corner_node(slot, c)));
    add_cell(domain, fragments, slot, out);
    out.mass.push_back(domain.model.density[at(local.block_group[at(slot / kLanes)])] * local.volume[at(slot)]);
    add_neighbours(domain.model, slot, out.neighbour);
    slots.push_back(slot);
  }
  add_memory(domain, slots, out);
}

/// @param places  out: (3 faces) of the faces' corners, 4 original + corner
void add_surface(const Domain& domain, const FrameLabels& labels, Frame::Surface& out,
                 std::vector<std::size_t>& places) {
  const LocalMesh& local = domain.model.local;
  std::vector<Index> slots;
  for (const auto& [slot, original, face, crack] : labels.faces) {
    for (const int corner : kFaceCorners[at(face)]) {
      append(out.cells.points, load_node(domain.state.nodes.position.data(), local.corner_node(slot, corner)));
      places.push_back(4 * at(original) + at(corner));
    }
    add_cell(domain, labels.fragments, slot, out.cells);
    slots.push_back(slot);
    out.cells.cost.push_back(labels.cost[at(original)]);
    out.face.push_back(face);
    out.crack.push_back(crack ? 1 : 0);
  }
  add_memory(domain, slots, out.cells);
}

/// Corners of a box in the order of VTK's hexahedron: around the bottom, then around the top.
void append_box(std::vector<double>& points, const Vec3& lower, const Vec3& upper) {
  for (int top = 0; top < 2; ++top) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      append(points, {x == 0 ? lower[0] : upper[0], y == 0 ? lower[1] : upper[1], top == 0 ? lower[2] : upper[2]});
    }
  }
}

void add_domain(const Domain& domain, double load, Frame::Domain& out) {
  const LocalMesh& local = domain.model.local;
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  std::int64_t elements = 0;
  for (const Index slot : local.slot_of_element) {
    if (!local.is_original(slot)) continue;
    ++elements;
    for (int c = 0; c < 4; ++c) {
      const Vec3 x = load_node(domain.state.nodes.position.data(), local.corner_node(slot, c));
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  }
  if (elements == 0) return;
  append_box(out.points, lower, upper);
  out.rank.push_back(domain.exchange.communicator().rank());
  out.elements.push_back(elements);
  out.joints.push_back(static_cast<std::int64_t>(domain.state.joints.active.size()));
  out.couples.push_back(domain.contact ? static_cast<std::int64_t>(domain.state.contact.couples.size()) : 0);
  out.load.push_back(load);
}

/// Triangle on the face of a.
void add_released_joint(const Domain& domain, const ReleasedJoint& joint, Frame::Joints& out) {
  const LocalMesh& local = domain.model.local;
  for (const int corner : kFaceCorners[at(joint.face_a)]) {
    append(out.points, load_node(domain.state.nodes.position.data(), local.corner_node(joint.slot_a, corner)));
  }
  out.id.push_back(joint.id);
}

/// Triangle halfway between the two faces of a joint that has not failed.
void add_active_joint(const Domain& domain, const ActiveJoint& joint, Frame::Joints& out) {
  const LocalMesh& local = domain.model.local;
  const double* x = domain.state.nodes.position.data();
  for (int i = 0; i < 3; ++i) {
    const Vec3 on_a = load_node(x, local.corner_node(joint.slot_a, kFaceCorners[at(joint.face_a)][at(i)]));
    const Vec3 on_b = load_node(x, local.corner_node(joint.slot_b, matching_corner(joint.code, i)));
    append(out.points, Vec3(0.5 * (on_a + on_b)));
  }
  out.id.push_back(joint.id);
}

void add_joints(const Domain& domain, Frame::Joints& out) {
  std::vector<ReleasedJoint> released = domain.state.joints.released;
  std::sort(released.begin(), released.end(),
            [](const ReleasedJoint& p, const ReleasedJoint& q) { return p.id < q.id; });
  const auto add_released = [&](const ReleasedJoint& joint) {
    add_released_joint(domain, joint, out);
    out.damage.push_back(1.0);
    out.mode.push_back(static_cast<std::int32_t>(joint.mode));
    out.opening.push_back(joint.opening);
    out.slip.push_back(joint.slip);
    out.broken.push_back(1);
    out.time_of_failure.push_back(joint.time_of_failure);
    out.state.push_back(Frame::Joints::apart);
    out.energy.push_back(joint.dissipated);
  };
  auto next = released.begin();
  for (const ActiveJoint& joint : domain.state.joints.active) {
    for (; next != released.end() && next->id < joint.id; ++next) add_released(*next);
    const bool broken = joint.state() == JointState::failed;
    if ((joint.damage() <= 0 && !broken) || !domain.model.local.is_original(joint.slot_a)) continue;
    add_active_joint(domain, joint, out);
    out.damage.push_back(broken ? 1.0 : joint.damage());
    out.mode.push_back(static_cast<std::int32_t>(joint.mode()));
    out.opening.push_back(joint.opening());
    out.slip.push_back(joint.slip());
    out.broken.push_back(broken ? 1 : 0);
    out.time_of_failure.push_back(joint.time_of_failure);
    out.state.push_back(broken ? Frame::Joints::failed : Frame::Joints::softening);
    out.energy.push_back(joint.history.mode_1 + joint.history.mode_2);
  }
  for (; next != released.end(); ++next) add_released(*next);
}

/// How fast the point slides over the element that it touches: the part of its velocity against that place of the
/// element across the normal force.
Vec3 slip_velocity(const Domain& domain, const TouchingCouple& couple) {
  const LocalMesh& local = domain.model.local;
  const ContactState& contact = domain.state.contact;
  const FaceRule& rule = face_rule(domain.model.contact.points_per_face);
  const double *x = domain.state.nodes.position.data(), *v = domain.state.nodes.velocity.data();
  const ContactPoint& point = contact.points[at(couple.point)];
  const Index slot = contact.contactors[at(couple.contactor)];
  const auto lambda =
      barycentric(prepare(load_corners(local, x, slot), local.volume[at(slot)]), at_point(rule, point, x));
  Vec3 relative = at_point(rule, point, v);
  for (int c = 0; c < 4; ++c) relative -= lambda[at(c)] * load_node(v, local.corner_node(slot, c));
  const Vec3 normal = couple.history.force - couple.history.friction;
  const double square = normal.squaredNorm();
  if (!(square > 0)) return relative;
  return relative - relative.dot(normal) / square * normal;
}

/// Ids of couples fit into 64 bits.
constexpr GlobalId kMostElements = 600'000'000;

void add_contacts(const Domain& domain, Frame::Contacts& out) {
  if (!domain.contact) return;
  const LocalMesh& local = domain.model.local;
  const ContactState& contact = domain.state.contact;
  const FaceRule& rule = face_rule(domain.model.contact.points_per_face);
  const double* x = domain.state.nodes.position.data();
  const GlobalId elements = domain.model.whole.num_elements;
  DEMAND(elements < kMostElements, std::to_string(elements));
  for (const TouchingCouple& couple : contact.touching) {
    const ContactPoint& point = contact.points[at(couple.point)];
    if (couple.history.force.squaredNorm() == 0.0 || !local.is_original(point.slot)) continue;
    const Index other = contact.contactors[at(couple.contactor)];
    out.id.push_back(point.id * elements + local.element_of_slot[at(other)]);
    out.point.push_back(point.id);
    append(out.points, at_point(rule, point, x));
    append(out.force, couple.history.force);
    append(out.normal_force, couple.history.force - couple.history.friction);
    append(out.tangential_force, couple.history.friction);
    append(out.slip_velocity, slip_velocity(domain, couple));
    out.body.push_back(local.slot_body[at(point.slot)]);
    out.other_body.push_back(local.slot_body[at(other)]);
    out.other_element.push_back(local.element_of_slot[at(other)]);
  }
}

}  // namespace

Frame make_frame(const Domain& domain, std::int64_t number, const FrameParts& parts, const FrameLabels& labels) {
  Frame frame;
  frame.step = domain.state.clock.steps;
  frame.time = domain.state.clock.time;
  frame.number = number;
  if (parts.elements) {
    add_elements(domain, labels.fragments, frame.elements);
    frame.elements.cost = labels.cost;
  }
  std::vector<std::size_t> places;
  if (parts.surface) add_surface(domain, labels, frame.surface, places);
  if (parts.at_points) {
    Frame::AtPoints values = corner_values(domain);
    if (parts.surface) frame.surface.cells.at_points = picked(values, places);
    if (parts.elements) frame.elements.at_points = std::move(values);
  }
  if (parts.joints) add_joints(domain, frame.joints);
  if (parts.contacts) add_contacts(domain, frame.contacts);
  if (parts.domain) add_domain(domain, labels.load, frame.domain);
  return frame;
}

}  // namespace breccia
