#include "physics/softening.hpp"

#include <array>
#include <cmath>

namespace breccia {
namespace {

/// x^c: by multiplication for the small whole exponents in use, which is faster and the same on every machine.
double power(double x, double c) {
  if (c >= 0 && c <= 16 && c == std::floor(c)) {
    double result = 1.0;
    for (int i = static_cast<int>(c); i > 0; i /= 2) {
      if (i % 2 == 1) result *= x;
      x *= x;
    }
    return result;
  }
  return std::pow(x, c);
}

}  // namespace

double softening(const Softening& s, double damage) {
  switch (s.shape) {
    case SofteningShape::linear: return 1.0 - damage;
    case SofteningShape::exponential: {
      const double rest = std::exp(-s.exponent);
      return (std::exp(-s.exponent * damage) - rest) / (1.0 - rest);
    }
    case SofteningShape::z_curve: break;
  }
  const double sum = s.a + s.b;
  const double k = (s.a + s.c * s.b) / (sum * (1.0 - sum));
  const double left = 1.0 - damage;
  return (1.0 - (sum - 1.0) / sum * std::exp(damage * k)) * (s.a * left + s.b * power(left, s.c));
}

double softening_area(const Softening& s) {
  // Five-point Gauss-Legendre on 64 panels: error far below round-off for these smooth curves.
  constexpr std::array<double, 5> points{-0.90617984593866399280, -0.53846931010568309104, 0.0, 0.53846931010568309104,
                                         0.90617984593866399280};
  constexpr std::array<double, 5> weights{0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                          0.47862867049936646804, 0.23692688505618908751};
  constexpr int panels = 64;
  double area = 0;
  for (int p = 0; p < panels; ++p) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      area += weights[i] * softening(s, (p + 0.5 * (1.0 + points[i])) / panels) / (2.0 * panels);
    }
  }
  return area;
}

std::string softening_problem(const Softening& s) {
  constexpr int samples = 1000;
  constexpr double slack = 1e-9;  // round-off of exp and the power
  double previous = softening(s, 0.0);
  const double last = softening(s, 1.0);
  if (!(std::abs(previous - 1.0) < slack) || !(std::abs(last) < slack)) {
    return "the softening curve must start at 1 and end at 0, but z(0) = " + std::to_string(previous) + " and z(1) = " + std::to_string(last);
  }
  for (int i = 1; i <= samples; ++i) {
    const double z = softening(s, static_cast<double>(i) / samples);
    if (!(z <= previous + slack) || !(z >= -slack)) {
      return "the softening curve must fall from 1 to 0, but z = " + std::to_string(z) + " at damage " + std::to_string(static_cast<double>(i) / samples);
    }
    previous = z;
  }
  return {};
}

}  // namespace breccia
