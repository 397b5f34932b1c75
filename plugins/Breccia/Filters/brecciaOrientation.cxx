#include "brecciaOrientation.h"

#include <algorithm>
#include <cmath>

#include "brecciaSieve.h"
#include "vtkMath.h"

namespace breccia {

Orientation OrientationOf(const Vector& normal, int up) {
  const auto u = static_cast<std::size_t>(up);
  const double sense = normal[u] < 0 ? -1 : 1;
  const double east = sense * normal[(u + 1) % 3], north = sense * normal[(u + 2) % 3];
  const double dip = std::acos(std::min(1.0, std::abs(normal[u])));
  const double direction = std::hypot(east, north) > 1e-12 ? std::atan2(east, north) : 0;  // a level plane has none
  Orientation o;
  o.dip = vtkMath::DegreesFromRadians(dip);
  o.dip_direction = std::fmod(vtkMath::DegreesFromRadians(direction) + 360, 360);
  o.strike = std::fmod(o.dip_direction + 90, 180);
  const double radius = std::sqrt(2.0) * std::sin(dip / 2);
  o.x = -radius * std::sin(direction);
  o.y = -radius * std::cos(direction);
  return o;
}

std::vector<Tip> TipsOf(std::vector<FailedJoint> joints) {
  std::stable_sort(joints.begin(), joints.end(),
                   [](const FailedJoint& a, const FailedJoint& b) { return a.time < b.time; });
  std::vector<Tip> tips;
  for (const FailedJoint& joint : joints) {
    if (tips.empty()) {
      tips.push_back({joint.time, 0, 0, joint.centre});
      continue;
    }
    const double distance = Length(Difference(joint.centre, tips.front().position));
    if (distance <= tips.back().distance) continue;
    if (tips.size() > 1 && joint.time == tips.back().time) tips.pop_back();  // of several at once the furthest
    const Tip& last = tips.back();
    const double speed = joint.time > last.time ? (distance - last.distance) / (joint.time - last.time) : 0;
    tips.push_back({joint.time, distance, speed, joint.centre});
  }
  return tips;
}

double MeanSpeed(const std::vector<Tip>& tips) {
  std::vector<double> time, distance;
  for (const Tip& tip : tips) {
    time.push_back(tip.time);
    distance.push_back(tip.distance);
  }
  return FitLine(time, distance).slope;
}

Roughness RoughnessOf(const std::vector<FailedJoint>& joints) {
  Roughness r;
  Vector mean{};
  for (const FailedJoint& joint : joints) {
    r.area += joint.area;
    for (std::size_t k = 0; k < 3; ++k) mean[k] += joint.area * joint.centre[k];
  }
  if (!(r.area > 0)) return r;
  for (double& x : mean) x /= r.area;
  std::array<double, 6> moments{};
  constexpr std::size_t kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  for (const FailedJoint& joint : joints) {
    const Vector d = Difference(joint.centre, mean);
    for (std::size_t m = 0; m < 6; ++m) moments[m] += joint.area * d[kPairs[m][0]] * d[kPairs[m][1]];
  }
  Vector values;
  std::array<Vector, 3> axes;
  EigenSystem(moments, values, axes);
  r.rms_height = std::sqrt(std::max(values[2], 0.0) / r.area);
  for (const FailedJoint& joint : joints) r.projected_area += joint.area * std::abs(Dot(joint.normal, axes[2]));
  return r;
}

}  // namespace breccia
