#include "mesh/point_distance.hpp"

#include <algorithm>
#include <limits>

#include "base/disjoint_sets.hpp"
#include "mesh/geometry.hpp"
#include "mesh/triangle_tree.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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

std::array<Index, 3> face_nodes(const Mesh& mesh, const Topology::Face& face) {
  const auto& corners = mesh.elements[at(face.element)];
  const auto& f = kFaceCorners[at(face.face)];
  return {corners[at(f[0])], corners[at(f[1])], corners[at(f[2])]};
}

std::vector<Topology::Face> free_faces(const Mesh& mesh, const Topology& topology,
                                       std::span<const Topology::Face> also_free) {
  std::vector<Topology::Face> faces(also_free.begin(), also_free.end());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (topology.links[at(e)][at(f)].free()) faces.push_back({e, f});
    }
  }
  return faces;
}

/// Exact distances of `wanted` nodes, grouped by solid so that each solid's tree is built once and only if asked for.
void find_exact(const Mesh& mesh, const std::vector<Topology::Face>& faces, const std::vector<Index>& solid,
                std::vector<Index> wanted, std::vector<double>& distance) {
  const auto by_solid = [&](Index a, Index b) { return std::pair{solid[at(a)], a} < std::pair{solid[at(b)], b}; };
  std::sort(wanted.begin(), wanted.end(), by_solid);
  std::vector<std::pair<Index, std::size_t>> surface(faces.size());  // (solid, face)
  for (std::size_t f = 0; f < faces.size(); ++f) surface[f] = {solid[at(face_nodes(mesh, faces[f])[0])], f};
  std::sort(surface.begin(), surface.end());

  for (std::size_t first = 0; first < wanted.size();) {
    const Index current = solid[at(wanted[first])];
    std::vector<Triangle> triangles;
    for (auto s = std::lower_bound(surface.begin(), surface.end(), std::pair{current, std::size_t{0}});
         s != surface.end() && s->first == current; ++s) {
      const auto nodes = face_nodes(mesh, faces[s->second]);
      triangles.push_back({mesh.nodes[at(nodes[0])], mesh.nodes[at(nodes[1])], mesh.nodes[at(nodes[2])]});
    }
    const TriangleTree tree(std::move(triangles));
    for (; first < wanted.size() && solid[at(wanted[first])] == current; ++first) {
      const Index node = wanted[first];
      distance[at(node)] = tree.distance(mesh.nodes[at(node)], std::numeric_limits<double>::infinity());
    }
  }
}

}  // namespace

std::vector<double> nodal_surface_distance(const Mesh& mesh, const Topology& topology,
                                           std::span<const Topology::Face> also_free) {
  const std::vector<Topology::Face> faces = free_faces(mesh, topology, also_free);
  std::vector<char> on_surface(mesh.nodes.size(), 0), near_surface(mesh.nodes.size(), 0);
  for (const auto& face : faces) {
    for (const Index node : face_nodes(mesh, face)) on_surface[at(node)] = 1;
  }

  std::vector<double> distance(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& corners = mesh.elements[at(e)];
    const auto x = geometry::corners_of(mesh, e);
    const double volume3 = 3.0 * geometry::tetra_volume(x[0], x[1], x[2], x[3]);
    const bool touches = std::any_of(corners.begin(), corners.end(), [&](Index n) { return on_surface[at(n)] != 0; });
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& f = kFaceCorners[c];
      const double height = volume3 / geometry::triangle_area(x[at(f[0])], x[at(f[1])], x[at(f[2])]);
      double& bound = distance[at(corners[c])];
      bound = std::min(bound, height);
      if (touches) near_surface[at(corners[c])] = 1;
    }
  }
  std::vector<Index> wanted;
  for (Index node = 0; node < mesh.num_nodes(); ++node) {
    if (on_surface[at(node)] != 0) {
      distance[at(node)] = 0;
    } else if (near_surface[at(node)] != 0) {
      wanted.push_back(node);
    }
  }
  find_exact(mesh, faces, solids_of_nodes(mesh), std::move(wanted), distance);
  return distance;
}

}  // namespace breccia
