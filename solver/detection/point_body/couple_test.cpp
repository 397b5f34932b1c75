#include "detection/point_body/couple_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "base/error.hpp"

namespace breccia::detection {

namespace {

bool all_finite(const Corners& corners) {
  for (const Vec3& corner : corners) {
    if (!(std::isfinite(corner[0]) && std::isfinite(corner[1]) && std::isfinite(corner[2]))) return false;
  }
  return true;
}

}  // namespace

CoupleTest::CoupleTest(const Corners& corners, double buffer) : origin_(corners[0]), skipped_(!all_finite(corners)) {
  if (skipped_) return;
  low_ = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3]));
  high_ = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3]));
  const double box_diagonal = (high_ - low_).norm();
  low_.array() -= buffer;
  high_.array() += buffer;
  set_planes(corners, buffer, box_diagonal);
}

void CoupleTest::set_planes(const Corners& corners, double buffer, double box_diagonal) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], e3 = corners[3] - corners[0];
  const Vec3 n1 = e3.cross(e2), n2 = e1.cross(e3), n3 = e2.cross(e1);
  const Vec3 n0 = (e2 - e1).cross(e3 - e1);
  const double six_volumes = -e1.dot(n1);
  has_planes_ = six_volumes > 0;
  if (!has_planes_) return;

  const double reach = (high_ - low_).norm();
  const double round_off = 32 * std::numeric_limits<double>::epsilon() * box_diagonal * box_diagonal * reach;
  const auto plane = [&](const Vec3& n, double offset) {
    return Plane{{n[0], n[1], n[2]}, offset + buffer * n.norm() + round_off};
  };
  planes_ = {plane(n0, n0.dot(e1)), plane(n1, 0), plane(n2, 0), plane(n3, 0)};
}

void demand_searchable(std::size_t num_points, std::size_t num_contactors, double buffer) {
  DEMAND(buffer >= 0 && std::isfinite(buffer), "contact search with buffer = " + std::to_string(buffer));
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<Index>::max());
  DEMAND(num_points < most && num_contactors < most, "contact search with " + std::to_string(num_points) +
                                                         " points and " + std::to_string(num_contactors) +
                                                         " contactors");
}

}  // namespace breccia::detection
