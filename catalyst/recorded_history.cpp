#include "catalyst/recorded_history.hpp"

#include <vtkDoubleArray.h>
#include <vtkTypeInt64Array.h>

#include <cmath>
#include <sstream>

#include "catalyst/pipeline_error.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

/// Fields of a line; a field may stand in quotes, in which two quotes are one.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && in_quotes && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      in_quotes = !in_quotes;
    } else if (c == ',' && !in_quotes) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

bool is_whole(double value) { return std::floor(value) == value && std::abs(value) < 9e15; }

}  // namespace

RecordedHistory::RecordedHistory(std::vector<std::string> columns, std::vector<std::vector<double>> rows)
    : columns_(std::move(columns)), whole_(columns_.size(), true), rows_(std::move(rows)) {
  for (const auto& row : rows_) {
    for (std::size_t column = 0; column < row.size(); ++column)
      whole_[column] = whole_[column] && is_whole(row[column]);
  }
}

std::map<std::int64_t, double> RecordedHistory::times() const {
  std::map<std::int64_t, double> times;
  for (const auto& row : rows_) times[static_cast<std::int64_t>(row[0])] = row[1];
  return times;
}

vtkSmartPointer<vtkTable> RecordedHistory::table(std::int64_t step, bool with_rows) const {
  auto table = vtkSmartPointer<vtkTable>::New();
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    vtkSmartPointer<vtkDataArray> array;
    if (whole_[column]) {
      array = vtkSmartPointer<vtkTypeInt64Array>::New();
    } else {
      array = vtkSmartPointer<vtkDoubleArray>::New();
    }
    array->SetName(columns_[column].c_str());
    for (const auto& row : rows_) {
      if (with_rows && static_cast<std::int64_t>(row[0]) == step) array->InsertNextTuple1(row[column]);
    }
    table->AddColumn(array);
  }
  return table;
}

RecordedHistory read_history(const std::filesystem::path& file) {
  std::istringstream content(file_content(file));
  std::string line;
  if (!std::getline(content, line)) return {};
  auto columns = fields_of(line);
  std::vector<std::vector<double>> rows;
  for (int number = 2; std::getline(content, line); ++number) {
    std::vector<double> row;
    for (const std::string& field : fields_of(line)) {
      char* end = nullptr;
      row.push_back(std::strtod(field.c_str(), &end));
      if (field.empty() || *end != '\0')
        throw PipelineError(file.string() + ":" + std::to_string(number) + ": '" + field + "' is no number");
    }
    if (row.size() != columns.size() || row.size() < 2)
      throw PipelineError(file.string() + ":" + std::to_string(number) + ": has " + std::to_string(row.size()) +
                          " fields, the header has " + std::to_string(columns.size()));
    rows.push_back(std::move(row));
  }
  return {std::move(columns), std::move(rows)};
}

}  // namespace breccia::insitu
