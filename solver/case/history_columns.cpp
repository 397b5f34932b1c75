#include "case/history_columns.hpp"

#include <array>
#include <cctype>
#include <utility>

namespace breccia::case_ {
namespace {

using Columns = std::vector<HistoryColumn>;
using NamedUnit = std::pair<const char*, const char*>;  ///< name, unit

constexpr std::array<const char*, 15> kEnergies{
    "kinetic",      "elastic",        "joint elastic",      "contact stored",   "joint mode 1",
    "joint mode 2", "joint friction", "contact dissipated", "contact friction", "plastic",
    "viscous",      "damping",        "external work",      "step change",      "residual"};
constexpr std::array<const char*, 7> kCounts{"damaged joints", "broken joints", "broken in mode I", "broken in mode II",
                                             "fragments",      "couples",       "contacts"};
constexpr std::array<const char*, 3> kAreas{"broken area", "broken area in mode I", "broken area in mode II"};
constexpr std::array<NamedUnit, 2> kVectors{{{"momentum", "kg m/s"}, {"angular momentum", "kg m2/s"}}};
constexpr std::array<NamedUnit, 10> kOfGroups{{{"reaction", "N"},
                                               {"contact force", "N"},
                                               {"displacement", "m"},
                                               {"max displacement", "m"},
                                               {"velocity", "m/s"},
                                               {"centre", "m"},
                                               {"momentum", "kg m/s"},
                                               {"spin", "rad/s"},
                                               {"resultant force", "N"},
                                               {"resultant torque", "N m"}}};
constexpr std::array<NamedUnit, 2> kOfPoints{{{"displacement", "m"}, {"velocity", "m/s"}}};
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
constexpr std::array<const char*, 6> kStresses{"xx", "yy", "zz", "xy", "yz", "xz"};

void add_vector(const std::string& gauge, const NamedUnit& vector, Columns& columns) {
  for (const char* axis : kAxes) columns.push_back({gauge, std::string(vector.first) + " " + axis, vector.second});
}

void add_point(const std::string& gauge, Columns& columns) {
  for (const NamedUnit& vector : kOfPoints) add_vector(gauge, vector, columns);
  for (const char* stress : kStresses) columns.push_back({gauge, std::string("stress ") + stress, "Pa"});
}

std::string word_of(const std::string& text) {
  std::string word;
  for (const char c : text) {
    const auto sign = static_cast<unsigned char>(c);
    const bool kept = std::isalnum(sign) != 0 || c == '.' || sign >= 0x80;
    if (kept)
      word += c;
    else if (!word.empty() && word.back() != '_')
      word += '_';
  }
  if (!word.empty() && word.back() == '_') word.pop_back();
  return word;
}

}  // namespace

std::string HistoryColumn::word() const {
  return gauge.empty() ? word_of(quantity) : word_of(gauge) + "." + word_of(quantity);
}

Columns columns_of(const Gauge& gauge) {
  Columns columns;
  switch (gauge.kind) {
    case GaugeKind::point:
      add_point(gauge.name, columns);
      break;
    case GaugeKind::line:
      for (int i = 1; i <= gauge.points; ++i) add_point(gauge.name + " " + std::to_string(i), columns);
      break;
    case GaugeKind::extensometer:
      columns = {{gauge.name, "elongation", "m"}, {gauge.name, "strain"}};
      break;
    case GaugeKind::cracks:
      columns = {{gauge.name, "broken joints"}};
      break;
  }
  return columns;
}

Columns history_columns(const std::vector<std::string>& groups, const std::vector<Gauge>& gauges) {
  Columns columns{{"", "step"}, {"", "time", "s"}, {"", "time step", "s"}};
  for (const char* energy : kEnergies) columns.push_back({"", energy, "J"});
  columns.push_back({"", "relative residual"});
  for (const char* count : kCounts) columns.push_back({"", count});
  for (const char* area : kAreas) columns.push_back({"", area, "m2"});
  for (const NamedUnit& vector : kVectors) add_vector("", vector, columns);
  columns.push_back({"", "max speed", "m/s"});
  columns.push_back({"", "sum of |stress yy|", "Pa"});
  for (const std::string& group : groups) {
    for (const NamedUnit& vector : kOfGroups) add_vector(group, vector, columns);
  }
  for (const Gauge& gauge : gauges) {
    const Columns own = columns_of(gauge);
    columns.insert(columns.end(), own.begin(), own.end());
  }
  return columns;
}

}  // namespace breccia::case_
