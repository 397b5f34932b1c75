#include "base/quantity_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/number_text.hpp"

namespace breccia {
namespace {

constexpr std::array<const char*, 11> kPrefixes{"f", "p", "n", "u", "m", "", "k", "M", "G", "T", "P"};
constexpr int kNoPrefix = 5;

/// Three significant digits without trailing zeros and without an exponent; |value| in [1, 1000).
std::string three_digits(double value) {
  std::string text = fmt::format("{:.{}f}", value, std::abs(value) < 10 ? 2 : std::abs(value) < 100 ? 1 : 0);
  if (text.find('.') != std::string::npos) {
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

}  // namespace

std::string quantity_text(double value, std::string_view unit) {
  const std::string after = unit.empty() ? "" : " ";
  if (value == 0) return fmt::format("0{}{}", after, unit);
  if (!std::isfinite(value)) return fmt::format("{}{}{}", value, after, unit);
  const double shown = rounded(value, 3);  // so that 999.7 goes to the next prefix
  const int power = static_cast<int>(std::floor(std::log10(std::abs(shown)) / 3 + 1e-9));
  const int prefix = power + kNoPrefix;
  if (prefix < 0 || prefix >= static_cast<int>(kPrefixes.size())) return fmt::format("{:.2e}{}{}", value, after, unit);
  const std::string_view letter = kPrefixes[static_cast<std::size_t>(prefix)];
  const bool word = unit.size() > 4;  // "M element-steps/s", but "MPa"
  return fmt::format("{} {}{}{}", three_digits(shown / std::pow(1000.0, power)), letter,
                     word && !letter.empty() ? " " : "", unit);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "unknown";
  if (seconds < 9.995) return fmt::format("{:.2f} s", seconds);
  if (seconds > 1e9) return fmt::format("{:.3g} years", seconds / (365.25 * 86400));
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  const std::int64_t minutes = whole / 60, hours = minutes / 60, days = hours / 24;
  if (minutes == 0) return fmt::format("{} s", whole);
  if (hours == 0) return fmt::format("{} min {} s", minutes, whole % 60);
  if (days == 0) return fmt::format("{} h {} min", hours, minutes % 60);
  return fmt::format("{} d {} h", days, hours % 24);
}

std::string count_text(std::int64_t count) {
  const std::string digits = fmt::format("{}", count);
  const std::size_t sign = count < 0 ? 1 : 0;
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > sign && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace breccia
