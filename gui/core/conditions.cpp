#include "core/conditions.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "case/reader.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

constexpr int kSamples = 300;  // of a stage, beside the corners of its tables
constexpr const char* kAxes[] = {"x", "y", "z"};

QString condition_text(const char* words) { return QCoreApplication::translate("conditions", words); }

QString shown(const Document& document, const QString& path) {
  return shown_value(case_::key_of(case_::pattern_of(path.toStdString())), document.value(path));
}

/// Path of an entry in the text, which may be that of several groups.
QString written(const auto& entry) { return QString::fromStdString(entry.origin.key); }

struct Interval {
  double begin = 0, end = 0;  // s
};

PlotLine curve(const QString& name, const TimeFunction& function, const Interval& stage) {
  return sampled(name, function, stage.begin, stage.end);
}

/// The values by axis at the time at which they are largest together.
std::array<double, 3> largest_of(const std::array<TimeFunction, 3>& functions, const Interval& stage) {
  std::array<double, 3> found{};
  double most = 0;
  std::vector<double> times;
  for (int i = 0; i <= kSamples; ++i) times.push_back(stage.begin + (stage.end - stage.begin) * i / kSamples);
  for (const TimeFunction& function : functions)
    for (const TimeFunction::Point& p : function.table)
      if (p.time > stage.begin && p.time < stage.end) times.push_back(p.time);
  for (const double t : times) {
    const std::array<double, 3> now{functions[0](t), functions[1](t), functions[2](t)};
    const double size = std::hypot(now[0], now[1], now[2]);
    if (size <= most) continue;
    most = size;
    found = now;
  }
  return found;
}

Condition constraint(const Document& document, const case_::Constraint& given, Condition row, const Interval& stage) {
  using enum case_::ConstraintKind;
  row.target = QString::fromStdString(given.group);
  const char* key = given.kind == fixed ? "fixed" : given.kind == velocity ? "velocity" : "displacement";
  row.type = condition_text(key);
  row.value = shown(document, row.path + "." + key);
  row.unit = given.kind == velocity ? "m/s" : "m";
  row.axes = given.axes;
  if (given.kind != fixed) row.largest = largest_of(given.value, stage);
  if (given.kind == fixed) return row;
  for (std::size_t a = 0; a < 3; ++a)
    if (given.axes[a]) row.curves.push_back(curve(QString("%1 %2").arg(row.type, kAxes[a]), given.value[a], stage));
  return row;
}

Condition pressure(const Document& document, const case_::Pressure& given, Condition row, const Interval& stage) {
  row.target = QString::fromStdString(given.surface);
  row.type = condition_text("pressure");
  row.follows = true;
  row.value = shown(document, row.path + ".value");
  row.unit = "Pa";
  row.largest = largest_of({given.value, TimeFunction(), TimeFunction()}, stage);
  row.curves = {curve(row.type, given.value, stage)};
  return row;
}

/// What acts along x, y and z. @param functions  by axis
void add_by_axis(const std::array<TimeFunction, 3>& functions, const Interval& stage, Condition& row) {
  row.largest = largest_of(functions, stage);
  for (std::size_t a = 0; a < 3; ++a)
    if (!functions[a].is_zero())
      row.curves.push_back(curve(QString("%1 %2").arg(row.type, kAxes[a]), functions[a], stage));
}

/// A load with a value by axis. @param given  a traction or a force;  @param target  its group
Condition load_by_axis(const Document& document, const auto& given, const std::string& target, Condition row,
                       const Interval& stage) {
  row.target = QString::fromStdString(target);
  row.value = shown(document, row.path + ".value");
  add_by_axis(given.value, stage, row);
  return row;
}

Condition traction(const Document& document, const case_::Traction& given, Condition row, const Interval& stage) {
  row.type = condition_text("traction");
  row.unit = "Pa";
  return load_by_axis(document, given, given.surface, std::move(row), stage);
}

Condition force(const Document& document, const case_::Force& given, Condition row, const Interval& stage) {
  row.type = condition_text("force");
  row.unit = "N";
  return load_by_axis(document, given, given.group, std::move(row), stage);
}

