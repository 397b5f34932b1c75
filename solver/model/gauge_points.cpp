#include "model/gauge_points.hpp"

#include <limits>

#include "base/index.hpp"
#include "base/number_text.hpp"
#include "case/problem_at.hpp"
#include "mesh/geometry.hpp"
#include "mesh/triangle_tree.hpp"

namespace breccia {
namespace {

using Corners = std::array<Vec3, 4>;

std::string text_of(const Vec3& place) {
  constexpr int kDigits = 9;  // finer than kOutside of any element
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

std::vector<Vec3> places_of(const std::vector<GaugePoint>& points) {
  std::vector<Vec3> places;
  for (const GaugePoint& point : points) places.push_back(point.place);
  return places;
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
  const std::vector<HoldingElement> found = holding_elements(mesh, places_of(points));
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
