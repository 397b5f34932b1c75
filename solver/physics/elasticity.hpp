#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "physics/material/drucker_prager_params.hpp"

namespace breccia {

/// Constitutive law of a constant-strain tetrahedron. All have Hooke's law as their small-strain limit.
enum class BulkLaw {
  neo_hookean,      ///< hyperelastic: closed strain loops are exact
  green_st_venant,  ///< thesis eq. 3.10 as printed; not hyperelastic, its work must be integrated
  drucker_prager    ///< with memory: physics/material/drucker_prager.hpp
};

/// Whether the law has a stored energy, a function of the deformation and of the element's memory.
[[gnu::always_inline]] constexpr bool is_hyperelastic(BulkLaw law) {
  switch (law) {
    case BulkLaw::neo_hookean:
      return true;
    case BulkLaw::green_st_venant:
      return false;
    case BulkLaw::drucker_prager:
      return true;
  }
  __builtin_unreachable();
}

/// How the stress of a law is computed: side by side from F alone, or element by element by `step_bulk_law`
/// (physics/material/bulk_law.hpp), as for every law whose elements remember what has happened to them.
enum class StressKernel { neo_hookean, green_st_venant, with_memory };

[[gnu::always_inline]] constexpr StressKernel stress_kernel(BulkLaw law) {
  switch (law) {
    case BulkLaw::neo_hookean:
      return StressKernel::neo_hookean;
    case BulkLaw::green_st_venant:
      return StressKernel::green_st_venant;
    case BulkLaw::drucker_prager:
      return StressKernel::with_memory;
  }
  __builtin_unreachable();
}

[[gnu::always_inline]] constexpr bool has_memory(BulkLaw law) {
  return stress_kernel(law) == StressKernel::with_memory;
}

/// Parameters of the element's kernels. Made by `make_elastic_params`.
struct ElasticParams {
  BulkLaw law = BulkLaw::neo_hookean;
  double mu = 0;                         ///< Pa, shear modulus
  double lambda = 0;                     ///< Pa, Lame's first modulus
  double viscosity = 0;                  ///< Pa s, mubar of the viscous Cauchy stress (2 mubar / J) D
  double j_min = 0.1;                    ///< volume ratio J below which the law is continued linearly; > 0
  DruckerPragerParams drucker_prager{};  ///< of that law alone
};

/// Plasticity is added by hand. @pre young > 0, -1 < poisson < 0.5, viscosity >= 0, 0 < j_min < 1
[[nodiscard]] constexpr ElasticParams make_elastic_params(BulkLaw law, double young, double poisson, double viscosity,
                                                          double j_min = 0.1) {
  return {law, young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson)), viscosity, j_min,
          {}};
}

/// Kernels of the constant-strain tetrahedron, for T = double and for T = std::experimental::simd<double, ...>: plain
/// arithmetic and `select`, the same operations in the same order for every T, hence the same bits.
///
/// Deformation gradient F = sum_(c=1..3) (x_c - x_0) (row c-1 of D_m^-1), J = det F, cof F = J F^-T by cross products:
/// no division by J anywhere, so a flat or inverted element (J <= 0) gives finite forces.
/// Nothing here throws, branches on data, or allocates.
namespace elasticity {

template <class T>
using Vector = std::array<T, 3>;
template <class T>
using Tensor = std::array<T, 9>;  ///< row-major 3 x 3
template <class T>
using Corners = std::array<Vector<T>, 4>;

/// mask ? a : b, lane by lane.
template <class Mask, class T>
[[nodiscard]] inline T select(const Mask& mask, const T& a, const T& b) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return mask ? a : b;
  } else {
    T result = b;
    where(mask, result) = a;
    return result;
  }
}

/// The lesser; a when they are equal or one is not a number.
template <class T>
[[nodiscard]] inline T lesser(const T& a, const T& b) {
  return select(b < a, b, a);
}
/// The greater; a when they are equal or one is not a number.
template <class T>
[[nodiscard]] inline T greater(const T& a, const T& b) {
  return select(b > a, b, a);
}

/// F from positions (m), or Fdot from velocities (m/s).
/// @param x  x[c][i] as of Corners<T>   @param inverse  inverse[k] as of Tensor<T>: D_m^-1, row-major, 1/m
template <class T, class X, class Inverse>
[[nodiscard]] inline Tensor<T> deformation(const X& x, const Inverse& inverse) {
  Tensor<T> f;
  for (std::size_t i = 0; i < 3; ++i) {
    const T a = x[1][i] - x[0][i], b = x[2][i] - x[0][i], c = x[3][i] - x[0][i];
    for (std::size_t j = 0; j < 3; ++j) f[3 * i + j] = a * inverse[j] + b * inverse[3 + j] + c * inverse[6 + j];
  }
  return f;
}

/// cof F: its columns are the cross products of the columns of F.
template <class T>
[[nodiscard]] inline Tensor<T> cofactor(const Tensor<T>& f) {
  return {f[4] * f[8] - f[5] * f[7], f[5] * f[6] - f[3] * f[8], f[3] * f[7] - f[4] * f[6],
          f[2] * f[7] - f[1] * f[8], f[0] * f[8] - f[2] * f[6], f[1] * f[6] - f[0] * f[7],
          f[1] * f[5] - f[2] * f[4], f[2] * f[3] - f[0] * f[5], f[0] * f[4] - f[1] * f[3]};
}

