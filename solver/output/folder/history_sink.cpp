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

struct Count {
  const char* name;
  std::int64_t HistoryRow::*value;
};
constexpr std::array<Count, 7> kCounts{{{"damaged joints", &HistoryRow::damaged_joints},
                                        {"broken joints", &HistoryRow::broken_joints},
                                        {"broken in mode I", &HistoryRow::broken_mode_1},
                                        {"broken in mode II", &HistoryRow::broken_mode_2},
                                        {"fragments", &HistoryRow::fragments},
                                        {"couples", &HistoryRow::couples},
                                        {"contacts", &HistoryRow::contacts}}};

struct Area {
  const char* name;
  double HistoryRow::*value;
};
constexpr std::array<Area, 3> kAreas{{{"broken area", &HistoryRow::broken_area},
                                      {"broken area in mode I", &HistoryRow::broken_area_mode_1},
                                      {"broken area in mode II", &HistoryRow::broken_area_mode_2}}};

struct Vector {
  const char* name;
  const char* unit;
  Vec3 HistoryRow::*value;
};
constexpr std::array<Vector, 2> kVectors{
    {{"momentum", "kg m/s", &HistoryRow::momentum}, {"angular momentum", "kg m2/s", &HistoryRow::angular_momentum}}};

struct GaugeVector {
  const char* name;
  const char* unit;
  Vec3 GaugeReading::*value;
};
constexpr std::array<GaugeVector, 10> kGaugeVectors{{{"reaction", "N", &GaugeReading::reaction},
                                                     {"contact force", "N", &GaugeReading::contact_force},
                                                     {"displacement", "m", &GaugeReading::displacement},
                                                     {"max displacement", "m", &GaugeReading::max_displacement},
                                                     {"velocity", "m/s", &GaugeReading::velocity},
                                                     {"centre", "m", &GaugeReading::centre},
                                                     {"momentum", "kg m/s", &GaugeReading::momentum},
                                                     {"spin", "rad/s", &GaugeReading::spin},
                                                     {"resultant force", "N", &GaugeReading::force},
                                                     {"resultant torque", "N m", &GaugeReading::torque}}};

constexpr std::array<char, 3> kAxes{'x', 'y', 'z'};

constexpr const char* kInSituShare = "in situ share of wall time";  // the last column

/// Words of a table's name: "joint_elastic" is "joint elastic".
std::string words_of(std::string name) {
  for (char& c : name) {
    if (c == '_') c = ' ';
  }
  return name;
}

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
  for (const Count& count : kCounts) add(row.*count.value);
  for (const Area& area : kAreas) add(row.*area.value);
  for (const Vector& vector : kVectors) add_vector(row.*vector.value);
  add(row.max_speed);
  add(row.stress_yy_sum);
  for (const GaugeReading& gauge : row.gauges) {
    for (const GaugeVector& vector : kGaugeVectors) add_vector(gauge.*vector.value);
  }
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

std::vector<std::string> history_columns(const std::vector<std::string>& gauges, bool insitu) {
  std::vector<std::string> columns{"step", "time [s]", "time step [s]"};
  for (const EnergyTerm& term : kEnergyTerms) columns.push_back(words_of(term.name) + " [J]");
  columns.emplace_back("relative residual");
  for (const Count& count : kCounts) columns.emplace_back(count.name);
  for (const Area& area : kAreas) columns.push_back(fmt::format("{} [m2]", area.name));
  for (const Vector& vector : kVectors) {
    for (const char axis : kAxes) columns.push_back(fmt::format("{} {} [{}]", vector.name, axis, vector.unit));
  }
  columns.emplace_back("max speed [m/s]");
  columns.emplace_back("sum of |stress yy| [Pa]");
  for (const std::string& gauge : gauges) {
    for (const GaugeVector& vector : kGaugeVectors) {
      for (const char axis : kAxes)
        columns.push_back(fmt::format("{} {} {} [{}]", gauge, vector.name, axis, vector.unit));
    }
  }
  if (insitu) columns.emplace_back(kInSituShare);
  return columns;
}

void HistorySink::start(const RunStart& run) {
  gauges_ = run.gauges.size();
  if (run.marks) {
    insitu_before_ = !run.insitu && has_insitu_share(path_);
    file_.emplace(path_, static_cast<std::size_t>(run.marks->history_bytes));
    return;
  }
  std::string header;
  for (const std::string& column : history_columns(run.gauges, run.insitu)) {
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
