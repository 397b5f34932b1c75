#include "mesh/point_distance.hpp"

#include <algorithm>
#include <limits>

#include "base/index.hpp"
#include "mesh/free_faces.hpp"
#include "mesh/geometry.hpp"

namespace breccia {
namespace {}  // namespace

std::vector<double> nodal_surface_distance(const Mesh& mesh, const Topology& topology) {
  const std::vector<FreeFace> faces = free_faces(mesh, topology);
  std::vector<char> on_surface(mesh.nodes.size(), 0), near_surface(mesh.nodes.size(), 0);
  for (const FreeFace& face : faces) {
    for (const Index node : face) on_surface[at(node)] = 1;
  }

  std::vector<double> distance(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& corners = mesh.elements[at(e)];
    const auto x = geometry::corners_of(mesh, e);
    const bool touches = std::any_of(corners.begin(), corners.end(), [&](Index n) { return on_surface[at(n)] != 0; });
    for (std::size_t c = 0; c < 4; ++c) {
      double& bound = distance[at(corners[c])];
      bound = std::min(bound, geometry::height(x, static_cast<int>(c)));
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
  for_each_with_tree(mesh, faces, std::move(wanted), [&](Index node, const TriangleTree& tree) {
    distance[at(node)] = tree.distance(mesh.nodes[at(node)], std::numeric_limits<double>::infinity());
  });
  return distance;
}

}  // namespace breccia
