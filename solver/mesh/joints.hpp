#pragma once

#include <cstdint>
#include <vector>

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

/// Every inner face once, sorted by (a, face_a). Whether it carries a joint is for the caller to choose by the groups
/// or bodies of a and b. O(num_elements), throws nothing.
[[nodiscard]] std::vector<JointFace> find_joints(const Mesh& mesh, const Topology& topology);

}  // namespace breccia
