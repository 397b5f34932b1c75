#include "render/value_range.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::gui {
namespace {

/// Relative difference below which values count as equal.
constexpr double kAlike = 1e-3;

double size_of(const std::array<double, 2>& range) { return std::max(std::abs(range[0]), std::abs(range[1])); }

bool tells_apart(const std::array<double, 2>& range, double noise) {
  return size_of(range) > noise && range[1] - range[0] > kAlike * size_of(range);
}

}  // namespace

std::array<double, 2> value_range(std::vector<double> values, double noise, double outliers) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); }), values.end());
  if (values.empty()) return {0, 0};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const std::array<double, 2> all{*least, *most};
  if (size_of(all) <= noise) return {0, 0};
  const auto over = static_cast<std::ptrdiff_t>(outliers * static_cast<double>(values.size()));
  const auto at = [&values](std::ptrdiff_t place) {  // in the order of their sizes
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
  };
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
  const std::array<double, 2> inner{at(over), at(last - over)};
  if (tells_apart(inner, noise)) return inner;
  if (tells_apart(all, noise)) return all;
  return {std::min(all[0], 0.0), std::max(all[1], 0.0)};
}

}  // namespace breccia::gui