void add_stage(const Document& document, const case_::Stage& stage, int number, const Interval& time,
               std::vector<Condition>& rows) {
  const QString path = QString("stage[%1]").arg(number);
  const QString name = stage.name.empty() ? QString::number(number + 1) : QString::fromStdString(stage.name);
  const auto begun = [&](const QString& own) {
    Condition row;
    row.path = own;
    row.stage = name;
    row.number = number;
    return row;
  };
  if (std::any_of(stage.gravity.begin(), stage.gravity.end(), [](const TimeFunction& f) { return !f.is_zero(); })) {
    Condition row = begun(path);
    row.type = condition_text("gravity");
    row.value = shown(document, path + ".gravity");
    row.unit = "m/s2";
    row.is_gravity = true;
    add_by_axis(stage.gravity, time, row);
    rows.push_back(std::move(row));
  }
  for (const auto& given : stage.constraints) rows.push_back(constraint(document, given, begun(written(given)), time));
  for (const auto& given : stage.pressures) rows.push_back(pressure(document, given, begun(written(given)), time));
  for (const auto& given : stage.tractions) rows.push_back(traction(document, given, begun(written(given)), time));
  for (const auto& given : stage.forces) rows.push_back(force(document, given, begun(written(given)), time));
  for (const std::string& surface : stage.absorbing) {
    Condition row = begun(path);
    row.type = condition_text("absorbing");
    row.absorbs = true;
    row.target = QString::fromStdString(surface);
    row.value = shown(document, path + ".absorbing");
    rows.push_back(std::move(row));
  }
}

/// The parts that are given, each but the velocity of all points alike with its name.
QString parts_of_velocity(const Document& document, const QString& path) {
  const std::array<std::pair<const char*, const char*>, 4> parts{
      {{"velocity", "%1"}, {"random", "random %1"}, {"angular", "spin %1"}, {"strain_rate", "strain rate %1"}}};
  QStringList given;
  for (const auto& [key, words] : parts)
    if (const QString value = shown(document, path + "." + key); !value.isEmpty())
      given << condition_text(words).arg(value);
  return given.join("; ");
}

Condition initial_velocity(const Document& document, const case_::Case& input, const case_::InitialVelocity& given) {
  Condition row;
  const QString path = row.path = written(given);
  row.type = condition_text("initial velocity");
  row.target = QString::fromStdString(given.group);
  row.value = parts_of_velocity(document, path);
  row.unit = "m/s";
  for (std::size_t a = 0; a < 3; ++a) {
    row.largest[a] = given.velocity[static_cast<Eigen::Index>(a)];
    row.turns_by[a] = given.angular[static_cast<Eigen::Index>(a)];
    row.stretches_by[a] = given.strain_rate[static_cast<Eigen::Index>(a)];
  }
  row.random = given.random[1];
  for (const case_::Material& material : input.materials) row.densities[material.group] = material.density;
  return row;
}

}  // namespace

PlotLine sampled(const QString& name, const TimeFunction& function, double begin, double end) {
  PlotLine line{name, {}, {}};
  for (int i = 0; i <= kSamples; ++i) line.x.push_back(begin + (end - begin) * i / kSamples);
  for (const TimeFunction::Point& p : function.table)
    if (p.time > begin && p.time < end) line.x.push_back(p.time);
  std::sort(line.x.begin(), line.x.end());
  for (const double t : line.x) line.y.push_back(function(t));
  return line;
}

std::vector<Condition> conditions_of(const Document& document) {
  std::vector<Condition> rows;
  try {
    const case_::Case input = case_::read_case_text(document.text().toStdString(), document.file().toStdString());
    for (const case_::InitialVelocity& given : input.initial_velocities)
      rows.push_back(initial_velocity(document, input, given));
    Interval time;
    for (std::size_t s = 0; s < input.stages.size(); ++s) {
      time = {time.end, input.stages[s].end};
      add_stage(document, input.stages[s], static_cast<int>(s), time, rows);
    }
  } catch (const InputError&) {
    return {};
  }
  return rows;
}

}  // namespace breccia::gui
