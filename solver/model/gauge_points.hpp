#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"
#include "mesh/holding_elements.hpp"
#include "mesh/mesh.hpp"

namespace breccia {

/// A point of a [[gauge]], at rest.
struct GaugePoint {
  std::size_t gauge;  ///< of the case
  std::string key;    ///< "at", "from", "to": of the gauge
  Vec3 place;         ///< m
};

/// The points of all gauges of a case, in order: one of a point, those of a line from one end to the other, two of an
/// extensometer.
[[nodiscard]] std::vector<GaugePoint> gauge_points(const case_::Case& input);

[[nodiscard]] std::vector<Vec3> places_of(const std::vector<GaugePoint>& points);

/// The place of the mesh nearest to a point. O(elements)
[[nodiscard]] Vec3 nearest_place(const Mesh& mesh, const Vec3& point);

/// What is wrong with a point that no element holds.
[[nodiscard]] Problem point_outside(const case_::Case& input, const GaugePoint& point, const Vec3& nearest);

/// Every point of the case that is outside of the whole mesh.
[[nodiscard]] std::vector<Problem> points_outside(const case_::Case& input, const Mesh& mesh);

}  // namespace breccia
