#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

namespace breccia::gui {

/// A unit in which numbers of an axis have few digits.
struct PrefixedUnit {
  double size = 1;   ///< of it in the unit without prefix
  std::string name;  ///< "MPa"
};

/// "m²" for "m2".
inline std::string with_powers(const std::string& unit) {
  std::string shown;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool is_power = i > 0 && std::isalpha(static_cast<unsigned char>(unit[i - 1])) != 0;
    shown += is_power && unit[i] == '2' ? "\u00b2" : is_power && unit[i] == '3' ? "\u00b3" : std::string(1, unit[i]);
  }
  return shown;
}

/// @param largest  of the numbers, in `unit`
/// @param unit     of SI; one that takes no prefix, as "m2" or "kg", stays
inline PrefixedUnit prefixed_unit(double largest, const std::string& unit) {
  constexpr std::array kTakePrefixes{"Pa", "m", "s", "N", "J", "W", "m/s", "Pa/m", "N m"};
  constexpr std::array<std::pair<double, const char*>, 7> kPrefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}}};
  constexpr double kRounding = 1 - 1e-9;
  const double size = std::abs(largest);
  if (!(size > 0) || std::find(kTakePrefixes.begin(), kTakePrefixes.end(), unit) == kTakePrefixes.end())
    return {1, with_powers(unit)};
  for (const auto& [factor, prefix] : kPrefixes) {
    const bool is_used = factor <= 1 || unit != "s";  // kiloseconds are unusual
    if (is_used && size >= kRounding * factor) return {factor, prefix + unit};
  }
  return {kPrefixes.back().first, kPrefixes.back().second + unit};
}

}  // namespace breccia::gui
