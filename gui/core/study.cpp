#include "core/study.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>

#include "case/reader.hpp"
#include "case/units.hpp"
#include "core/value_text.hpp"
#include "core/written_file.hpp"
#include "run_folder/history.hpp"
#include "run_folder/names.hpp"

namespace breccia::gui {
namespace {

const QString kRanks = "ranks";
constexpr int kMostRanks = 4096;

/// What stands behind "=" of an override. A number of the geometry has no row in the table of keys: it is written as
/// any other quantity.
QString toml_of(const QString& key, const QString& typed) {
  const case_::Key* row = case_::find_key(case_::pattern_of(key.toStdString()));
  return typed_value(row != nullptr ? *row : case_::key_of("material[].young"), typed);
}

/// All combinations of values.
std::vector<QStringList> combinations(const std::vector<StudyParameter>& parameters) {
  std::vector<QStringList> rows{QStringList()};
  for (const StudyParameter& parameter : parameters) {
    std::vector<QStringList> next;
    for (const QStringList& row : rows)
      for (const QString& value : parameter.values) next.push_back(row + QStringList(value));
    rows = std::move(next);
  }
  return rows;
}

void check_parameters(const Study& study, QStringList& problems) {
  std::size_t runs = 1;
  QStringList keys;
  for (const StudyParameter& p : study.parameters) {
    if (p.values.isEmpty()) problems << QObject::tr("%1: has no values; type them as \"70 GPa; 75 GPa\"").arg(p.key);
    if (keys.contains(p.key)) problems << QObject::tr("%1: stands there twice").arg(p.key);
    keys << p.key;
    runs *= static_cast<std::size_t>(p.values.size());
    if (p.key != kRanks) continue;
    for (const QString& value : p.values) {
      bool good = false;
      const int n = value.toInt(&good);
      if (!good || n < 1 || n > kMostRanks)
        problems << QObject::tr("ranks: allowed is a whole number from 1 to %1, given: %2").arg(kMostRanks).arg(value);
    }
  }
  if (study.parameters.empty()) problems << QObject::tr("choose a key and its values");
  if (runs > kMostStudyRuns)
    problems << QObject::tr("%1 runs are more than a study may have: %2").arg(runs).arg(kMostStudyRuns);
}

RunWish wish_of(const Document& document, const Study& study, const QStringList& values, const QString& folder) {
  RunWish wish{document.file(), folder, document.text(), study.ranks, {}, {}};
  QStringList words;
  for (std::size_t p = 0; p < study.parameters.size(); ++p) {
    const StudyParameter& parameter = study.parameters[p];
    const QString& value = values[static_cast<int>(p)];
    words << parameter.name() + " = " + value;
    if (parameter.key == kRanks) {
      wish.ranks = value.toInt();
    } else {
      wish.overrides << parameter.key + "=" + toml_of(parameter.key, value);
    }
  }
  wish.words = words.join(", ");
  return wish;
}

void check_case(const RunWish& wish, QStringList& problems) {
  std::vector<std::string> overrides;
  for (const QString& value : wish.overrides) overrides.push_back(value.toStdString());
  try {
    (void)case_::read_case_text(wish.text.toStdString(), wish.case_file.toStdString(), overrides);
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) problems << QString::fromStdString(p.text());
  }
}

/// The last whole row of a run's history, by its columns.
void read_last_row(const QString& run_folder, StudyResult& result) {
  const run_folder::History history = run_folder::last_row_of(path_in_run(run_folder, run_folder::kHistory));
  for (std::size_t c = 0; history.rows() > 0 && c < history.names.size(); ++c) {
    result.columns << QString::fromStdString(history.names[c]);
    result.values.push_back(history.columns[c].front());
  }
}

QByteArray cell(QString text) {
  if (text.contains(',') || text.contains('"')) text = '"' + text.replace('"', "\"\"") + '"';
  return text.toUtf8();
}

QByteArray cell(std::optional<double> value) { return value ? QByteArray::number(*value, 'g', 17) : QByteArray(); }

}  // namespace

QStringList study_values(const QString& typed) {
  QStringList values;
  for (const QString& value : typed.split(';'))
    if (!value.trimmed().isEmpty()) values << value.trimmed();
  return values;
}

std::optional<double> number_of(const QString& typed) {
  try {
    return case_::parse_quantity(typed.toStdString()).value;
  } catch (const case_::UnitError&) {
    return {};
  }
}

QStringList study_keys(const Document& document) {
  QStringList keys{kRanks};
  for (const Place& place : document.places().all()) {
    const case_::Key* row = case_::find_key(case_::pattern_of(place.path));
    const bool number = place.path.starts_with("mesh.parameters.");
    const bool value = place.kind == Place::Kind::value && row != nullptr && !row->is_section() &&
                       row->type != case_::ValueType::text && row->type != case_::ValueType::text_pair;
    if (number || value) keys << QString::fromStdString(place.path);
  }
  for (const case_::Key& key : case_::schema())  // choices that the case leaves to the defaults
    if (key.type == case_::ValueType::choice && key.path.find('[') == std::string_view::npos)
      keys << QString::fromStdString(std::string(key.path));
  keys.removeDuplicates();
  return keys;
}

