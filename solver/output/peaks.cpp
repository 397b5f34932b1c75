#include "output/peaks.hpp"

#include <cmath>

namespace breccia {
namespace {

constexpr std::size_t kNumbers = 8;  ///< that a column remembers

}  // namespace

Peaks::Peaks(const std::vector<case_::HistoryColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].gauge.empty()) columns_.push_back({columns[i], i});
  }
}

void Peaks::Column::add(double value, double time) {
  if (std::isnan(value)) return;
  if (!has_values || value > report.largest) report.largest = value, report.largest_at = time;
  if (!has_values || value < report.smallest) report.smallest = value, report.smallest_at = time;
  has_values = true;
  const double size = std::abs(candidate), along = std::copysign(1.0, candidate) * value;
  const bool was_noise = kNoise * std::abs(value) > size;
  if (was_noise || (!confirmed && along > size)) {
    candidate = value, candidate_at = time;
    confirmed = false;
  } else {
    confirmed = confirmed || along < (1 - kDrop) * size;
  }
}

void Peaks::add(const std::vector<double>& row) {
  for (Column& column : columns_) column.add(row[column.place], row[case_::kTimeColumn]);
}

std::vector<PeakReport> Peaks::reports() const {
  std::vector<PeakReport> reports;
  for (const Column& column : columns_) {
    if (!column.has_values) continue;
    PeakReport& report = reports.emplace_back(column.report);
    report.gauge = column.column.gauge;
    report.quantity = column.column.quantity;
    report.unit = column.column.unit;
    if (!column.confirmed) continue;
    report.first_peak = column.candidate;
    report.first_peak_at = column.candidate_at;
  }
  return reports;
}

std::vector<double> Peaks::memory() const {
  std::vector<double> memory;
  for (const Column& column : columns_) {
    const PeakReport& r = column.report;
    memory.insert(memory.end(), {r.largest, r.largest_at, r.smallest, r.smallest_at, column.candidate,
                                 column.candidate_at, column.has_values ? 1.0 : 0.0, column.confirmed ? 1.0 : 0.0});
  }
  return memory;
}

bool Peaks::restore(const std::vector<double>& memory) {
  if (memory.size() != kNumbers * columns_.size()) return false;
  const double* m = memory.data();
  for (Column& column : columns_) {
    column.report.largest = m[0], column.report.largest_at = m[1];
    column.report.smallest = m[2], column.report.smallest_at = m[3];
    column.candidate = m[4], column.candidate_at = m[5];
    column.has_values = m[6] != 0, column.confirmed = m[7] != 0;
    m += kNumbers;
  }
  return true;
}

}  // namespace breccia
