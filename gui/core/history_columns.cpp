#include "core/history_columns.hpp"

#include <QMap>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

namespace breccia::gui {
namespace {

/// Sums of many terms that cancel keep some 1e-13 of them.
constexpr double kShareOfOthers = 1e-10;
/// J: less than one chemical bond holds. A run whose energies all stay below it is at rest.
constexpr double kLeastEnergy = 1e-18;

/// Quantities that vanish at rest; counts, times and places do not.
bool is_of_motion(const QString& unit) {
  static const QStringList others{"", "s", "m", "m2"};
  return !others.contains(unit);
}

}  // namespace

ColumnName parts_of(const QString& column) {
  static const QRegularExpression pattern(R"(^(.*) \[([^\[\]]*)\]$)");
  const auto match = pattern.match(column);
  return match.hasMatch() ? ColumnName{match.captured(1), match.captured(2)} : ColumnName{column, {}};
}

std::vector<bool> are_round_off(const History& history) {
  QMap<QString, double> most;  // by unit
  QStringList units;
  for (int c = 0; c < history.columns().size(); ++c) {
    units << parts_of(history.columns()[c]).unit;
    most[units.back()] = std::max(most[units.back()], history.largest(c));
  }
  const bool at_rest = most.contains("J") && most["J"] < kLeastEnergy;
  std::vector<bool> found;
  for (int c = 0; c < units.size(); ++c) {
    const double own = history.largest(c);
    found.push_back(own > 0 && !units[c].isEmpty() &&
                    (own < kShareOfOthers * most[units[c]] || (at_rest && is_of_motion(units[c]))));
  }
  return found;
}

}  // namespace breccia::gui
