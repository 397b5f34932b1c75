#ifndef brecciaSieve_h
#define brecciaSieve_h

#include <string>
#include <utility>
#include <vector>

namespace breccia {

/// A distribution of sizes fitted to the share of the mass that passes: least squares of the share itself, each size
/// weighted with the mass of it, by VTK's simplex (vtkAmoebaMinimizer) from two starts.
struct SizeFit {
  double size, exponent;  ///< m, 1; NaN if left out
  double r2, deviation;   ///< 1 - weighted squares of the fit over those about the mean; largest distance at a size
  std::string left_out;   ///< reason; empty: it is not
  explicit operator bool() const { return left_out.empty(); }
};

/// Share of the mass that passes a mesh of a given size, and two distributions fitted to it.
///
/// Rosin-Rammler: P(x) = 1 - exp(-(x / x_c)^n). Swebrec: P(x) = 1 / (1 + (ln(x_max / x) / ln(x_max / x_50))^b), x_max
/// the largest fragment. A fit is left out with fewer than 5 different sizes, and where it deviates by more than 0.15.
struct Sieve {
  std::vector<double> size, passing;  ///< m, ascending, each size once; mass of what is not larger over all mass
  double d50, d80;        ///< m, by linear interpolation between points; the smallest size if it holds more than that
  SizeFit rosin_rammler;  ///< x_c, n
  SizeFit swebrec;        ///< x_50, b
  double largest;         ///< x_max, m; NaN: no fragments
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
