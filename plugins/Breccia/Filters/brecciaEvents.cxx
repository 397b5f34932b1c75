#include "brecciaEvents.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

namespace breccia {
namespace {

using Cell = std::array<vtkTypeInt64, 3>;

/// Joints in cubes as wide as the distance, so that near ones are in the same cube or one beside it.
class Cubes {
 public:
  Cubes(const std::vector<FailedJoint>& joints, double width) : width_(width) {
    for (std::size_t i = 0; i < joints.size(); ++i) joints_[CellOf(joints[i].centre)].push_back(i);
  }
  template <class Visit>
  void ForNear(const Vector& at, Visit&& visit) const {
    const Cell middle = CellOf(at);
    for (int i = 0; i < 27; ++i) {
      const auto found = joints_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
      if (found == joints_.end()) continue;
      for (const std::size_t joint : found->second) visit(joint);
    }
  }

 private:
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      return static_cast<std::size_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    }
  };
  Cell CellOf(const Vector& x) const {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<vtkTypeInt64>(std::floor(x[k] / width_));
    return cell;
  }
  double width_;
  std::unordered_map<Cell, std::vector<std::size_t>, Hash> joints_;
};

/// For each joint the first one of its event.
std::vector<std::size_t> Cluster(const std::vector<FailedJoint>& joints, double distance, double duration) {
  std::vector<std::size_t> parent(joints.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const Cubes cubes(joints, distance);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    cubes.ForNear(joints[i].centre, [&](std::size_t j) {
      if (j >= i || std::abs(joints[i].time - joints[j].time) > duration) return;
      if (Length(Difference(joints[i].centre, joints[j].centre)) > distance) return;
      const std::size_t a = root(i), b = root(j);
      parent[std::max(a, b)] = std::min(a, b);
    });
  }
  for (std::size_t i = 0; i < joints.size(); ++i) parent[i] = root(i);
  return parent;
}

void AddMoment(const FailedJoint& joint, double lame_1, double lame_2, std::array<double, 6>& m) {
  constexpr std::size_t kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  const Vector &u = joint.jump, &n = joint.normal;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    m[k] += joint.area * ((i == j ? lame_1 * Dot(u, n) : 0) + lame_2 * (u[i] * n[j] + u[j] * n[i]));
  }
}

}  // namespace

double CrackEvent::ScalarMoment() const {
  double squares = 0;
  for (std::size_t k = 0; k < 6; ++k) squares += (k < 3 ? 1 : 2) * moment[k] * moment[k];
  return std::sqrt(squares / 2);
}

double CrackEvent::Magnitude() const { return 2.0 / 3 * (std::log10(ScalarMoment()) - 9.1); }
double CrackEvent::EnergyMagnitude() const { return 2.0 / 3 * std::log10(energy) - 2.9; }

Vector CrackEvent::Parts() const {
  Vector values;
  std::array<Vector, 3> axes;
  EigenSystem(moment, values, axes);
  const double mean = (values[0] + values[1] + values[2]) / 3;
  for (double& x : values) x -= mean;
  std::sort(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double whole = std::abs(mean) + std::abs(values[2]);
  if (!(whole > 0)) return {0, 0, 0};
  const double isotropic = mean / whole, rest = 1 - std::abs(isotropic);
  const double epsilon = std::abs(values[2]) > 0 ? std::abs(values[0]) / std::abs(values[2]) : 0;
  return {isotropic, rest * (1 - 2 * epsilon), rest * 2 * epsilon};
}

std::vector<CrackEvent> EventsOf(const std::vector<FailedJoint>& joints, double distance, double duration,
                                 double lame_1, double lame_2) {
  const std::vector<std::size_t> first = Cluster(joints, distance, duration);
  std::map<std::size_t, CrackEvent> events;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const FailedJoint& joint = joints[i];
    CrackEvent& event = events[first[i]];
    if (event.joints == 0) {
      event.id = joint.id;
      event.time = joint.time;
    }
    const double end = std::max(event.time + event.duration, joint.time);
    event.time = std::min(event.time, joint.time);
    event.duration = end - event.time;
    ++event.joints;
    event.area += joint.area;
    event.energy += joint.energy;
    for (std::size_t k = 0; k < 3; ++k) event.centre[k] += joint.area * joint.centre[k];
    AddMoment(joint, lame_1, lame_2, event.moment);
  }
  std::vector<CrackEvent> list;
  for (auto& [start, event] : events) {
    for (double& x : event.centre) x /= event.area > 0 ? event.area : 1;
    list.push_back(event);
  }
  return list;
}

MagnitudeFit FitMagnitudes(const std::vector<double>& magnitudes, double completeness) {
  std::map<vtkTypeInt64, vtkTypeInt64> bins;
  std::vector<double> finite;
  for (const double m : magnitudes) {
    if (!std::isfinite(m)) continue;
    finite.push_back(m);
    ++bins[static_cast<vtkTypeInt64>(std::floor(m / kMagnitudeBin + 1e-9))];
  }
  MagnitudeFit fit;
  const double none = std::numeric_limits<double>::quiet_NaN();
  fit.completeness = completeness;
  if (completeness > 20) {
    const auto fullest =
        std::max_element(bins.begin(), bins.end(), [](const auto& p, const auto& q) { return p.second < q.second; });
    fit.completeness = fullest == bins.end() ? none : kMagnitudeBin * static_cast<double>(fullest->first);
  }
  double excess = 0;
  for (const double m : finite) {
    if (m < fit.completeness - 1e-9) continue;
    excess += m - fit.completeness;
    ++fit.events;
  }
  const auto n = static_cast<double>(fit.events);
  fit.b = fit.events > 1 && excess > 0 ? std::log10(std::exp(1.0)) * n / excess : none;
  fit.error = fit.b / std::sqrt(n);
  fit.a = std::log10(n) + fit.b * fit.completeness;
  return fit;
}

}  // namespace breccia
