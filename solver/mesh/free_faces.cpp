#include "mesh/free_faces.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"

namespace breccia {
namespace {

/// Solid of every node: the lowest body that its body is glued to. (num_nodes)
std::vector<Index> solids_of_nodes(const Mesh& mesh) {
  DisjointSets bodies(at(mesh.num_bodies));
  std::vector<Index> solid(mesh.nodes.size(), -1);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const Index body = mesh.element_body[at(e)];
    for (const Index node : mesh.elements[at(e)]) {
      Index& seen = solid[at(node)];
      if (seen < 0) seen = body;
      if (seen != body) bodies.join(seen, body);
    }
  }
  for (Index& s : solid) s = bodies.root(s);
  return solid;
}

}  // namespace

Vec3 normal_of(const Mesh& mesh, const FreeFace& face) {
  const Vec3 &a = mesh.nodes[at(face[0])], &b = mesh.nodes[at(face[1])], &c = mesh.nodes[at(face[2])];
  return (b - a).cross(c - a).normalized();
}

std::vector<FreeFace> free_faces(const Mesh& mesh, const Topology& topology) {
  std::vector<FreeFace> faces;
  const auto add = [&](Index element, std::size_t face) {
    const auto& corners = mesh.elements[at(element)];
    const auto& f = kFaceCorners[face];
    faces.push_back({corners[at(f[0])], corners[at(f[1])], corners[at(f[2])]});
  };
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (topology.links[at(e)][f].free()) add(e, f);
    }
  }
  return faces;
}

void for_each_with_tree(const Mesh& mesh, std::span<const FreeFace> faces, std::vector<Index> nodes,
                        const std::function<void(Index, const TriangleTree&)>& f) {
  const std::vector<Index> solid = solids_of_nodes(mesh);
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    return std::pair{solid[at(a)], a} < std::pair{solid[at(b)], b};
  });
  std::vector<std::pair<Index, std::size_t>> surface(faces.size());  // (solid, face)
  for (std::size_t k = 0; k < faces.size(); ++k) surface[k] = {solid[at(faces[k][0])], k};
  std::sort(surface.begin(), surface.end());
  for (std::size_t first = 0; first < nodes.size();) {
    const Index current = solid[at(nodes[first])];
    std::vector<Triangle> triangles;
    for (auto s = std::lower_bound(surface.begin(), surface.end(), std::pair{current, std::size_t{0}});
         s != surface.end() && s->first == current; ++s) {
      const FreeFace& face = faces[s->second];
      triangles.push_back({mesh.nodes[at(face[0])], mesh.nodes[at(face[1])], mesh.nodes[at(face[2])]});
    }
    const TriangleTree tree(std::move(triangles));
    for (; first < nodes.size() && solid[at(nodes[first])] == current; ++first) f(nodes[first], tree);
  }
}

}  // namespace breccia
