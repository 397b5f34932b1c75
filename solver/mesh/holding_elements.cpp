#include "mesh/holding_elements.hpp"

#include <algorithm>
#include <numeric>

#include "mesh/geometry.hpp"

namespace breccia {
namespace {

using Corners = std::array<Vec3, 4>;

/// Barycentric coordinates: each corner's share of the volume.
std::array<double, 4> weights_of(const Corners& x, const Vec3& point) {
  const double volume = geometry::tetra_volume(x[0], x[1], x[2], x[3]);
  std::array<double, 4> weights{};
  for (std::size_t c = 0; c < 4; ++c) {
    Corners part = x;
    part[c] = point;
    weights[c] = geometry::tetra_volume(part[0], part[1], part[2], part[3]) / volume;
  }
  return weights;
}

}  // namespace

std::vector<HoldingElement> holding_elements(const Mesh& mesh, std::span<const Vec3> points) {
  std::vector<HoldingElement> found(points.size());
  if (points.empty()) return found;
  std::vector<std::size_t> by_x(points.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(), [&](auto p, auto q) { return points[p][0] < points[q][0]; });
  for (Index e = 0; e < mesh.num_elements(); ++e) {  // by ascending id
    const Corners x = geometry::corners_of(mesh, e);
    const Vec3 margin = Vec3::Constant(kOutside * geometry::longest_edge(x));
    const Vec3 lower = x[0].cwiseMin(x[1]).cwiseMin(x[2]).cwiseMin(x[3]) - margin;
    const Vec3 upper = x[0].cwiseMax(x[1]).cwiseMax(x[2]).cwiseMax(x[3]) + margin;
    auto next = std::lower_bound(by_x.begin(), by_x.end(), lower[0],
                                 [&](std::size_t p, double least) { return points[p][0] < least; });
    for (; next != by_x.end() && points[*next][0] <= upper[0]; ++next) {
      const Vec3& point = points[*next];
      HoldingElement& holds = found[*next];
      if (holds.element >= 0 || (point - lower).minCoeff() < 0 || (upper - point).minCoeff() < 0) continue;
      const std::array<double, 4> weights = weights_of(x, point);
      if (*std::min_element(weights.begin(), weights.end()) >= -kOutside) holds = {e, weights};
    }
  }
  return found;
}

}  // namespace breccia
