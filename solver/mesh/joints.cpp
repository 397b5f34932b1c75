#include "mesh/joints.hpp"

#include "mesh/geometry.hpp"

namespace breccia {

std::vector<JointFace> find_joints(const Mesh& mesh, const Topology& topology) {
  std::vector<JointFace> joints;
  joints.reserve(2 * mesh.elements.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    for (std::int8_t f = 0; f < 4; ++f) {
      const FaceLink& link = topology.links[static_cast<std::size_t>(e)][static_cast<std::size_t>(f)];
      if (link.neighbour <= e) continue;  // free, or listed by the neighbour
      const auto& corners = kFaceCorners[static_cast<std::size_t>(f)];
      const Vec3& p = x[static_cast<std::size_t>(corners[0])];
      const Vec3& q = x[static_cast<std::size_t>(corners[1])];
      const Vec3& r = x[static_cast<std::size_t>(corners[2])];
      joints.push_back({e, f, link.neighbour, link.code, geometry::triangle_area(p, q, r),
                        ((q - p).norm() + (r - q).norm() + (p - r).norm()) / 3.0});
    }
  }
  return joints;
}

}  // namespace breccia
