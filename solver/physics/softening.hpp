#pragma once

#include <string>

namespace breccia {

enum class SofteningShape {
  z_curve,     ///< [1 - (a+b-1)/(a+b) exp(D k)] [a (1-D) + b (1-D)^c], k = (a + c b)/((a+b)(1-a-b)); thesis eq. 3.14
  linear,      ///< 1 - D
  exponential  ///< (e^(-s D) - e^(-s)) / (1 - e^(-s))
};

/// Softening branch z(D): share of the strength left at damage D, z(0) = 1, z(1) = 0, decreasing.
struct Softening {
  SofteningShape shape = SofteningShape::z_curve;
  double a = 0.63, b = 1.8, c = 6.0;  ///< z-curve; dimensionless
  double exponent = 5.0;              ///< s of the exponential shape
};

/// z(D) for 0 <= D <= 1.
[[nodiscard]] double softening(const Softening& s, double damage);

/// Area under z over 0 <= D <= 1, by Gauss-Legendre quadrature on panels to round-off.
/// 0.3863073 for a, b, c = 0.63, 1.8, 6.
[[nodiscard]] double softening_area(const Softening& s);

/// Empty if z is a softening curve: finite, 1 at 0, 0 at 1, within [0, 1], never rising; else what is wrong.
[[nodiscard]] std::string softening_problem(const Softening& s);

}  // namespace breccia
