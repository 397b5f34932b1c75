#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace breccia {

/// Corners of a triangle, m.
using Triangle = std::array<Vec3, 3>;

/// Distance from a point to a triangle, its inside and border included, m. Exact but for round-off; a triangle without
/// area counts as its longest edge. O(1), throws nothing.
[[nodiscard]] double point_triangle_distance(const Vec3& point, const Triangle& triangle);

/// The place on a triangle, its inside and border included, that is nearest to a point, m. As above.
[[nodiscard]] Vec3 nearest_on_triangle(const Vec3& point, const Triangle& triangle);

/// Nearest triangle to a point: a binary tree of boxes over the triangles, split at the median of their centres along
/// the longest axis. Memory about 150 B a triangle.
class TriangleTree {
 public:
  /// O(n log n).
  explicit TriangleTree(std::vector<Triangle> triangles);

  /// Smallest distance to a triangle, m; `limit` where none is nearer than that. O(log n) where triangles are about as
  /// near as `limit`.
  [[nodiscard]] double distance(const Vec3& point, double limit) const {
    return distance(point, limit, [](const Triangle&, double) { return true; });
  }
  /// The same of those triangles for which counts(triangle, its distance, m) holds.
  [[nodiscard]] double distance(const Vec3& point, double limit,
                                const std::function<bool(const Triangle&, double)>& counts) const;

 private:
  struct Node {
    Vec3 lower, upper;
    Index first, count;  ///< triangles of a leaf; count 0: children are the next node and `second`
    Index second;
  };
  Index build(Index first, Index count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace breccia