/// J = det F, m3/m3.
template <class T>
[[nodiscard]] inline T determinant(const Tensor<T>& f, const Tensor<T>& cof) {
  return f[0] * cof[0] + f[1] * cof[1] + f[2] * cof[2];
}

/// max(J, j_min): every formula that would divide by J divides by this.
template <class T>
[[nodiscard]] inline T clamped(const T& j, const ElasticParams& p) {
  const T floor = T(p.j_min);
  return select(j > floor, j, floor);
}

/// psi''(J) of psi(J) = -mu ln J + lambda/4 (J^2 - 1 - 2 ln J), Pa, for J >= j_min; below, psi is its Taylor polynomial
/// of second order at j_min and psi'' stays.
template <class T>
[[nodiscard]] [[gnu::always_inline]] inline T volumetric_curvature(const T& j, const ElasticParams& p) {
  return (p.mu + 0.5 * p.lambda) / (j * j) + 0.5 * p.lambda;
}

/// psi'(J), Pa: continuous, with a continuous slope at j_min, linear below.
template <class T>
[[nodiscard]] inline T volumetric_slope(const T& j, const ElasticParams& p) {
  const T jc = clamped(j, p);
  return 0.5 * p.lambda * jc - (p.mu + 0.5 * p.lambda) / jc + volumetric_curvature(p.j_min, p) * (j - jc);
}

/// First Piola stress of the neo-Hookean law, Pa: P = mu F + psi'(J) cof F. Into its place, which spares a slow copy.
/// For J >= j_min this is mu F + [(lambda/2)(J^2 - 1) - mu] F^-T, i.e. the Cauchy stress
/// T = (mu/J)(B - I) + (lambda/2)(J - 1/J) I.
template <class T>
inline void neo_hookean_piola(const Tensor<T>& f, const Tensor<T>& cof, const T& j, const ElasticParams& p,
                              Tensor<T>& piola) {
  const T slope = volumetric_slope(j, p);
  for (std::size_t i = 0; i < 9; ++i) piola[i] = p.mu * f[i] + slope * cof[i];
}

/// Cauchy stress of thesis eq. 3.10 without its viscous term, Pa, row-major:
/// T = J^(-2/3) [ E/(1+nu) (B/J^(2/3) - I)/2 + E/(1-2nu) (J^(2/3) - 1)/2 I ].
/// Below j_min the factor of B stays at its value there and the isotropic part continues along its tangent: the
/// pressure grows linearly as the element collapses and inverts.
template <class T>
[[nodiscard]] inline Tensor<T> green_st_venant_stress(const Tensor<T>& f, const T& j, const ElasticParams& p) {
  using std::cbrt;
  const T jc = clamped(j, p);
  const T root = cbrt(jc);
  const T q = 1.0 / (root * root);                     // J^(-2/3)
  const T q_on = q - (2.0 / 3.0) * q / jc * (j - jc);  // the same, along its tangent below j_min
  const T isotropic = 0.5 * (3 * p.lambda + 2 * p.mu) * (1.0 - q_on) - p.mu * q_on;
  const T factor = p.mu * q * q;
  Tensor<T> t;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i; k < 3; ++k) {
      t[3 * i + k] = factor * (f[3 * i] * f[3 * k] + f[3 * i + 1] * f[3 * k + 1] + f[3 * i + 2] * f[3 * k + 2]);
      t[3 * k + i] = t[3 * i + k];
    }
    t[4 * i] += isotropic;
  }
  return t;
}

/// A B for row-major 3 x 3.
template <class T>
[[nodiscard]] inline Tensor<T> product(const Tensor<T>& a, const Tensor<T>& b) {
  Tensor<T> c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  }
  return c;
}

/// First Piola stress of the law named by `p.law`, without the viscous part, Pa. A law with memory has none that
/// follows from F alone: no numbers, where its own function ought to have been called (physics/material/bulk_law.hpp).
template <class T>
[[nodiscard]] inline Tensor<T> elastic_piola(const Tensor<T>& f, const ElasticParams& p) {
  const Tensor<T> cof = cofactor(f);
  const T j = determinant(f, cof);
  Tensor<T> piola;
  switch (stress_kernel(p.law)) {
    case StressKernel::neo_hookean:
      neo_hookean_piola(f, cof, j, p, piola);
      break;
    case StressKernel::green_st_venant:
      piola = product(green_st_venant_stress(f, j, p), cof);
      break;
    case StressKernel::with_memory:
      piola.fill(T(std::numeric_limits<double>::quiet_NaN()));
      break;
  }
  return piola;
}

