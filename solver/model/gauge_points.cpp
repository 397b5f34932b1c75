#include "model/gauge_points.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/index.hpp"
#include "base/number_text.hpp"
#include "case/problem_at.hpp"
#include "mesh/geometry.hpp"
#include "mesh/triangle_tree.hpp"

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

std::string text_of(const Vec3& place) {
  constexpr int kDigits = 9;  // less than kOutside of any element
  std::string text = "[";
  for (int axis = 0; axis < 3; ++axis)
    text += (axis > 0 ? ", \"" : "\"") + number_text(1e3 * place[axis], kDigits) + " mm\"";
  return text + "]";
}

}  // namespace

std::vector<GaugePoint> gauge_points(const case_::Case& input) {
  std::vector<GaugePoint> points;
  for (std::size_t g = 0; g < input.gauges.size(); ++g) {
    const case_::Gauge& gauge = input.gauges[g];
    switch (gauge.kind) {
      case case_::GaugeKind::point:
        points.push_back({g, "at", gauge.at});
        break;
      case case_::GaugeKind::line:
        for (int i = 0; i < gauge.points; ++i) {
          const double share = static_cast<double>(i) / (gauge.points - 1);
          const Vec3 place = i + 1 == gauge.points ? gauge.to : Vec3(gauge.from + share * (gauge.to - gauge.from));
          points.push_back({g, share < 0.5 ? "from" : "to", place});
        }
        break;
      case case_::GaugeKind::extensometer:
        points.push_back({g, "from", gauge.from});
        points.push_back({g, "to", gauge.to});
        break;
      case case_::GaugeKind::cracks:
        break;
    }
  }
  return points;
}

std::vector<HoldingElement> holding_elements(const Mesh& mesh, const std::vector<GaugePoint>& points) {
  std::vector<HoldingElement> found(points.size());
  if (points.empty()) return found;
  std::vector<std::size_t> by_x(points.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(), [&](auto p, auto q) { return points[p].place[0] < points[q].place[0]; });
  for (Index e = 0; e < mesh.num_elements(); ++e) {  // by ascending id
    const Corners x = geometry::corners_of(mesh, e);
    const Vec3 margin = Vec3::Constant(kOutside * geometry::longest_edge(x));
    const Vec3 lower = x[0].cwiseMin(x[1]).cwiseMin(x[2]).cwiseMin(x[3]) - margin;
    const Vec3 upper = x[0].cwiseMax(x[1]).cwiseMax(x[2]).cwiseMax(x[3]) + margin;
    auto next = std::lower_bound(by_x.begin(), by_x.end(), lower[0],
                                 [&](std::size_t p, double least) { return points[p].place[0] < least; });
    for (; next != by_x.end() && points[*next].place[0] <= upper[0]; ++next) {
      const Vec3& point = points[*next].place;
      HoldingElement& holds = found[*next];
      if (holds.element >= 0 || (point - lower).minCoeff() < 0 || (upper - point).minCoeff() < 0) continue;
      const std::array<double, 4> weights = weights_of(x, point);
      if (*std::min_element(weights.begin(), weights.end()) >= -kOutside) holds = {e, weights};
    }
  }
  return found;
}

Vec3 nearest_place(const Mesh& mesh, const Vec3& point) {
  Vec3 nearest = Vec3::Constant(std::numeric_limits<double>::infinity());
  double least = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const Corners x = geometry::corners_of(mesh, e);
    for (const auto& face : kFaceCorners) {
      const Vec3 place = nearest_on_triangle(point, {x[at(face[0])], x[at(face[1])], x[at(face[2])]});
      const double distance = (place - point).norm();
      if (distance < least) least = distance, nearest = place;
    }
  }
  return nearest;
}

Problem point_outside(const case_::Case& input, const GaugePoint& point, const Vec3& nearest) {
  const case_::Gauge& gauge = input.gauges[point.gauge];
  const bool is_end = point.place == gauge.from || point.place == gauge.to || gauge.kind == case_::GaugeKind::point;
  return case_::problem_at(
      input, gauge.origin, point.key,
      std::string(is_end ? "the point" : "a point of the line") + " lies outside of the model at rest",
      "the nearest place of the model is " + text_of(nearest), text_of(point.place));
}

std::vector<Problem> points_outside(const case_::Case& input, const Mesh& mesh) {
  const std::vector<GaugePoint> points = gauge_points(input);
  const std::vector<HoldingElement> found = holding_elements(mesh, points);
  std::vector<Problem> problems;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const bool is_new =
        problems.empty() || points[p].gauge != points[p - 1].gauge || points[p].key != points[p - 1].key;
    if (found[p].element < 0 && is_new)
      problems.push_back(point_outside(input, points[p], nearest_place(mesh, points[p].place)));
  }
  return problems;
}

}  // namespace breccia
