#pragma once

// The kernel of the elements' part of the stable step, included once by each translation unit frequency_kernel_
// <instruction set>.cpp and compiled for its set, as the sweep is (sweep_kernel.hpp).

#include <experimental/simd>

#include "physics/frequency_block.hpp"

namespace breccia {
namespace {

namespace stdx = std::experimental;
namespace el = elasticity;

using Real = stdx::native_simd<double>;
constexpr std::size_t kWidth = Real::size();
static_assert(kLanes % kWidth == 0);

inline Real load(const double* p) { return Real(p, stdx::element_aligned); }

inline Real frequencies(const FrequencyGroup& group, const double* corners, const double* gradient) {
  const ElasticParams& p = *group.params;
  el::Corners<Real> x;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < 3; ++i) x[c][i] = load(corners + (3 * c + i) * kLanes);
  }
  el::Tensor<Real> g;
  for (std::size_t i = 0; i < 9; ++i) g[i] = load(gradient + i * kLanes);
  const el::Tensor<Real> f = el::deformation<Real>(x, g);
  const el::Tensor<Real> cof = el::cofactor(f);
  const Real j = el::determinant(f, cof);

  Real size = f[0] * f[0];
  for (std::size_t i = 1; i < 9; ++i) size += f[i] * f[i];
  const Real excess =
      el::greater(Real(0.0), Real(group.slope_at_j_min - el::volumetric_slope(j, p))) * stdx::sqrt(size);

  Real plain = 0, turned = 0;  // sums over the four corners of |g_a|^2 and |cof F g_a|^2
  for (std::size_t a = 0; a < 4; ++a) {
    el::Vector<Real> grad;
    for (std::size_t i = 0; i < 3; ++i) grad[i] = a < 3 ? g[3 * a + i] : -(g[i] + g[3 + i] + g[6 + i]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Real t = cof[3 * i] * grad[0] + cof[3 * i + 1] * grad[1] + cof[3 * i + 2] * grad[2];
      plain += grad[i] * grad[i];
      turned += t * t;
    }
  }
  const Real curvature = el::volumetric_curvature(el::clamped(j, p), p);
  return 4.0 / group.density * ((p.mu + excess) * plain + curvature * turned);
}

inline void frequency_block(const FrequencyGroup& group, const double* corners, const double* gradient, double* out) {
  for (std::size_t lane = 0; lane < kLanes; lane += kWidth)
    frequencies(group, corners + lane, gradient + lane).copy_to(out + lane, stdx::element_aligned);
}

}  // namespace
}  // namespace breccia
