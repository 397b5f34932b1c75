#include "output/insitu/insitu_pace.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/quantity_text.hpp"

namespace breccia {
namespace {

/// Parts of an execution that round-off may hide.
constexpr double kRoundOff = 1e-9;
/// Ratio of the planned share to the budget from which it is reported: the plan has whole executions.
constexpr double kReportedRatio = 1.2;

std::int64_t whole(double number) { return static_cast<std::int64_t>(std::floor(number + kRoundOff)); }

}  // namespace

double expected_wall(const PaceState& s) {
  return s.starts + (s.elapsed - s.starts) * (s.end - s.begin) / (s.now - s.begin);
}

Spacing spaced_evenly(const PaceState& s) {
  const double rest = s.end - s.last, wall = expected_wall(s);
  const std::int64_t wanted = whole(rest / s.interval);
  const double owed = std::ceil(static_cast<double>(s.least - 1) * rest / (s.end - s.begin) - kRoundOff);
  const std::int64_t least = std::min(static_cast<std::int64_t>(std::max(owed, 0.0)), wanted);
  const double affordable = std::max(s.share * wall - s.spent, 0.0) / s.cost;
  const std::int64_t rest_times =
      std::max<std::int64_t>({affordable >= static_cast<double>(wanted) ? wanted : whole(affordable), least, 1});
  Spacing spacing;
  spacing.distance = rest / static_cast<double>(rest_times);
  spacing.next = rest_times > 1 ? s.last + spacing.distance : std::numeric_limits<double>::infinity();
  spacing.times = s.done + rest_times;
  spacing.share = (s.spent + s.cost * static_cast<double>(rest_times)) / wall;
  return spacing;
}

std::vector<double> parts_of_budget(double budget, const std::vector<double>& asked) {
  std::vector<std::size_t> order(asked.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return asked[a] < asked[b]; });
  std::vector<double> parts(asked.size());
  double left = budget;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double part = std::min(asked[order[i]], left / static_cast<double>(order.size() - i));
    parts[order[i]] = part;
    left -= part;
  }
  return parts;
}

std::string pace_text(const std::string& name, const char* thing, const Spacing& spacing, const PaceState& state) {
  std::string text = fmt::format("{}: a {} every {}, {} in all, for {:.2g} % of the wall time", name, thing,
                                 quantity_text(spacing.distance, "s"), spacing.times, 100 * spacing.share);
  if (spacing.share > kReportedRatio * state.share) {
    text += fmt::format(", more than its part of insitu.max_overhead, {:.2g} %", 100 * state.share);
    if (state.least > 1) text += fmt::format(": insitu.least_instants = {}", state.least);
  } else if (spacing.distance > kReportedRatio * state.interval) {
    text += fmt::format("; one every {} would take more than its part of insitu.max_overhead",
                        quantity_text(state.interval, "s"));
  }
  return text;
}

}  // namespace breccia
