#pragma once

#include <vector>

#include "case/history_columns.hpp"
#include "output/frames/frame.hpp"

namespace breccia {

/// Extremes of the columns of gauges over the lines of a run's history.
///
/// The first peak of a column is the value of largest magnitude so far, once it is followed by one that is smaller by
/// more than kDrop of it: the load at which a specimen fails. A peak below kNoise of a later value was noise; the next
/// one counts.
class Peaks {
 public:
  static constexpr double kDrop = 0.1, kNoise = 0.1;

  /// @param columns  of the history: those with a gauge are followed
  explicit Peaks(const std::vector<case_::HistoryColumn>& columns);

  /// Takes a line. @param row  (columns), perhaps more. Not-a-number does not count. O(columns)
  void add(const std::vector<double>& row);
  /// Columns without a value so far are left out.
  [[nodiscard]] std::vector<PeakReport> reports() const;

  /// All that is remembered, and back. @return  false: the numbers are not those of such columns
  [[nodiscard]] std::vector<double> memory() const;
  [[nodiscard]] bool restore(const std::vector<double>& memory);

 private:
  struct Column {
    case_::HistoryColumn column;
    std::size_t place;
    PeakReport report{};
    double candidate = 0, candidate_at = 0;
    bool has_values = false, confirmed = false;

    void add(double value, double time);
  };
  std::vector<Column> columns_;
};

}  // namespace breccia
