#include "brecciaSieve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "vtkAmoebaMinimizer.h"
#include "vtkNew.h"

namespace breccia {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double SizeAt(const Sieve& sieve, double share) {
  for (std::size_t i = 0; i < sieve.size.size(); ++i) {
    if (sieve.passing[i] < share) continue;
    if (i == 0) return sieve.size[0];
    const double along = (share - sieve.passing[i - 1]) / (sieve.passing[i] - sieve.passing[i - 1]);
    return sieve.size[i - 1] + along * (sieve.size[i] - sieve.size[i - 1]);
  }
  return sieve.size.empty() ? kNaN : sieve.size.back();
}

constexpr std::size_t kFewest = 5;  // sizes: two parameters would go through fewer
constexpr double kPoor = 0.15;      // share of the mass
constexpr double kSharp = 1e-12;    // of the logarithms of parameters, and of the sum of squares
constexpr int kMostSteps = 2000;

using Curve = double (*)(const Sieve& sieve, double size, double exponent, double x);

double RosinRammlerCurve(const Sieve&, double size, double exponent, double x) {
  return -std::expm1(-std::pow(x / size, exponent));
}

double SwebrecCurve(const Sieve& sieve, double median, double exponent, double x) {
  if (x >= sieve.largest) return 1;
  return 1 / (1 + std::pow(std::log(sieve.largest / x) / std::log(sieve.largest / median), exponent));
}

/// The parameter of size and its logarithm, which is what the simplex moves in: it stays within its bounds.
double RosinRammlerSize(const Sieve&, double u) { return std::exp(u); }
double SwebrecSize(const Sieve& sieve, double u) { return sieve.largest * std::exp(-std::exp(u)); }

/// Sum of squares of the deviations, weighted with the mass of each size.
struct Squares {
  const Sieve& sieve;
  Curve curve;
  double (*size_of)(const Sieve& sieve, double u);
  vtkAmoebaMinimizer* simplex = nullptr;

  double operator()(double u, double v) const {
    double sum = 0, before = 0;
    for (std::size_t i = 0; i < sieve.size.size(); ++i) {
      const double miss = curve(sieve, size_of(sieve, u), std::exp(v), sieve.size[i]) - sieve.passing[i];
      sum += (sieve.passing[i] - before) * miss * miss;
      before = sieve.passing[i];
    }
    return std::isfinite(sum) ? sum : std::numeric_limits<double>::max();
  }
  static void Evaluate(void* of) {
    const auto& squares = *static_cast<Squares*>(of);
    squares.simplex->SetFunctionValue(
        squares(squares.simplex->GetParameterValue(0), squares.simplex->GetParameterValue(1)));
  }
};

/// @param u, v  start and result
void Minimize(Squares& squares, double& u, double& v) {
  const vtkNew<vtkAmoebaMinimizer> simplex;
  squares.simplex = simplex;
  simplex->SetFunction(&Squares::Evaluate, &squares);
  simplex->SetParameterValue("size", u);
  simplex->SetParameterValue("exponent", v);
  simplex->SetParameterScale("size", 0.3);
  simplex->SetParameterScale("exponent", 0.3);
  simplex->SetTolerance(kSharp);
  simplex->SetParameterTolerance(kSharp);
  simplex->SetMaxIterations(kMostSteps);
  simplex->Minimize();
  u = simplex->GetParameterValue(0);
  v = simplex->GetParameterValue(1);
}

std::string Rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

/// @param line  of the curve in the coordinates in which it is straight: a start. The median is another one.
SizeFit Fitted(Squares squares, const Line& line, double median) {
  SizeFit fit{kNaN, kNaN, kNaN, kNaN, {}};
  const Sieve& sieve = squares.sieve;
  if (sieve.size.size() < kFewest) {
    fit.left_out = std::to_string(sieve.size.size()) + " different sizes; it needs " + std::to_string(kFewest);
    return fit;
  }
  double u = std::isfinite(median) ? median : 0, v = 0;
  if (const double slope = std::log(line.slope), at = -line.intercept / line.slope;
      std::isfinite(slope) && std::isfinite(at) && squares(at, slope) < squares(u, v)) {
    u = at;
    v = slope;
  }
  Minimize(squares, u, v);
  Minimize(squares, u, v);  // a simplex may have collapsed before its end
  fit.size = squares.size_of(sieve, u);
  fit.exponent = std::exp(v);
  double mean = 0, before = 0, about = 0, at = 0;
  for (const double share : sieve.passing) mean += (share - std::exchange(before, share)) * share;
  before = fit.deviation = 0;
  for (std::size_t i = 0; i < sieve.size.size(); ++i) {
    const double share = sieve.passing[i];
    about += (share - std::exchange(before, share)) * (share - mean) * (share - mean);
    const double miss = std::abs(squares.curve(sieve, fit.size, fit.exponent, sieve.size[i]) - share);
    if (!(miss > fit.deviation)) continue;
    fit.deviation = miss;
    at = sieve.size[i];
  }
  fit.r2 = 1 - squares(u, v) / about;
  if (fit.deviation <= kPoor && std::isfinite(fit.size) && std::isfinite(fit.exponent)) return fit;
  fit.left_out = "its best fit deviates by " + Rounded(fit.deviation) + " of the mass at " + Rounded(1e3 * at) +
                 " mm; allowed: " + Rounded(kPoor);
  fit.size = fit.exponent = kNaN;
  return fit;
}

SizeFit FitRosinRammler(const Sieve& sieve) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < sieve.size.size(); ++i) {
    if (sieve.passing[i] >= 1) continue;
    x.push_back(std::log(sieve.size[i]));
    y.push_back(std::log(-std::log1p(-sieve.passing[i])));
  }
  return Fitted({sieve, RosinRammlerCurve, RosinRammlerSize}, FitLine(x, y), std::log(sieve.d50));
}

