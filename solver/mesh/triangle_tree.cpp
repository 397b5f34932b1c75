#include "mesh/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/index.hpp"

namespace breccia {
namespace {

constexpr Index kLeaf = 4;

double squared_distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - a - share * along).squaredNorm();
}

double squared_distance(const Vec3& point, const Triangle& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double normal2 = normal.squaredNorm();
  if (normal2 > 0) {
    bool above = true;  // the projection lies inside: on the inner side of the three edges
    for (std::size_t i = 0; i < 3 && above; ++i) {
      const Vec3 edge = t[(i + 1) % 3] - t[i];
      above = normal.cross(edge).dot(point - t[i]) >= 0;
    }
    if (above) {
      const double height = normal.dot(point - t[0]);
      return height * height / normal2;
    }
  }
  return std::min({squared_distance_to_segment(point, t[0], t[1]), squared_distance_to_segment(point, t[1], t[2]),
                   squared_distance_to_segment(point, t[2], t[0])});
}

double squared_distance_to_box(const Vec3& point, const Vec3& lower, const Vec3& upper) {
  return (lower - point).cwiseMax(point - upper).cwiseMax(0.0).squaredNorm();
}

double centre(const Triangle& t, int axis) { return t[0][axis] + t[1][axis] + t[2][axis]; }

}  // namespace

double point_triangle_distance(const Vec3& point, const Triangle& triangle) {
  return std::sqrt(squared_distance(point, triangle));
}

Vec3 nearest_on_triangle(const Vec3& point, const Triangle& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double normal2 = normal.squaredNorm();
  const Vec3 foot = normal2 > 0 ? Vec3(point - normal.dot(point - t[0]) / normal2 * normal) : point;
  bool inside = normal2 > 0;
  Vec3 nearest = t[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], edge = t[(i + 1) % 3] - a;
    inside = inside && normal.cross(edge).dot(foot - a) >= 0;
    const double length2 = edge.squaredNorm();
    const double share = length2 > 0 ? (point - a).dot(edge) / length2 : 0.0;
    const Vec3 on_edge = a + std::clamp(share, 0.0, 1.0) * edge;
    if ((on_edge - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = on_edge;
  }
  return inside ? foot : nearest;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  build(0, static_cast<Index>(triangles_.size()));
}

Index TriangleTree::build(Index first, Index count) {
  const Index self = static_cast<Index>(nodes_.size());
  Node node{Vec3::Constant(std::numeric_limits<double>::max()), Vec3::Constant(std::numeric_limits<double>::lowest()),
            first, count, -1};
  for (Index i = first; i < first + count; ++i) {
    for (const Vec3& corner : triangles_[at(i)]) {
      node.lower = node.lower.cwiseMin(corner);
      node.upper = node.upper.cwiseMax(corner);
    }
  }
  nodes_.push_back(node);
  if (count <= kLeaf) return self;

  int axis = 0;
  (node.upper - node.lower).maxCoeff(&axis);
  const Index half = count / 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](const Triangle& a, const Triangle& b) { return centre(a, axis) < centre(b, axis); });
  build(first, half);
  const Index second = build(first + half, count - half);
  nodes_[at(self)].count = 0;
  nodes_[at(self)].second = second;
  return self;
}

double TriangleTree::distance(const Vec3& point, double limit,
                              const std::function<bool(const Triangle&, double)>& counts) const {
  if (nodes_.empty()) return limit;
  double best2 = limit * limit;
  bool found = false;
  std::array<Index, 64> pending{};  // the tree halves at each level: 2^31 triangles need 31
  std::size_t depth = 0;
  pending[depth++] = 0;
  while (depth > 0) {
    const Index number = pending[--depth];
    const Node& node = nodes_[at(number)];
    if (squared_distance_to_box(point, node.lower, node.upper) >= best2) continue;
    if (node.count > 0) {
      for (Index i = node.first; i < node.first + node.count; ++i) {
        const double d2 = squared_distance(point, triangles_[at(i)]);
        if (d2 < best2 && counts(triangles_[at(i)], std::sqrt(d2))) best2 = d2, found = true;
      }
      continue;
    }
    Index near = number + 1, far = node.second;
    const auto box_distance = [&](Index n) {
      return squared_distance_to_box(point, nodes_[at(n)].lower, nodes_[at(n)].upper);
    };
    if (box_distance(far) < box_distance(near)) std::swap(near, far);
    pending[depth++] = far;  // the nearer child is visited first and prunes the other
    pending[depth++] = near;
  }
  return found ? std::sqrt(best2) : limit;
}

}  // namespace breccia
