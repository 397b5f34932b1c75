#include "core/run_case.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <algorithm>

#include "core/study.hpp"
#include "core/toml_places.hpp"

namespace breccia::gui {
namespace {

QString copy_of_case(const QString& run_folder) { return QDir(run_folder).filePath("case.toml"); }

bool is_same_file(const QString& a, const QString& b) {
  return QFileInfo(a).exists() && QFileInfo(a).canonicalFilePath() == QFileInfo(b).canonicalFilePath();
}

/// The case that gave a run its name, "CASE-20260131-235959", two folders above it.
QString case_by_name(const QString& run_folder) {
  static const QRegularExpression of_case(R"(^(.+)-\d{8}-\d{6}(-\d+)?$)");
  const QFileInfo folder(run_folder);
  const auto name = of_case.match(folder.fileName());
  return name.hasMatch() ? QFileInfo(folder.path()).dir().filePath(name.captured(1) + ".toml") : QString();
}

/// One named relative to the folder that the solver was started in, which is not recorded: it counts as it was run.
QString case_near(const RunOrigin& origin, const QString& run_folder) {
  for (const char* up : {"..", "../.."}) {
    QFile file(QDir(run_folder).filePath(QString("%1/%2").arg(up, origin.case_name)));
    if (!origin.case_name.isEmpty() && QFileInfo(file).isFile() && file.open(QIODevice::ReadOnly) &&
        !was_run_with_another(run_folder, file.readAll()))
      return QDir::cleanPath(file.fileName());
  }
  return {};
}

}  // namespace

QString case_of_run(const RunRecord& record) {
  const RunOrigin origin = origin_of(record.folder);
  const QString above = QFileInfo(record.folder).path();
  const auto study = QFileInfo(QDir(above).filePath("study.json")).isFile() ? load_study(above) : std::nullopt;
  const QStringList known{record.case_file, study ? study->case_file : QString(),
                          QDir::isAbsolutePath(origin.case_file) ? origin.case_file : QString(),
                          case_by_name(record.folder), case_near(origin, record.folder)};
  const auto found = std::find_if(known.begin(), known.end(),
                                  [](const QString& file) { return !file.isEmpty() && QFileInfo(file).isFile(); });
  if (found != known.end()) return *found;
  return case_text_of(record.folder).isEmpty() ? QString() : copy_of_case(record.folder);
}

bool is_run_of(const RunRecord& record, const QString& case_file, const QByteArray& text) {
  if (is_same_file(case_of_run(record), case_file) || is_run_with(record, case_file, text)) return true;
  const std::vector<RunOrigin> own = runs_beside(case_file);
  return std::any_of(own.begin(), own.end(), [&](const RunOrigin& run) { return run.folder == record.folder; });
}

bool is_run_with(const RunRecord& record, const QString& case_file, const QByteArray& text) {
  if (record.case_file == case_file || copy_of_case(record.folder) == case_file) return true;
  if (!text.isEmpty() && case_text_of(record.folder) == text) return true;
  return !origin_of(record.folder).case_file.isEmpty() && !was_run_with_another(record.folder, text);
}

bool writes_elements(const QString& run_folder) {
  return TomlPlaces(case_text_of(run_folder).toStdString()).value("output.elements") != "false";
}

}  // namespace breccia::gui
