#pragma once

#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace breccia::insitu {

/// A history.csv: a header, then rows of numbers that begin with step and time.
class RecordedHistory {
 public:
  RecordedHistory() = default;
  RecordedHistory(std::vector<std::string> columns, std::vector<std::vector<double>> rows);

  /// Time (s) of each step that has rows.
  [[nodiscard]] std::map<std::int64_t, double> times() const;
  /// The rows of a step, or none of them: a column is i64 where all its values are whole, else f64.
  [[nodiscard]] vtkSmartPointer<vtkTable> table(std::int64_t step, bool with_rows) const;

 private:
  std::vector<std::string> columns_;
  std::vector<bool> whole_;  ///< by column
  std::vector<std::vector<double>> rows_;
};

/// Without rows when the file is not there. Throws PipelineError naming file and line.
[[nodiscard]] RecordedHistory read_history(const std::filesystem::path& file);

}  // namespace breccia::insitu
