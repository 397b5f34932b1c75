#include "observe/free_faces.hpp"

#include "base/index.hpp"

namespace breccia {
namespace {}  // namespace

FreeFaces::FreeFaces(const Domain& domain) : domain_(domain), held_(at(domain.model.local.num_slots) * 4, 0) {
  for (const ActiveJoint& joint : domain.state.joints.active) {
    if (joint.state() == JointState::failed) continue;
    held_[at(joint.slot_a) * 4 + at(joint.face_a)] = 1;
    held_[at(joint.slot_b) * 4 + at(joint.code / 3)] = 1;
  }
}

bool FreeFaces::operator()(Index slot, int face) const {
  if (is_swept(domain_.model, domain_.derived, slot, face)) return false;  // nearly always
  if (domain_.derived.joint_at(slot, face) < 0) {
    const Index element = domain_.model.local.mesh_element[at(slot)];
    return !domain_.model.topology.links[at(element)][at(face)].inner();
  }
  return held_[at(slot) * 4 + at(face)] == 0;
}

std::vector<SurfaceFace> surface_faces(const Domain& domain) {
  const Model& model = domain.model;
  const auto link_of = [&](Index slot, int face) -> const FaceLink& {
    return model.topology.links[at(model.local.mesh_element[at(slot)])][at(face)];
  };
  const FreeFaces free(domain);
  std::vector<SurfaceFace> faces;
  Index original = 0;
  for (const Index slot : model.local.slot_of_element) {
    if (!model.local.is_original(slot)) continue;
    for (int face = 0; face < 4; ++face) {
      if (!free(slot, face)) continue;
      const bool broken_off = link_of(slot, face).neighbour == FaceLink::kBeyond;
      faces.push_back({slot, original, face, broken_off || domain.derived.joint_at(slot, face) >= 0});
    }
    ++original;
  }
  return faces;
}

}  // namespace breccia
