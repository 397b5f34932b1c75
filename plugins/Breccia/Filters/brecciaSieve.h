#ifndef brecciaSieve_h
#define brecciaSieve_h

#include <utility>
#include <vector>

namespace breccia {

/// Share of the mass that passes a mesh of a given size, and two distributions fitted to it.
///
/// Rosin-Rammler: P(x) = 1 - exp(-(x / x_c)^n); least squares of ln(-ln(1 - P)) over ln x.
/// Swebrec: P(x) = 1 / (1 + (ln(x_max / x) / ln(x_max / x_50))^b), x_max the largest fragment; least squares of ln(1/P
/// - 1) over ln ln(x_max / x). Both over the points with 0 < P < 1, of which there must be two with different sizes;
/// else the numbers are NaN.
struct Sieve {
  std::vector<double> size, passing;  ///< m, ascending, each size once; mass of what is not larger over all mass
  double d50, d80;  ///< m, by linear interpolation between points; the smallest size if it holds more than that
  double rosin_rammler_size, rosin_rammler_exponent;         ///< x_c, m; n
  double swebrec_median, swebrec_largest, swebrec_exponent;  ///< x_50, m; x_max, m; b
  double RosinRammler(double x) const;
  double Swebrec(double x) const;
};

/// @param fragments  size, m, and mass, kg, in any order; those without size or mass do not matter
Sieve SieveOf(std::vector<std::pair<double, double>> fragments);

/// Least squares y = slope x + intercept; NaN with fewer than two different x.
struct Line {
  double slope, intercept;
};
Line FitLine(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace breccia

#endif
