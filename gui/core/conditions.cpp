#include "core/conditions.hpp"

#include <QCoreApplication>
#include <algorithm>

#include "case/reader.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

constexpr int kSamples = 300;  // of a stage, beside the corners of its tables
constexpr const char* kAxes[] = {"x", "y", "z"};

QString text(const char* words) { return QCoreApplication::translate("conditions", words); }

QString shown(const Document& document, const QString& path) {
  return shown_value(case_::key_of(case_::pattern_of(path.toStdString())), document.value(path));
}

struct Interval {
  double begin = 0, end = 0;  // s
};

PlotLine curve(const QString& name, const TimeFunction& function, const Interval& stage) {
  PlotLine line{name, {}, {}};
  for (int i = 0; i <= kSamples; ++i) line.x.push_back(stage.begin + (stage.end - stage.begin) * i / kSamples);
  for (const TimeFunction::Point& p : function.table)
    if (p.time > stage.begin && p.time < stage.end) line.x.push_back(p.time);
  std::sort(line.x.begin(), line.x.end());
  for (const double t : line.x) line.y.push_back(function(t));
  return line;
}

Condition constraint(const Document& document, const case_::Constraint& given, Condition row, const Interval& stage) {
  using enum case_::ConstraintKind;
  row.target = QString::fromStdString(given.group);
  const char* key = given.kind == fixed ? "fixed" : given.kind == velocity ? "velocity" : "displacement";
  row.type = text(key);
  row.value = shown(document, row.path + "." + key);
  row.unit = given.kind == velocity ? "m/s" : "m";
  if (given.kind == fixed) return row;
  for (std::size_t a = 0; a < 3; ++a)
    if (given.axes[a]) row.curves.push_back(curve(QString("%1 %2").arg(row.type, kAxes[a]), given.value[a], stage));
  return row;
}

Condition pressure(const Document& document, const case_::Pressure& given, Condition row, const Interval& stage) {
  row.target = QString::fromStdString(given.surface);
  row.type = text("pressure");
  row.value = shown(document, row.path + ".value");
  row.unit = "Pa";
  row.curves = {curve(row.type, given.value, stage)};
  return row;
}

void add_stage(const Document& document, const case_::Stage& stage, const QString& path, const QString& name,
               const Interval& time, std::vector<Condition>& rows) {
  const auto begun = [&](const QString& own) { return Condition{own, name, {}, {}, {}, {}, {}}; };
  if (std::any_of(stage.gravity.begin(), stage.gravity.end(), [](const TimeFunction& f) { return !f.is_zero(); })) {
    Condition row = begun(path);
    row.type = text("gravity");
    row.value = shown(document, path + ".gravity");
    row.unit = "m/s2";
    for (std::size_t a = 0; a < 3; ++a)
      if (!stage.gravity[a].is_zero())
        row.curves.push_back(curve(QString("%1 %2").arg(row.type, kAxes[a]), stage.gravity[a], time));
    rows.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < stage.constraints.size(); ++i)
    rows.push_back(constraint(document, stage.constraints[i], begun(path + QString(".constraint[%1]").arg(i)), time));
  for (std::size_t i = 0; i < stage.pressures.size(); ++i)
    rows.push_back(pressure(document, stage.pressures[i], begun(path + QString(".pressure[%1]").arg(i)), time));
}

}  // namespace

std::vector<Condition> conditions_of(const Document& document) {
  std::vector<Condition> rows;
  try {
    const case_::Case input = case_::read_case_text(document.text().toStdString(), document.file().toStdString());
    for (int i = 0; i < document.places().count("initial_velocity"); ++i) {
      const QString path = QString("initial_velocity[%1]").arg(i);
      rows.push_back({path,
                      {},
                      text("initial velocity"),
                      shown(document, path + ".group"),
                      shown(document, path + ".velocity"),
                      "m/s",
                      {}});
    }
    Interval time;
    for (std::size_t s = 0; s < input.stages.size(); ++s) {
      const case_::Stage& stage = input.stages[s];
      time = {time.end, stage.end};
      const QString name = stage.name.empty() ? QString::number(s + 1) : QString::fromStdString(stage.name);
      add_stage(document, stage, QString("stage[%1]").arg(s), name, time, rows);
    }
  } catch (const InputError&) {
    return {};
  }
  return rows;
}

}  // namespace breccia::gui
