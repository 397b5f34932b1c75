#include "mesh/joints.hpp"

namespace breccia {

std::vector<JointFace> find_joints(const Mesh& mesh, const Topology& topology) {
  std::vector<JointFace> joints;
  joints.reserve(2 * mesh.elements.size());
  for_each_joint_face(mesh, topology, [&](const JointFace& face) { joints.push_back(face); });
  return joints;
}

}  // namespace breccia
