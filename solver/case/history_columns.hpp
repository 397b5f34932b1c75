#pragma once

#include <string>
#include <vector>

#include "case/experiment.hpp"

namespace breccia::case_ {

/// A column of history.csv.
struct HistoryColumn {
  std::string gauge;     ///< whose it is: a group, "body 3", a [[gauge]], of a line with the number; empty: the model's
  std::string quantity;  ///< "kinetic", "reaction x"
  std::string unit{};    ///< SI; empty: none

  /// "bar.x1 reaction x"
  [[nodiscard]] std::string name() const { return gauge.empty() ? quantity : gauge + " " + quantity; }
  /// As the first line of the file has it: "bar.x1 reaction x [N]"
  [[nodiscard]] std::string header() const { return unit.empty() ? name() : name() + " [" + unit + "]"; }
  /// As expressions name it: "bar.x1.reaction_x". All signs but letters, digits and dots become one underscore.
  [[nodiscard]] std::string word() const;
};

/// Place of the time among the columns.
inline constexpr std::size_t kTimeColumn = 1;

/// The columns that are the same on any number of ranks, in their order: of the model, of the groups and bodies of
/// output.gauges, of [[gauge]].
[[nodiscard]] std::vector<HistoryColumn> history_columns(const std::vector<std::string>& groups,
                                                         const std::vector<Gauge>& gauges);

/// Those of one [[gauge]].
[[nodiscard]] std::vector<HistoryColumn> columns_of(const Gauge& gauge);

}  // namespace breccia::case_
