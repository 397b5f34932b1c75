#include "output/folder/summary_gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>

#include "base/number_text.hpp"
#include "base/printable.hpp"
#include "base/quantity_text.hpp"

namespace breccia {
namespace {

constexpr std::size_t kMostPeakLines = 40;
/// A component of a vector is shown if it reaches this share of the largest one.
constexpr double kShownShare = 0.1;
constexpr int kDigits = 6;
constexpr std::array<std::string_view, 6> kShown{"reaction",   "contact force", "displacement",
                                                 "elongation", "strain",        "broken joints"};

/// "reaction" of "reaction x".
std::string vector_of(const std::string& quantity) {
  const std::size_t space = quantity.rfind(' ');
  const bool is_component = space != std::string::npos && space + 2 == quantity.size();
  return is_component ? quantity.substr(0, space) : quantity;
}

double size_of(const PeakReport& peak) { return std::max(std::abs(peak.largest), std::abs(peak.smallest)); }

std::string value_text(double value, const std::string& unit) {
  return unit.empty() ? number_text(value, kDigits) : quantity_text(value, unit);
}

std::string extreme_text(const PeakReport& peak, double value, double time) {
  return value_text(value, peak.unit) + " at " + quantity_text(time, "s");
}

}  // namespace

std::string conditions_text(const std::vector<ConditionReport>& conditions) {
  if (conditions.empty()) return {};
  std::string text = "  conditions that became true\n";
  for (const ConditionReport& c : conditions) {
    text +=
        fmt::format("    {} = \"{}\": {} at {}", c.key, printable(c.when), c.action, quantity_text(c.first_time, "s"));
    if (c.times > 1) text += fmt::format(", {} times until {}", count_text(c.times), quantity_text(c.last_time, "s"));
    for (const auto& [name, value] : c.values)
      text += fmt::format("; {} = {}", printable(name), number_text(value, kDigits));
    text += "\n";
  }
  return text;
}

std::string peaks_text(const std::vector<PeakReport>& peaks) {
  std::map<std::string, double> sizes;  // of vectors
  const auto name_of = [](const PeakReport& p) { return p.gauge + " " + vector_of(p.quantity); };
  for (const PeakReport& p : peaks) sizes[name_of(p)] = std::max(sizes[name_of(p)], size_of(p));
  std::string text;
  std::size_t lines = 0, more = 0;
  for (const PeakReport& p : peaks) {
    const bool is_of_use = std::find(kShown.begin(), kShown.end(), vector_of(p.quantity)) != kShown.end();
    if (!is_of_use || !(size_of(p) > 0) || size_of(p) < kShownShare * sizes[name_of(p)]) continue;
    if (++lines > kMostPeakLines) {
      ++more;
      continue;
    }
    fmt::format_to(std::back_inserter(text), "    {} {}: largest {}, smallest {}", printable(p.gauge), p.quantity,
                   extreme_text(p, p.largest, p.largest_at), extreme_text(p, p.smallest, p.smallest_at));
    if (p.first_peak) text += ", first peak " + extreme_text(p, *p.first_peak, p.first_peak_at);
    text += "\n";
  }
  if (more > 0) text += fmt::format("    and {} more in summary.json\n", count_text(static_cast<std::int64_t>(more)));
  return text.empty() ? text : "  gauges\n" + text;
}

}  // namespace breccia
