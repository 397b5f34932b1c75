#include "output/folder/history_sink.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>

#include "output/folder/energy_terms.hpp"
#include "run_folder/csv.hpp"
#include "run_folder/lines.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

// Members of a row in the order of case_::history_columns.
constexpr std::array<std::int64_t HistoryRow::*, 7> kCounts{
    &HistoryRow::damaged_joints, &HistoryRow::broken_joints, &HistoryRow::broken_mode_1, &HistoryRow::broken_mode_2,
    &HistoryRow::fragments,      &HistoryRow::couples,       &HistoryRow::contacts};
constexpr std::array<double HistoryRow::*, 3> kAreas{&HistoryRow::broken_area, &HistoryRow::broken_area_mode_1,
                                                     &HistoryRow::broken_area_mode_2};
constexpr std::array<Vec3 GaugeReading::*, 10> kGaugeVectors{
    &GaugeReading::reaction, &GaugeReading::contact_force, &GaugeReading::displacement, &GaugeReading::max_displacement,
    &GaugeReading::velocity, &GaugeReading::centre,        &GaugeReading::momentum,     &GaugeReading::spin,
    &GaugeReading::force,    &GaugeReading::torque};

constexpr const char* kInSituShare = "in situ share of wall time";  // the last column

/// Hands out the numbers of a row in the order of the columns: counts as they are, vectors by component.
template <class Add>
void each_number(const HistoryRow& row, Add add) {
  const auto add_vector = [&](const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  };
  add(row.step);
  add(row.time);
  add(row.time_step);
  for (const EnergyTerm& term : kEnergyTerms) add(row.energy.*term.value);
  add(row.energy.residual_relative);
  for (const auto count : kCounts) add(row.*count);
  for (const auto area : kAreas) add(row.*area);
  add_vector(row.momentum);
  add_vector(row.angular_momentum);
  add(row.max_speed);
  add(row.stress_yy_sum);
  for (const GaugeReading& gauge : row.gauges) {
    for (const auto vector : kGaugeVectors) add_vector(gauge.*vector);
  }
  for (const double value : row.at_points) add(value);
  if (row.insitu_share) add(*row.insitu_share);
}

struct NumberText {
  std::string& text;
  void operator()(double value) const { fmt::format_to(std::back_inserter(text), "{}{:.17g}", comma(), value); }
  void operator()(std::int64_t value) const { fmt::format_to(std::back_inserter(text), "{}{}", comma(), value); }
  [[nodiscard]] const char* comma() const { return text.empty() ? "" : ","; }
};

bool has_insitu_share(const std::filesystem::path& history) {
  RegularStream file(history);
  std::string header;
  return run_folder::next_whole_line(file, header) && run_folder::fields_of(header).back() == kInSituShare;
}

}  // namespace

std::vector<std::string> history_columns(const std::vector<std::string>& groups,
                                         const std::vector<case_::Gauge>& gauges, bool insitu) {
  std::vector<std::string> columns;
  for (const case_::HistoryColumn& column : case_::history_columns(groups, gauges)) columns.push_back(column.header());
  if (insitu) columns.emplace_back(kInSituShare);
  return columns;
}

void HistorySink::start(const RunStart& run) {
  gauges_ = run.gauges.size();
  const std::vector<std::string> columns = history_columns(run.gauges, run.point_gauges, run.insitu);
  columns_at_points_ = 0;
  for (const case_::Gauge& gauge : run.point_gauges) columns_at_points_ += case_::columns_of(gauge).size();
  if (run.marks) {
    insitu_before_ = !run.insitu && has_insitu_share(path_);
    file_.emplace(path_, static_cast<std::size_t>(run.marks->history_bytes));
    return;
  }
  std::string header;
  for (const std::string& column : columns) {
    if (!header.empty()) header += ',';
    header += csv_field(column);
  }
  file_.emplace(path_);
  file_->append_line(header);
}

std::vector<double> history_values(const HistoryRow& row) {
  std::vector<double> values;
  each_number(row, [&](auto value) { values.push_back(static_cast<double>(value)); });
  return values;
}

void HistorySink::history(const HistoryRow& row) {
  DEMAND(file_.has_value() && row.gauges.size() == gauges_, std::to_string(row.gauges.size()) + " gauge readings");
  DEMAND(row.at_points.size() == columns_at_points_, std::to_string(row.at_points.size()) + " numbers at points");
  std::string text;
  each_number(row, NumberText{text});
  if (insitu_before_) NumberText{text}(0.0);
  file_->append_line(text);
}

void HistorySink::mark(OutputMarks& marks) const {
  if (file_) marks.history_bytes = static_cast<std::int64_t>(file_->size());
}

void HistorySink::finish(const Summary&) {
  if (file_) file_->sync();
}

}  // namespace breccia
