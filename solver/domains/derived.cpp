#include "domains/derived.hpp"

#include "base/index.hpp"
#include "physics/active_joint.hpp"

namespace breccia {
namespace {

std::vector<Index> blocked_corners(const LocalMesh& local) {
  std::vector<Index> blocked;
  blocked.reserve(local.shared_corners.size() * 4);
  for (std::size_t first = 0; first < local.shared_corners.size(); first += kLanes) {
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) blocked.push_back(local.shared_corners[first + lane][c]);
    }
  }
  return blocked;
}

std::vector<Index> joints_by_face(const Model& model) {
  const LocalMesh& local = model.local;
  std::vector<Index> joint_of_face(at(local.num_slots) * 4, -1);
  const auto note = [&](Index element, int face, std::size_t joint) {
    joint_of_face[at(local.slot_of_element[at(element)]) * 4 + at(face)] = static_cast<Index>(joint);
  };
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const JointFace& face = model.joints[j].face;
    note(face.a, face.face_a, j);
    note(face.b, face.code / 3, j);
  }
  return joint_of_face;
}

/// Originals, and elements that put forces on nodes of originals; with the blocks of shared-node elements among them.
void find_relevant(const LocalMesh& local, Derived& derived) {
  derived.relevant = local.original;
  for (Index s = local.num_own_slots; s < local.num_slots; ++s) {
    if (local.element_of_slot[at(s)] < 0) continue;
    for (int c = 0; c < 4; ++c) {
      if (local.corner_node(s, c) < local.num_moved_nodes) derived.relevant[at(s)] = 1;
    }
    const Index block = s / kLanes;
    if (derived.is_relevant(s) && (derived.shared_blocks.empty() || derived.shared_blocks.back() != block))
      derived.shared_blocks.push_back(block);
  }
}

/// As the sweep wants it.
std::vector<double> nodes_free_across(const Model& model) {
  std::vector<double> free;
  if (!model.plane) return free;
  const WholeModel& whole = model.whole;
  for (Index n = 0; n < model.local.num_nodes; ++n) {
    const double across = model.local.reference[nodal(n, model.plane->axis)];
    free.push_back(is_held_across(*model.plane, across, whole.lower_side, whole.longest_edge) ? 0.0 : 1.0);
  }
  return free;
}

}  // namespace

Derived derive(const Model& model) {
  Derived derived;
  derived.links = build_links(model);
  derived.joint_of_face = joints_by_face(model);
  derived.shared_corners = blocked_corners(model.local);
  for (Index n = 0; n < model.local.num_nodes; ++n) {
    if (model.local.node_id[at(n)] < 0) derived.padding_nodes.push_back(n);
  }
  derived.free_across = nodes_free_across(model);
  find_relevant(model.local, derived);
  return derived;
}

bool is_swept(const Model& model, const Derived& derived, Index slot, int face) {
  return slot < model.local.num_own_slots && JointLinks::code_of(derived.links.link[JointLinks::at(slot, face)]) < 12;
}

ActiveJoint new_active_joint(const Model& model, std::size_t index) {
  const ModelJoint& joint = model.joints[index];
  ActiveJoint active;
  active.id = model.joint_id(index);
  active.slot_a = model.local.slot_of_element[at(joint.face.a)];
  active.slot_b = model.local.slot_of_element[at(joint.face.b)];
  active.face_a = joint.face.face_a;
  active.code = joint.face.code;
  active.law = joint.law;
  active.history.area = joint.face.area;
  return active;
}

void plan_sweep_order(const Model& model, const StageLoads& loads, const std::vector<std::uint8_t>& sent,
                      Derived& derived) {
  std::vector<std::uint8_t> first = sent;
  const auto mark = [&](const std::vector<Index>& nodes) {
    for (const Index node : nodes) {
      if (node < model.local.num_own_nodes()) first[at(node / (4 * kLanes))] = 1;
    }
  };
  mark(loads.absorbing.nodes);
  for (const NodalConstraint& entry : loads.constraints) mark(entry.nodes);
  derived.ahead.clear();
  derived.rest.clear();
  const Index end = model.local.num_own_originals / kLanes;
  for (Index block = 0; block < end; ++block) {
    std::vector<BlockRun>& runs = first[at(block)] != 0 ? derived.ahead : derived.rest;
    const bool goes_on = !runs.empty() && runs.back().end == block && block - runs.back().first < kLongestRun;
    if (goes_on) {
      runs.back().end = block + 1;
    } else {
      runs.push_back({block, block + 1});
    }
  }
}

}  // namespace breccia
