#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "case/history_columns.hpp"
#include "output/sink.hpp"
#include "system/atomic_file.hpp"

namespace breccia {

/// Names of the history's columns with their units, "time [s]", "kinetic [J]", ... The order of history_values.
/// @param groups, gauges  of the case: output.gauges, [[gauge]]
/// @param insitu  pipelines are executed during the run: their share of the wall time is the last column
[[nodiscard]] std::vector<std::string> history_columns(const std::vector<std::string>& groups,
                                                       const std::vector<case_::Gauge>& gauges = {},
                                                       bool insitu = false);

/// The numbers of a row in the order of the columns.
[[nodiscard]] std::vector<double> history_values(const HistoryRow& row);

/// `history.csv`: a header line, then one line a row, numbers with 17 significant digits (they read back as the same
/// doubles; not-a-number is written nan). Names with a comma or quote are quoted by RFC 4180. Every line is written to
/// the system at once, so a killed run keeps all of them.
class HistorySink final : public Sink {
 public:
  explicit HistorySink(std::filesystem::path file) : path_(std::move(file)) {}

  void start(const RunStart& run) override;
  /// @pre row.gauges has the length of RunStart::gauges, row.at_points a number for each column of its point gauges
  void history(const HistoryRow& row) override;
  void mark(OutputMarks& marks) const override;
  void finish(const Summary&) override;

 private:
  std::filesystem::path path_;
  std::optional<LineFile> file_;
  std::size_t gauges_ = 0, columns_at_points_ = 0;
  bool insitu_before_ = false;  ///< lines so far have the share of pipelines, which the continued run lacks
};

}  // namespace breccia
