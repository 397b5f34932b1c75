#include "report/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/quantity_text.hpp"
#include "report/html.hpp"

namespace breccia::report {
namespace {

constexpr int kMarks = 5;  // about so many on a linear axis

/// 1, 2 or 5 times a power of ten, such that about kMarks fit.
double step_of(double span) {
  const double rough = span / kMarks, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * 0.999) return factor * power;
  }
  return 10 * power;
}

/// The power of 1000 in which values up to `largest` are written; pure numbers up to a million as they are.
int power_of(double largest, const std::string& unit) {
  if (largest == 0 || !std::isfinite(largest)) return 0;
  if (unit.empty() && largest > 0.999e-3 && largest <= 1e6) return 0;
  return std::clamp(static_cast<int>(std::floor(std::log10(largest) / 3 + 1e-9)), -5, 5);
}

std::string title_of(const std::string& name, const std::string& unit, int power) {
  constexpr std::array<const char*, 11> kPrefixes{"f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"};
  const int place = power + 5;
  const std::string prefix = kPrefixes[static_cast<std::size_t>(place)];
  if (!unit.empty()) return name + " [" + prefix + unit + "]";
  if (power == 0) return name;
  return name + " [10" + raised(3 * power) + "]";
}

std::string label_of(double value) {
  const bool grouped = std::abs(value) >= 1000 && value == std::round(value) && std::abs(value) < 1e9;
  std::string text = grouped ? count_text(std::llround(value)) : fmt::format("{:.6g}", value);
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

}  // namespace

double Axis::place(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

Axis linear_axis(double low, double high, const std::string& name, const std::string& unit) {
  Axis axis;
  if (low > 0 && low < 0.5 * high) low = 0;
  if (high < 0 && high > 0.5 * low) high = 0;
  if (!(high > low)) {  // one value, or none that is a number
    const double room = low == 0 || !std::isfinite(low) ? 1 : std::abs(low);
    low = std::isfinite(low) ? std::min(low, 0.0) : 0;
    high = low + room;
  }
  const double step = step_of(high - low);
  const auto first = static_cast<long>(std::floor(low / step + 1e-9));
  const auto last = static_cast<long>(std::ceil(high / step - 1e-9));
  axis.low = static_cast<double>(first) * step;
  axis.high = static_cast<double>(last) * step;
  const int power = power_of(std::max(std::abs(axis.low), std::abs(axis.high)), unit);
  for (long i = first; i <= last; ++i) {
    axis.marks.push_back(static_cast<double>(i) * step);
    axis.labels.push_back(label_of(axis.marks.back() / std::pow(1000.0, power)));
  }
  axis.title = title_of(name, unit, power);
  return axis;
}

Axis logarithmic_axis(double low, double high, const std::string& name, const std::string& unit) {
  Axis axis;
  axis.logarithmic = true;
  const bool few = std::log10(high / low) < 2.5;
  const std::vector<double> factors = few ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
  std::vector<double> all;
  for (int decade = first; decade <= std::max(last, first + 1); ++decade) {
    for (const double factor : factors) all.push_back(factor * std::pow(10.0, decade));
  }
  const auto begin = std::find_if(all.rbegin(), all.rend(), [&](double v) { return v <= low * (1 + 1e-9); });
  auto end = std::find_if(all.begin(), all.end(), [&](double v) { return v >= high * (1 - 1e-9); });
  if (end == all.end()) --end;
  auto start = begin == all.rend() ? all.begin() : begin.base() - 1;
  if (start >= end) end = start + 1;
  axis.marks.assign(start, end + 1);
  axis.low = axis.marks.front();
  axis.high = axis.marks.back();
  const int power = unit.empty() ? 0 : power_of(axis.high, unit);
  for (const double mark : axis.marks) axis.labels.push_back(label_of(mark / std::pow(1000.0, power)));
  axis.title = title_of(name, unit, power);
  return axis;
}

}  // namespace breccia::report
