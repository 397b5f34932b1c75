#include "brecciaSieve.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

void FitRosinRammler(Sieve& sieve) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < sieve.size.size(); ++i) {
    if (sieve.passing[i] >= 1) continue;
    x.push_back(std::log(sieve.size[i]));
    y.push_back(std::log(-std::log1p(-sieve.passing[i])));
  }
  const Line line = FitLine(x, y);
  sieve.rosin_rammler_exponent = line.slope;
  sieve.rosin_rammler_size = std::exp(-line.intercept / line.slope);
}

void FitSwebrec(Sieve& sieve) {
  std::vector<double> x, y;
  sieve.swebrec_largest = sieve.size.empty() ? kNaN : sieve.size.back();
  for (std::size_t i = 0; i < sieve.size.size(); ++i) {
    if (sieve.passing[i] >= 1 || sieve.size[i] >= sieve.swebrec_largest) continue;
    x.push_back(std::log(std::log(sieve.swebrec_largest / sieve.size[i])));
    y.push_back(std::log(1 / sieve.passing[i] - 1));
  }
  const Line line = FitLine(x, y);
  sieve.swebrec_exponent = line.slope;
  sieve.swebrec_median = sieve.swebrec_largest * std::exp(-std::exp(-line.intercept / line.slope));
}

}  // namespace

double Sieve::RosinRammler(double x) const {
  return -std::expm1(-std::pow(x / rosin_rammler_size, rosin_rammler_exponent));
}

double Sieve::Swebrec(double x) const {
  if (x >= swebrec_largest) return 1;
  return 1 /
         (1 + std::pow(std::log(swebrec_largest / x) / std::log(swebrec_largest / swebrec_median), swebrec_exponent));
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
  FitRosinRammler(sieve);
  FitSwebrec(sieve);
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