/// First Piola stress of the viscous term, Pa: P_v = 2 mubar D F^-T with D = sym(Fdot F^-1), written
/// (2 mubar / J^2) sym(Fdot cof^T) cof F with J >= j_min. Power P_v : Fdot = (2 mubar / J^2) |sym(Fdot cof^T)|^2 >= 0
/// for every F; a spin gives none.
template <class T>
[[nodiscard]] inline Tensor<T> viscous_piola(const Tensor<T>& rate, const Tensor<T>& cof, const T& j,
                                             const ElasticParams& p) {
  Tensor<T> l;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      l[3 * i + k] = rate[3 * i] * cof[3 * k] + rate[3 * i + 1] * cof[3 * k + 1] + rate[3 * i + 2] * cof[3 * k + 2];
    }
  }
  const T jc = clamped(j, p);
  const T factor = p.viscosity / (jc * jc);  // 2 mubar / J^2 times the half of the symmetric part
  Tensor<T> d;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i; k < 3; ++k) d[3 * i + k] = d[3 * k + i] = factor * (l[3 * i + k] + l[3 * k + i]);
  }
  return product(d, cof);
}

/// Forces on the four corners, N: f_c = -V0 P grad0 N_c; grad0 N_c is row c-1 of D_m^-1, f_0 = -(f_1 + f_2 + f_3).
template <class T, class Inverse>
[[nodiscard]] inline Corners<T> corner_forces(const Tensor<T>& piola, const Inverse& inverse, const T& volume) {
  Corners<T> force;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 1; c < 4; ++c) {
      const std::size_t r = 3 * (c - 1);
      force[c][i] =
          -volume * (piola[3 * i] * inverse[r] + piola[3 * i + 1] * inverse[r + 1] + piola[3 * i + 2] * inverse[r + 2]);
    }
    force[0][i] = -(force[1][i] + force[2][i] + force[3][i]);
  }
  return force;
}

/// x - ln(1 + x) for x > -1, without loss of digits around 0.
template <class T>
[[nodiscard]] inline T minus_log1p(const T& x) {
  using std::log1p;
  const T small = T(0.02);  // series below: next term 2e-18 of the sum
  const T series =
      x * x *
      (1. / 2 + x * (-1. / 3 +
                     x * (1. / 4 + x * (-1. / 5 +
                                        x * (1. / 6 + x * (-1. / 7 + x * (1. / 8 + x * (-1. / 9 + x * (1. / 10)))))))));
  return select(x * x < small * small, series, T(x - log1p(x)));
}

/// Strain energy density of the neo-Hookean law, J/m3: W = mu/2 (tr F^T F - 3) + psi(J), whose derivative is
/// `neo_hookean_piola` also below j_min. Written in H = F - I so that small strains keep their digits:
/// W = mu (H:H/2 - I_2(H) - det H) + (mu + lambda/2) (h - ln(1+h)) + lambda/4 h^2, h = J - 1, plus the continuation.
template <class T>
[[nodiscard]] inline T neo_hookean_energy(const Tensor<T>& f, const ElasticParams& p) {
  Tensor<T> h = f;
  h[0] -= 1.0;
  h[4] -= 1.0;
  h[8] -= 1.0;
  const Tensor<T> cof = cofactor(h);
  const T det = determinant(h, cof);
  const T second = cof[0] + cof[4] + cof[8];
  T square = h[0] * h[0];
  for (std::size_t i = 1; i < 9; ++i) square += h[i] * h[i];
  const T growth = h[0] + h[4] + h[8] + second + det;  // J - 1
  const T kept = select(growth > T(p.j_min - 1.0), growth, T(p.j_min - 1.0));
  const T below = growth - kept;
  return p.mu * (0.5 * square - second - det) + (p.mu + 0.5 * p.lambda) * minus_log1p(kept) +
         0.25 * p.lambda * (kept * kept) +
         below * (p.mu + volumetric_slope(T(p.j_min), p) + 0.5 * volumetric_curvature(p.j_min, p) * below);
}

/// Elastic and viscous forces on the corners of one element, N.
/// @param x, v     positions, m, and velocities, m/s
/// @param inverse  D_m^-1, row-major, 1/m;  @param volume  V0, m3
template <class T>
[[nodiscard]] inline Corners<T> element_forces(const Corners<T>& x, const Corners<T>& v, const Tensor<T>& inverse,
                                               const T& volume, const ElasticParams& p) {
  const Tensor<T> f = deformation<T>(x, inverse);
  Tensor<T> piola = elastic_piola(f, p);
  if (p.viscosity > 0) {
    const Tensor<T> cof = cofactor(f);
    const Tensor<T> viscous = viscous_piola(deformation<T>(v, inverse), cof, determinant(f, cof), p);
    for (std::size_t i = 0; i < 9; ++i) piola[i] += viscous[i];
  }
  return corner_forces(piola, inverse, volume);
}

/// Strain energy of one element, J. @pre p.law == neo_hookean: green_st_venant has none, laws with memory have their
/// own (physics/material/bulk_law.hpp).
template <class T>
[[nodiscard]] inline T element_energy(const Corners<T>& x, const Tensor<T>& inverse, const T& volume,
                                      const ElasticParams& p) {
  return volume * neo_hookean_energy(deformation<T>(x, inverse), p);
}

}  // namespace elasticity
}  // namespace breccia
