#include "base/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breccia {
namespace {

double table_value(const std::vector<TimeFunction::Point>& table, double time) {
  if (table.empty()) return 0.0;
  const auto next = std::upper_bound(table.begin(), table.end(), time,
                                     [](double t, const TimeFunction::Point& p) { return t < p.time; });
  if (next == table.begin()) return table.front().value;
  if (next == table.end()) return table.back().value;
  const TimeFunction::Point& a = *(next - 1);
  const double share = (time - a.time) / (next->time - a.time);
  return a.value + share * (next->value - a.value);
}

}  // namespace

double TimeFunction::operator()(double time) const {
  double value = constant + linear * time + table_value(table, time);
  for (const Sine& s : sines) value += s.amplitude * std::sin(2.0 * std::numbers::pi * s.frequency * time + s.phase);
  return value;
}

TimeFunction TimeFunction::earlier(double by) const {
  TimeFunction moved = *this;
  moved.constant += linear * by;
  for (Sine& s : moved.sines) s.phase += 2.0 * std::numbers::pi * s.frequency * by;
  for (Point& p : moved.table) p.time -= by;
  return moved;
}

bool TimeFunction::is_zero() const {
  return constant == 0.0 && linear == 0.0 &&
         std::all_of(sines.begin(), sines.end(), [](const Sine& s) { return s.amplitude == 0.0; }) &&
         std::all_of(table.begin(), table.end(), [](const Point& p) { return p.value == 0.0; });
}

}  // namespace breccia
