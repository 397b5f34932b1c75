#pragma once

#include <cstdint>
#include <vector>

#include "mesh/geometry.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace breccia {

/// An inner face, where a joint may sit.
struct JointFace {
  Index a;             ///< element of lower index: the side from which the face is described
  std::int8_t face_a;  ///< 0..3, face of a
  Index b;             ///< the element across, b > a
  std::int8_t code;    ///< FaceLink::code as seen from a
  double area;         ///< m2, reference
  double size;         ///< m, mean length of the three edges
};

/// Calls visit(face) for every inner face once, in the order of (a, face_a). Whether it carries a joint is for the
/// caller to choose by the groups or bodies of a and b. O(num_elements).
template <class Visit>
void for_each_joint_face(const Mesh& mesh, const Topology& topology, Visit&& visit) {
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    for (int f = 0; f < 4; ++f) {
      const FaceLink& link = topology.links[static_cast<std::size_t>(e)][static_cast<std::size_t>(f)];
      if (link.neighbour <= e) continue;  // free, or listed by the neighbour
      const auto& corners = kFaceCorners[static_cast<std::size_t>(f)];
      const Vec3& p = x[static_cast<std::size_t>(corners[0])];
      const Vec3& q = x[static_cast<std::size_t>(corners[1])];
      const Vec3& r = x[static_cast<std::size_t>(corners[2])];
      visit(JointFace{e, static_cast<std::int8_t>(f), link.neighbour, link.code, geometry::triangle_area(p, q, r),
                      ((q - p).norm() + (r - q).norm() + (p - r).norm()) / 3.0});
    }
  }
}

/// All of them. O(num_elements).
[[nodiscard]] std::vector<JointFace> find_joints(const Mesh& mesh, const Topology& topology);

}  // namespace breccia
