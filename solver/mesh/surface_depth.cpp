#include "mesh/surface_depth.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/free_faces.hpp"
#include "mesh/geometry.hpp"
#include "mesh/point_distance.hpp"

namespace breccia {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Free faces around every node, as rows of one array.
class FacesAtNodes {
 public:
  explicit FacesAtNodes(const Mesh& mesh, const std::vector<FreeFace>& faces) : first_(mesh.nodes.size() + 1, 0) {
    for (const FreeFace& face : faces) {
      for (const Index node : face) ++first_[at(node) + 1];
    }
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    faces_.resize(at(first_.back()));
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (const Index node : faces[f]) faces_[at(next[at(node)]++)] = static_cast<Index>(f);
    }
  }
  [[nodiscard]] std::span<const Index> at_node(Index node) const {
    return std::span(faces_).subspan(at(first_[at(node)]), at(first_[at(node) + 1] - first_[at(node)]));
  }

 private:
  std::vector<Index> first_, faces_;
};

CornerSets sets_of(const std::array<Index, 4>& corners, const std::vector<FreeFace>& faces,
                   const FacesAtNodes& around) {
  CornerSets sets = 0;
  for (const Index corner : corners) {
    for (const Index f : around.at_node(corner)) {
      const FreeFace& nodes = faces[at(f)];
      unsigned set = 0;
      for (unsigned c = 0; c < 4; ++c) {
        if (std::find(nodes.begin(), nodes.end(), corners[c]) != nodes.end()) set |= 1U << c;
      }
      sets |= 1 << set;
    }
  }
  return largest_sets(sets);
}

/// Least height above an opposite free face, and longest edge, of the nodes on the surface; others: 0.
std::vector<double> behind_nodes(const Mesh& mesh, const Topology& topology, const std::vector<std::uint8_t>& on) {
  std::vector<double> longest(mesh.nodes.size(), 0.0), height(mesh.nodes.size(), std::numeric_limits<double>::max());
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto& corners = mesh.elements[at(e)];
    if (std::none_of(corners.begin(), corners.end(), [&](Index n) { return on[at(n)] != 0; })) continue;
    const auto x = geometry::corners_of(mesh, e);
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 0; k < 4; ++k)
        longest[at(corners[c])] = std::max(longest[at(corners[c])], (x[c] - x[k]).norm());
      if (!topology.links[at(e)][c].free()) continue;
      height[at(corners[c])] = std::min(height[at(corners[c])], geometry::height(x, static_cast<int>(c)));
    }
  }
  for (std::size_t n = 0; n < longest.size(); ++n) longest[n] = on[n] != 0 ? std::min(longest[n], height[n]) : 0.0;
  return longest;
}

}  // namespace

SurfaceDepth surface_depth(const Mesh& mesh, const Topology& topology) {
  constexpr double kBehind = 0.5;  // of the distance: a face seen at less than 30 degrees goes on beside the node
  SurfaceDepth result{std::vector<std::uint8_t>(mesh.nodes.size(), 0), nodal_surface_distance(mesh, topology), {}};
  const std::vector<FreeFace> faces = free_faces(mesh, topology);
  for (const FreeFace& face : faces) {
    for (const Index node : face) result.on_surface[at(node)] = 1;
  }
  const FacesAtNodes around(mesh, faces);
  result.sets.reserve(mesh.elements.size());
  for (const auto& corners : mesh.elements) result.sets.push_back(sets_of(corners, faces, around));

  const std::vector<double> reach = behind_nodes(mesh, topology, result.on_surface);
  std::vector<Index> nodes;
  for (Index n = 0; n < mesh.num_nodes(); ++n) {
    if (result.on_surface[at(n)] != 0) nodes.push_back(n);
  }
  for_each_with_tree(mesh, faces, std::move(nodes), [&](Index node, const TriangleTree& tree) {
    const Vec3& x = mesh.nodes[at(node)];
    result.depth[at(node)] = tree.distance(x, reach[at(node)], [&](const Triangle& t, double distance) {
      if (t[0] == x || t[1] == x || t[2] == x) return false;
      const Vec3 across = (t[1] - t[0]).cross(t[2] - t[0]);
      return (t[0] - x).dot(across) >= kBehind * distance * across.norm();
    });
  });
  return result;
}

}  // namespace breccia
