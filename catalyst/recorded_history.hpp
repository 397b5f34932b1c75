#pragma once

#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "run_folder/history.hpp"

namespace breccia::insitu {

/// A history.csv: a header, then rows of numbers that begin with step and time.
class RecordedHistory {
 public:
  RecordedHistory() = default;
  /// @pre the first two columns are the step, whole numbers, and the time
  explicit RecordedHistory(run_folder::History history);

  /// Time (s) of each step that has rows.
  [[nodiscard]] std::map<std::int64_t, double> times() const;
  /// The rows of a step, or none of them: a column is i64 where all its values are whole, else f64.
  [[nodiscard]] vtkSmartPointer<vtkTable> table(std::int64_t step, bool with_rows) const;

 private:
  [[nodiscard]] std::int64_t step_of(std::size_t row) const;

  run_folder::History history_;
  std::vector<bool> whole_;  ///< by column
};

/// Without rows when the file is not there; a last row that is not whole is left out. Throws PipelineError naming file
/// and line.
[[nodiscard]] RecordedHistory read_history(const std::filesystem::path& file);

}  // namespace breccia::insitu
