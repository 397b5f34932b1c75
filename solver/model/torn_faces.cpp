#include "model/torn_faces.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/contact/step/patch_tree.hpp"

namespace breccia {
namespace {

/// Faces of a body face each other when the line between their middles is so close to both normals (its cosine).
constexpr double kFacing = 0.8;

struct FreeFace {
  Index element;
  int face;
  Index body;
  Vec3 middle, normal;
};

/// @param boxes  out: around the faces, wide enough to overlap where two of equal size may face each other
std::vector<FreeFace> free_faces(const Mesh& mesh, const Topology& topology, std::vector<PatchTree::Box>& boxes) {
  std::vector<FreeFace> faces;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (!topology.links[at(e)][at(f)].free()) continue;
      std::array<Vec3, 3> x;
      for (std::size_t i = 0; i < 3; ++i)
        x[i] = mesh.nodes[at(mesh.elements[at(e)][static_cast<std::size_t>(kFaceCorners[at(f)][i])])];
      faces.push_back(
          {e, f, mesh.element_body[at(e)], (x[0] + x[1] + x[2]) / 3.0, (x[1] - x[0]).cross(x[2] - x[0]).normalized()});
      const double half = 0.5 * std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
      PatchTree::Box& box = boxes.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        box.low[k] = std::min({x[0][axis], x[1][axis], x[2][axis]}) - half;
        box.high[k] = std::max({x[0][axis], x[1][axis], x[2][axis]}) + half;
      }
    }
  }
  return faces;
}

bool look_at_each_other(const FreeFace& a, const FreeFace& b) {
  const Vec3 line = b.middle - a.middle;
  const double length = line.norm();
  return a.normal.dot(b.normal) < -0.5 && line.dot(a.normal) >= kFacing * length &&
         -line.dot(b.normal) >= kFacing * length;
}

}  // namespace

std::vector<std::uint8_t> torn_faces(const Mesh& mesh, const Topology& topology) {
  std::vector<std::uint8_t> torn(mesh.elements.size(), 0);
  std::vector<PatchTree::Box> boxes;
  const std::vector<FreeFace> faces = free_faces(mesh, topology, boxes);
  const PatchTree tree(boxes);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const FreeFace& face = faces[i];
    bool meets = false;
    tree.query(boxes[i], [&](std::int32_t other) {
      const FreeFace& there = faces[static_cast<std::size_t>(other)];
      meets = meets || (there.body == face.body && look_at_each_other(face, there));
    });
    if (meets) torn[at(face.element)] |= static_cast<std::uint8_t>(1U << face.face);
  }
  return torn;
}

}  // namespace breccia
