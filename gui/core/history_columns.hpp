#pragma once

#include <QString>
#include <vector>

#include "core/run_folder.hpp"

namespace breccia::gui {

/// "kinetic" and "J" of the column "kinetic [J]".
struct ColumnName {
  QString name, unit;
};
[[nodiscard]] ColumnName parts_of(const QString& column);

/// Whether the numbers of each column are what rounding leaves of nothing: smaller by many orders than others of their
/// unit, or of a run in which nothing moves. Columns that are zero throughout are not among them.
[[nodiscard]] std::vector<bool> are_round_off(const History& history);

}  // namespace breccia::gui
