#pragma once

#include <string>

namespace breccia {

enum class SofteningShape {
  z_curve,     ///< [1 - (a+b-1)/(a+b) exp(D k)] [a (1-D) + b (1-D)^c], k = (a + c b)/((a+b)(1-a-b)); thesis eq. 3.14
  linear,      ///< 1 - D
  exponential  ///< (e^(-s D) - e^(-s)) / (1 - e^(-s))
};

/// Softening branch z(D): share of the strength left at damage D, z(0) = 1, z(1) = 0, falling.
struct Softening {
  SofteningShape shape = SofteningShape::z_curve;
  double a = 0.63, b = 1.8, c = 6.0;  ///< z-curve; dimensionless. c whole: by multiplication, else by pow
  double exponent = 5.0;              ///< s of the exponential shape, > 0
};

/// A softening branch ready for evaluation: what does not depend on D is worked out once.
/// The bracket of eq. 3.14 is the one with which z'(0) = 0; in print it has been lost.
class SofteningCurve {
 public:
  SofteningCurve() : SofteningCurve(Softening{}) {}
  explicit SofteningCurve(const Softening& s);

  /// z(D). @pre 0 <= D <= 1
  [[nodiscard]] double operator()(double damage) const;
  /// Area under z over 0 <= D <= 1: 0.3863073 for a, b, c = 0.63, 1.8, 6. The z-curve by its closed form where c is
  /// whole and the recursion is stable, else by Gauss-Legendre quadrature to round-off.
  [[nodiscard]] double area() const;

 private:
  [[nodiscard]] double closed_form_area() const;

  Softening s_;
  int whole_c_ = -1;              ///< c if it is whole and small, else -1
  double weight_ = 0, rate_ = 0;  ///< z-curve: (a+b-1)/(a+b) and k
  double rest_ = 0, scale_ = 0;   ///< exponential: e^(-s) and 1/(1 - e^(-s))
};

/// Empty if z is a softening curve: finite, 1 at 0, 0 at 1, within [0, 1], never rising; else what is wrong.
[[nodiscard]] std::string softening_problem(const Softening& s);

}  // namespace breccia
