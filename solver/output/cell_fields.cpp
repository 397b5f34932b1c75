#include "output/cell_fields.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "base/error.hpp"

namespace breccia {
namespace {

using Symmetric = std::array<std::array<double, 3>, 3>;

// Cyclic Jacobi converges quadratically: five sweeps are enough for any 3 x 3 matrix, the rest is a safety net.
constexpr int kMaxSweeps = 12;

/// Turns rows and columns p and q so that a[p][q] becomes zero.
void rotate(Symmetric& a, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0);
  const double s = t * c;
  const std::size_t r = 3 - p - q;
  a[p][p] -= t * a[p][q];
  a[q][q] += t * a[p][q];
  a[p][q] = a[q][p] = 0;
  const double arp = a[r][p], arq = a[r][q];
  a[r][p] = a[p][r] = c * arp - s * arq;
  a[r][q] = a[q][r] = s * arp + c * arq;
}

}  // namespace

double von_mises_stress(std::span<const double, 6> s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  const double shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * shear);
}

std::array<double, 3> principal_stresses(std::span<const double, 6> s) {
  Symmetric a{{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
  double largest = 0;
  for (const double value : s) {
    if (!std::isfinite(value)) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      return {nan, nan, nan};
    }
    largest = std::max(largest, std::abs(value));
  }
  const double negligible = largest * std::numeric_limits<double>::epsilon() / 16;
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    if (std::abs(a[0][1]) + std::abs(a[1][2]) + std::abs(a[0][2]) <= negligible) break;
    rotate(a, 0, 1);
    rotate(a, 1, 2);
    rotate(a, 0, 2);
  }
  std::array<double, 3> values{a[0][0], a[1][1], a[2][2]};
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

void derive_stress_fields(std::span<const double> stress, std::span<double> von_mises, std::span<double> principal) {
  const std::size_t n = von_mises.size();
  DEMAND(stress.size() == 6 * n && principal.size() == 3 * n,
         std::to_string(stress.size()) + " stresses, " + std::to_string(n) + " elements");
  for (std::size_t e = 0; e < n; ++e) {
    const std::span<const double, 6> s = stress.subspan(6 * e).first<6>();
    von_mises[e] = von_mises_stress(s);
    const std::array<double, 3> values = principal_stresses(s);
    std::copy(values.begin(), values.end(), principal.begin() + static_cast<std::ptrdiff_t>(3 * e));
  }
}

}  // namespace breccia
