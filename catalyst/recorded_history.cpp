#include "catalyst/recorded_history.hpp"

#include <vtkDoubleArray.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "catalyst/pipeline_error.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

bool is_whole(double value) { return std::floor(value) == value && std::abs(value) < 9e15; }

}  // namespace

RecordedHistory::RecordedHistory(run_folder::History history) : history_(std::move(history)) {
  for (const std::vector<double>& column : history_.columns)
    whole_.push_back(std::all_of(column.begin(), column.end(), is_whole));
}

std::map<std::int64_t, double> RecordedHistory::times() const {
  std::map<std::int64_t, double> times;
  for (std::size_t row = 0; row < history_.rows(); ++row) times[step_of(row)] = history_.columns[1][row];
  return times;
}

std::int64_t RecordedHistory::step_of(std::size_t row) const {
  return static_cast<std::int64_t>(history_.columns[0][row]);
}

vtkSmartPointer<vtkTable> RecordedHistory::table(std::int64_t step, bool with_rows) const {
  auto table = vtkSmartPointer<vtkTable>::New();
  for (std::size_t column = 0; column < history_.names.size(); ++column) {
    vtkSmartPointer<vtkDataArray> array;
    if (whole_[column]) {
      array = vtkSmartPointer<vtkTypeInt64Array>::New();
    } else {
      array = vtkSmartPointer<vtkDoubleArray>::New();
    }
    array->SetName(history_.names[column].c_str());
    for (std::size_t row = 0; with_rows && row < history_.rows(); ++row) {
      if (step_of(row) == step) array->InsertNextTuple1(history_.columns[column][row]);
    }
    table->AddColumn(array);
  }
  return table;
}

RecordedHistory read_history(const std::filesystem::path& file) {
  run_folder::HistoryText read = run_folder::parse_history(file_content(file));
  if (read.num_left_out > 0)
    throw PipelineError(file.string() + ":" + std::to_string(read.first_left_out) + ": " + read.problem);
  const run_folder::History& history = read.history;
  if (history.rows() == 0) return {};
  if (history.columns.size() < 2 || !std::all_of(history.columns[0].begin(), history.columns[0].end(), is_whole))
    throw PipelineError(file.string() + ": its rows do not begin with a step and a time");
  return RecordedHistory(std::move(read.history));
}

}  // namespace breccia::insitu