std::vector<RunWish> plan_study(const Document& document, Study& study, QStringList* problems) {
  problems->clear();
  check_parameters(study, *problems);
  if (!problems->isEmpty()) return {};
  study.case_file = document.file();
  study.runs.clear();
  std::vector<RunWish> wishes;
  for (const QStringList& values : combinations(study.parameters)) {
    const QString number = QString::number(study.runs.size() + 1).rightJustified(3, '0');
    study.runs.push_back({QDir(study.folder).filePath(number), values});
    wishes.push_back(wish_of(document, study, values, study.runs.back().folder));
    check_case(wishes.back(), *problems);
  }
  problems->removeDuplicates();
  return problems->isEmpty() ? wishes : std::vector<RunWish>();
}

QString save_study(const Study& study) {
  QJsonArray parameters, runs;
  for (const StudyParameter& p : study.parameters)
    parameters.append(QJsonObject{{"key", p.key}, {"values", QJsonArray::fromStringList(p.values)}});
  for (const StudyRun& run : study.runs)
    runs.append(QJsonObject{{"folder", QDir(study.folder).relativeFilePath(run.folder)},
                            {"values", QJsonArray::fromStringList(run.values)}});
  const QJsonObject json{{"case", study.case_file}, {"ranks", study.ranks}, {"parameters", parameters}, {"runs", runs}};
  return written(QDir(study.folder).filePath("study.json"), QJsonDocument(json).toJson());
}

std::optional<Study> load_study(const QString& folder) {
  QFile file(QDir(folder).filePath("study.json"));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QJsonObject json = QJsonDocument::fromJson(file.readAll()).object();
  const auto words = [](const QJsonValue& list) {
    QStringList out;
    for (const QJsonValue& word : list.toArray()) out << word.toString();
    return out;
  };
  Study study{folder, json["case"].toString(), json["ranks"].toInt(1), {}, {}};
  for (const QJsonValue& row : json["parameters"].toArray())
    study.parameters.push_back({row.toObject()["key"].toString(), words(row.toObject()["values"])});
  for (const QJsonValue& row : json["runs"].toArray()) {
    const QStringList values = words(row.toObject()["values"]);
    if (values.size() != static_cast<int>(study.parameters.size())) return {};
    study.runs.push_back({QDir(folder).filePath(row.toObject()["folder"].toString()), values});
  }
  if (study.parameters.empty() || study.runs.empty()) return {};
  return study;
}

QStringList find_studies(const QString& runs_folder, const QString& case_file) {
  QStringList found;
  const QDir runs(runs_folder);
  for (const QString& name : runs.entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name | QDir::Reversed))
    if (const auto study = load_study(runs.absoluteFilePath(name)); study && study->case_file == case_file)
      found << study->folder;
  return found;
}

std::optional<double> StudyResult::value(const QString& column) const {
  const auto at = columns.indexOf(column);
  if (at < 0) return {};
  return values[static_cast<std::size_t>(at)];
}

std::vector<StudyResult> study_results(const Study& study, const QueueContents& queue) {
  std::vector<StudyResult> results;
  for (const StudyRun& run : study.runs) {
    StudyResult result;
    const auto row = std::find_if(queue.runs.begin(), queue.runs.end(),
                                  [&](const QueuedRun& r) { return r.record.folder == run.folder; });
    const RunOutcome outcome = outcome_of(run.folder);
    const bool said = !outcome.last.state.isEmpty();
    const QString own = is_held(run.folder) ? "running" : said ? outcome.state : QObject::tr("not run");
    result.state = row != queue.runs.end() && !said ? row->state : own;
    if (said && result.state != "waiting") {
      result.columns = QStringList{"wall time [s]", "steps"};
      result.values = {outcome.last.wall, outcome.last.step};
      read_last_row(run.folder, result);
    }
    results.push_back(std::move(result));
  }
  return results;
}

StudyPlot study_plot(const Study& study, const std::vector<StudyResult>& results, const QString& column) {
  const StudyParameter& first = study.parameters.front();
  const case_::Key* row = case_::find_key(case_::pattern_of(first.key.toStdString()));
  const bool words = !std::all_of(first.values.begin(), first.values.end(),
                                  [](const QString& value) { return number_of(value).has_value(); });
  StudyPlot plot;
  plot.x_title = words || first.key == kRanks
                     ? first.key
                     : QString("%1 [%2]").arg(first.key, row == nullptr ? QString("SI") : text_of(row->unit));
  if (words) plot.x_words = first.values;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const QStringList& values = study.runs[i].values;
    const QString name = study.parameters.size() < 2 ? column : study.parameters[1].name() + " = " + values[1];
    auto line = std::find_if(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& l) { return l.name == name; });
    if (line == plot.lines.end()) line = plot.lines.insert(line, {name, {}, {}});
    const std::optional<double> y = results[i].value(column);
    if (!y) continue;
    line->x.push_back(words ? static_cast<double>(first.values.indexOf(values[0])) : *number_of(values[0]));
    line->y.push_back(*y);
  }
  return plot;
}

QByteArray study_csv(const Study& study, const std::vector<StudyResult>& results) {
  QList<QByteArray> head;
  QStringList columns;
  for (const StudyParameter& p : study.parameters) head << cell(p.key) << cell(p.key + " (SI)");
  head << "state";
  for (const StudyResult& result : results) columns += result.columns;
  columns.removeDuplicates();
  for (const QString& column : columns) head << cell(column);
  QByteArray text = head.join(',') + '\n';
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    QList<QByteArray> row;
    for (const QString& value : study.runs[i].values) row << cell(value) << cell(number_of(value));
    row << cell(results[i].state);
    for (const QString& column : columns) row << cell(results[i].value(column));
    text += row.join(',') + '\n';
  }
  return text;
}

}  // namespace breccia::gui
