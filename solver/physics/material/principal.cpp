#include "physics/material/principal.hpp"

#include <cmath>
#include <cstddef>

namespace breccia::material {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Turns axes p and q so that entry pq vanishes. The smaller of the two angles: t = tan, |t| <= 1.
void rotate(Matrix& a, Matrix& axis, std::size_t p, std::size_t q) {
  const double off = a[p][q];
  if (off == 0.0) return;
  const double theta = 0.5 * (a[q][q] - a[p][p]) / off;
  const double root = std::abs(theta) + std::sqrt(theta * theta + 1.0);
  const double t = (theta < 0 ? -1.0 : 1.0) / root;
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  const std::size_t r = 3 - p - q;
  const double rp = a[r][p], rq = a[r][q];
  a[p][p] -= t * off;
  a[q][q] += t * off;
  a[p][q] = a[q][p] = 0.0;
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = axis[p][i], y = axis[q][i];
    axis[p][i] = c * x - s * y;
    axis[q][i] = s * x + c * y;
  }
}

}  // namespace

Principal principal_of(const Symmetric& tensor) {
  Matrix a{{{tensor[0], tensor[3], tensor[5]}, {tensor[3], tensor[1], tensor[4]}, {tensor[5], tensor[4], tensor[2]}}};
  Principal result{.axis = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  constexpr int kMostSweeps = 12;  // convergence is quadratic: six are enough
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    const double off = std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
    constexpr double kNegligible = 1e-20;  // of the diagonal: changes no eigenvalue by a bit
    if (!(off > kNegligible * (std::abs(a[0][0]) + std::abs(a[1][1]) + std::abs(a[2][2])))) break;
    rotate(a, result.axis, 0, 1);
    rotate(a, result.axis, 0, 2);
    rotate(a, result.axis, 1, 2);
  }
  result.value = {a[0][0], a[1][1], a[2][2]};
  return result;
}

}  // namespace breccia::material
