#include "physics/softening.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "physics/whole_power.hpp"

namespace breccia {
namespace {

constexpr int kLargestWholeExponent = 64;

/// Five-point Gauss-Legendre rule on 64 panels in u, D = 1 - u^4: (1-D)^c becomes smooth at D = 1 for small c as well.
double quadrature(const SofteningCurve& z) {
  constexpr std::array<double, 5> points{-0.90617984593866399280, -0.53846931010568309104, 0.0, 0.53846931010568309104,
                                         0.90617984593866399280};
  constexpr std::array<double, 5> weights{0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                          0.47862867049936646804, 0.23692688505618908751};
  constexpr int panels = 64;
  double area = 0;
  for (int p = 0; p < panels; ++p) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double u = (p + 0.5 * (1.0 + points[i])) / panels;
      area += weights[i] * z(1.0 - whole_power(u, 4)) * 4.0 * whole_power(u, 3) / (2.0 * panels);
    }
  }
  return area;
}

}  // namespace

SofteningCurve::SofteningCurve(const Softening& s) : s_(s) {
  const double sum = s.a + s.b;
  if (s.c >= 1 && s.c <= kLargestWholeExponent && s.c == std::floor(s.c)) whole_c_ = static_cast<int>(s.c);
  // a + b = 1 is the limit in which the exponential's weight vanishes.
  if (sum != 1.0) {
    weight_ = (sum - 1.0) / sum;
    rate_ = (s.a + s.c * s.b) / (sum * (1.0 - sum));
  }
  rest_ = std::exp(-s.exponent);
  scale_ = -1.0 / std::expm1(-s.exponent);
}

double SofteningCurve::operator()(double damage) const {
  const double left = 1.0 - damage;
  switch (s_.shape) {
    case SofteningShape::linear:
      return left;
    case SofteningShape::exponential:
      return (std::exp(-s_.exponent * damage) - rest_) * scale_;
    case SofteningShape::z_curve:
      break;
  }
  const double tail = whole_c_ > 0 ? whole_power(left, whole_c_) : std::pow(left, s_.c);
  return (1.0 - weight_ * std::exp(damage * rate_)) * (s_.a * left + s_.b * tail);
}

double SofteningCurve::closed_form_area() const {
  // Integral of e^(k D) (1-D)^m: J_0 = (e^k - 1)/k, J_m = (m J_(m-1) - 1)/k.
  double integral = std::expm1(rate_) / rate_, first = 0;
  for (int m = 1; m <= whole_c_; ++m) {
    integral = (m * integral - 1.0) / rate_;
    if (m == 1) first = integral;
  }
  return s_.a / 2.0 + s_.b / (s_.c + 1.0) - weight_ * (s_.a * first + s_.b * integral);
}

double SofteningCurve::area() const {
  switch (s_.shape) {
    case SofteningShape::linear:
      return 0.5;
    case SofteningShape::exponential: {
      const double s = s_.exponent;
      // 1/s - 1/(e^s - 1); its series where the difference would lose digits.
      return s < 0.01 ? 0.5 - s / 12.0 + s * s * s / 720.0 : 1.0 / s - 1.0 / std::expm1(s);
    }
    case SofteningShape::z_curve:
      break;
  }
  constexpr double kLargestGrowth = 1e4;  // of round-off by the recursion: m!/k^m
  double growth = 1.0;
  for (int m = 1; m <= whole_c_; ++m) growth *= std::fmax(m / std::abs(rate_), 1.0);
  return whole_c_ > 0 && rate_ != 0 && growth < kLargestGrowth ? closed_form_area() : quadrature(*this);
}

std::string softening_problem(const Softening& s) {
  constexpr int samples = 1000;
  constexpr double slack = 1e-9;  // round-off of exp and the power
  const SofteningCurve z(s);
  std::ostringstream text;
  if (!(std::abs(z(0.0) - 1.0) < slack) || !(std::abs(z(1.0)) < slack)) {
    text << "the softening curve must start at 1 and end at 0, but z(0) = " << z(0.0) << " and z(1) = " << z(1.0);
    return text.str();
  }
  double previous = z(0.0);
  for (int i = 1; i <= samples; ++i) {
    const double damage = static_cast<double>(i) / samples, value = z(damage);
    if (!(value <= previous + slack) || !(value >= -slack)) {
      text << "the softening curve must fall from 1 to 0, but goes from " << previous << " to " << value
           << " at damage " << damage;
      return text.str();
    }
    previous = value;
  }
  return {};
}

}  // namespace breccia