SizeFit FitSwebrec(const Sieve& sieve) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < sieve.size.size(); ++i) {
    if (sieve.passing[i] >= 1 || sieve.size[i] >= sieve.largest) continue;
    x.push_back(std::log(std::log(sieve.largest / sieve.size[i])));
    y.push_back(std::log(1 / sieve.passing[i] - 1));
  }
  return Fitted({sieve, SwebrecCurve, SwebrecSize}, FitLine(x, y), std::log(std::log(sieve.largest / sieve.d50)));
}

}  // namespace

double Sieve::RosinRammler(double x) const {
  return RosinRammlerCurve(*this, rosin_rammler.size, rosin_rammler.exponent, x);
}

double Sieve::Swebrec(double x) const {
  return swebrec ? SwebrecCurve(*this, swebrec.size, swebrec.exponent, x) : kNaN;
}

Sieve SieveOf(std::vector<std::pair<double, double>> fragments) {
  std::sort(fragments.begin(), fragments.end());
  Sieve sieve{};
  double mass = 0;
  for (const auto& [size, own] : fragments) {
    if (!(size > 0) || !(own > 0)) continue;
    mass += own;
    if (!sieve.size.empty() && sieve.size.back() == size) {
      sieve.passing.back() = mass;
      continue;
    }
    sieve.size.push_back(size);
    sieve.passing.push_back(mass);
  }
  for (double& share : sieve.passing) share /= mass;
  sieve.d50 = SizeAt(sieve, 0.5);
  sieve.d80 = SizeAt(sieve, 0.8);
  sieve.largest = sieve.size.empty() ? kNaN : sieve.size.back();
  sieve.rosin_rammler = FitRosinRammler(sieve);
  sieve.swebrec = FitSwebrec(sieve);
  return sieve;
}

Line FitLine(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  if (x.size() < 2 || !(xx > 0)) return {kNaN, kNaN};
  return {xy / xx, my - xy / xx * mx};
}

}  // namespace breccia
