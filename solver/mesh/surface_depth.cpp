#include "mesh/surface_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/index.hpp"
#include "mesh/faces_at_nodes.hpp"
#include "mesh/free_faces.hpp"
#include "mesh/geometry.hpp"
#include "mesh/point_distance.hpp"
#include "mesh/surface_planes.hpp"

namespace breccia {
namespace {

/// Mean normals of the nodes, faces weighted with their angles.
std::vector<Vec3> mean_normals(const Mesh& mesh, const std::vector<FreeFace>& faces) {
  std::vector<Vec3> sum(mesh.nodes.size(), Vec3::Zero());
  std::vector<double> angles(mesh.nodes.size(), 0.0);
  for (const FreeFace& face : faces) {
    const Vec3 normal = normal_of(mesh, face);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& corner = mesh.nodes[at(face[i])];
      const Vec3 a = mesh.nodes[at(face[(i + 1) % 3])] - corner, b = mesh.nodes[at(face[(i + 2) % 3])] - corner;
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      sum[at(face[i])] += angle * normal;
      angles[at(face[i])] += angle;
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n) {
    if (angles[n] > 0) sum[n] /= angles[n];
  }
  return sum;
}

/// Of a node's elements.
struct Around {
  double longest_edge = 0;                                   ///< m
  double least_height = std::numeric_limits<double>::max();  ///< m, of the node above the opposite faces
  double above_free = std::numeric_limits<double>::max();    ///< m, the same above opposite free faces
  bool breakable = false;                                    ///< any of them
};

std::vector<Around> around_nodes(const std::vector<bool>& breakable, const Mesh& mesh, const Topology& topology) {
  std::vector<Around> nodes(mesh.nodes.size());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    for (std::size_t c = 0; c < 4; ++c) {
      Around& node = nodes[at(mesh.elements[at(e)][c])];
      const double height = geometry::height(x, static_cast<int>(c));
      node.least_height = std::min(node.least_height, height);
      if (topology.links[at(e)][c].free()) node.above_free = std::min(node.above_free, height);
      for (const Vec3& other : x) node.longest_edge = std::max(node.longest_edge, (x[c] - other).norm());
      node.breakable = node.breakable || breakable[at(mesh.element_group[at(e)])];
    }
  }
  return nodes;
}

/// What lies behind a node on the surface, m.
double depth_behind(const Vec3& x, const Around& around, const TriangleTree& tree) {
  constexpr double kBehind = 0.5;     // of the distance: a face seen at less than 30 degrees continues beside the node
  constexpr double kRoundOff = 1e-9;  // an edge from side to side of a wall is as long as the wall is thick
  const double longest = (1 + kRoundOff) * around.longest_edge;
  const double reach = std::min(longest, around.above_free);
  const double opposite = tree.distance(x, reach, [&](const Triangle& t, double distance) {
    if (t[0] == x || t[1] == x || t[2] == x) return false;
    const Vec3 across = (t[1] - t[0]).cross(t[2] - t[0]);
    return (t[0] - x).dot(across) >= kBehind * distance * across.norm();
  });
  return opposite < longest ? opposite : around.least_height;
}

/// Nodes of what cannot break.
void set_distances(const Mesh& mesh, const Topology& topology, const std::vector<FreeFace>& faces,
                   const std::vector<Around>& around, SurfaceDepth& result) {
  const std::vector<double> distance = nodal_surface_distance(mesh, topology);
  std::vector<Index> on_surface;
  for (Index n = 0; n < mesh.num_nodes(); ++n) {
    if (around[at(n)].breakable) continue;
    if (result.on_surface[at(n)] != 0) on_surface.push_back(n);
    result.depth[at(n)] = distance[at(n)];
  }
  for_each_with_tree(mesh, faces, std::move(on_surface), [&](Index node, const TriangleTree& tree) {
    result.depth[at(node)] = depth_behind(mesh.nodes[at(node)], around[at(node)], tree);
  });
}

}  // namespace

SurfaceDepth surface_depth(const std::vector<bool>& breakable, const Mesh& mesh, const Topology& topology) {
  SurfaceDepth result{std::vector<std::uint8_t>(mesh.nodes.size(), 0), {}, {}, {}, {}};
  const std::vector<FreeFace> faces = free_faces(mesh, topology);
  for (const FreeFace& face : faces) {
    for (const Index node : face) result.on_surface[at(node)] = 1;
  }
  result.normal = mean_normals(mesh, faces);
  const FacesAtNodes faces_at(mesh, faces);
  const std::vector<Around> around = around_nodes(breakable, mesh, topology);
  result.depth.reserve(around.size());
  for (const Around& node : around) result.depth.push_back(node.least_height);
  if (std::any_of(around.begin(), around.end(), [](const Around& node) { return !node.breakable; }))
    set_distances(mesh, topology, faces, around, result);
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const SurfacePlanes planes = surface_planes(mesh, e, faces, faces_at, result.depth);
    SurfaceSides sides = with_planes(planes.count);
    for (std::size_t c = 0; c < 4; ++c) sides |= topology.links[at(e)][c].free() ? with_face(c) : 0;
    result.sides.push_back(sides);
    result.planes.push_back(planes.rows);
  }
  return result;
}

}  // namespace breccia
