#include "output/history_sink.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "output/energy_terms.hpp"

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
constexpr std::array<GaugeVector, 5> kGaugeVectors{{{"reaction", "N", &GaugeReading::reaction},
                                                    {"contact force", "N", &GaugeReading::contact_force},
                                                    {"displacement", "m", &GaugeReading::displacement},
                                                    {"max displacement", "m", &GaugeReading::max_displacement},
                                                    {"velocity", "m/s", &GaugeReading::velocity}}};

constexpr std::array<char, 3> kAxes{'x', 'y', 'z'};

/// Words of a table's name: "joint_elastic" is "joint elastic".
std::string words_of(std::string name) {
  for (char& c : name) {
    if (c == '_') c = ' ';
  }
  return name;
}

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += (c == '\r' || c == '\n') ? ' ' : c;  // a line of the file is a row
  }
  return text + '"';
}

class Numbers {
 public:
  void add(double value) { values_.push_back(value); }
  void add(std::int64_t value) { values_.push_back(static_cast<double>(value)); }
  void add(const Vec3& value) { values_.insert(values_.end(), {value[0], value[1], value[2]}); }
  [[nodiscard]] std::vector<double> take() { return std::move(values_); }

 private:
  std::vector<double> values_;
};

}  // namespace

std::vector<std::string> history_columns(const std::vector<std::string>& gauges, bool insitu) {
  std::vector<std::string> columns{"step", "time [s]", "time step [s]"};
  for (const EnergyTerm& term : kEnergyTerms) columns.push_back(words_of(term.name) + " [J]");
  columns.emplace_back("relative residual");
  for (const Count& count : kCounts) columns.emplace_back(count.name);
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
  if (insitu) columns.emplace_back("in situ share of wall time");
  return columns;
}

void HistorySink::start(const RunStart& run) {
  gauges_ = run.gauges.size();
  std::string header;
  for (const std::string& column : history_columns(run.gauges, run.insitu)) {
    if (!header.empty()) header += ',';
    header += quoted(column);
  }
  file_.emplace(path_);
  file_->append_line(header);
}

std::vector<double> history_values(const HistoryRow& row) {
  Numbers numbers;
  numbers.add(row.step);
  numbers.add(row.time);
  numbers.add(row.time_step);
  for (const EnergyTerm& term : kEnergyTerms) numbers.add(row.energy.*term.value);
  numbers.add(row.energy.residual_relative);
  for (const Count& count : kCounts) numbers.add(row.*count.value);
  for (const Vector& vector : kVectors) numbers.add(row.*vector.value);
  numbers.add(row.max_speed);
  numbers.add(row.stress_yy_sum);
  for (const GaugeReading& gauge : row.gauges) {
    for (const GaugeVector& vector : kGaugeVectors) numbers.add(gauge.*vector.value);
  }
  if (row.insitu_share) numbers.add(*row.insitu_share);
  return numbers.take();
}

void HistorySink::history(const HistoryRow& row) {
  DEMAND(file_.has_value() && row.gauges.size() == gauges_, std::to_string(row.gauges.size()) + " gauge readings");
  file_->append_line(fmt::format("{:.17g}", fmt::join(history_values(row), ",")));
}

void HistorySink::finish(const Summary&) {
  if (file_) file_->sync();
}

}  // namespace breccia
