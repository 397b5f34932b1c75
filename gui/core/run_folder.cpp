#include "core/run_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <optional>

#include "run_folder/content.hpp"
#include "run_folder/names.hpp"
#include "run_folder/series.hpp"
#include "run_folder/status.hpp"
#include "system/open_regular.hpp"

namespace breccia::gui {

namespace {

/// The case among the inputs of a run: the first that is one. A geometry may precede it, and that of the parent run may
/// follow.
QJsonObject case_among(const QJsonObject& provenance) {
  for (const QJsonValue& input : provenance["inputs"].toArray()) {
    if (input.toObject()["file"].toString().endsWith(".toml")) return input.toObject();
  }
  return {};
}

std::filesystem::path path_of(const QString& file) { return QFile::encodeName(file).toStdString(); }

/// Content of a file of a run's folder, which may be another's: no link, pipe or device is opened. Null: there is none
/// that can be read.
QByteArray content_in_run(const QString& folder, const char* name) {
  const run_folder::Content content = run_folder::read_content(path_in_run(folder, name));
  return content.is_missing || !content.problem.empty() ? QByteArray() : QByteArray::fromStdString(content.text);
}

QJsonObject provenance_of(const QString& run_folder) {
  return QJsonDocument::fromJson(content_in_run(run_folder, run_folder::kProvenance)).object();
}

/// Whether a file of one of a run's folders is a regular one, reached without a link.
bool is_regular_in_run(const QString& path) {
  return static_cast<bool>(open_regular(path_of(path), O_RDONLY, Depth::subfolder));
}

}  // namespace

std::filesystem::path path_in_run(const QString& run_folder, const char* name) { return path_of(run_folder) / name; }

RunProgress::RunProgress(const QString& run_folder)
    : file_(path_in_run(run_folder, run_folder::kStatus), run_folder::kStatusTail) {}

const RunStatus& RunProgress::look() {
  for (const std::string& line : file_.news().lines) (void)read_status(line, status_);
  return status_;
}

void History::clear() {
  table_ = {};
  columns_.clear();
  largest_.clear();
}

void History::add_line(std::string_view line) {
  const int had = rows();
  (void)table_.add_line(line, run_folder::OddFields::read_as_nan);  // the other columns are kept
  if (columns_.isEmpty()) {
    for (const std::string& name : table_.names) columns_ << QString::fromStdString(name);
    largest_.assign(table_.names.size(), 0);
  }
  for (std::size_t c = 0; rows() > had && c < largest_.size(); ++c) {
    const double value = table_.columns[c].back();
    if (std::isfinite(value)) largest_[c] = std::max(largest_[c], std::abs(value));
  }
}

QByteArray histories_csv(const std::vector<std::pair<QString, const History*>>& runs) {
  QList<QByteArray> head;
  int rows = 0;
  for (const auto& [name, history] : runs) {
    for (const QString& column : history->columns()) {
      QString title = runs.size() > 1 ? name + ": " + column : column;
      if (title.contains(',') || title.contains('"')) title = '"' + title.replace('"', "\"\"") + '"';
      head << title.toUtf8();
    }
    rows = std::max(rows, history->rows());
  }
  QByteArray text = head.join(',') + '\n';
  for (int row = 0; row < rows; ++row) {
    QList<QByteArray> cells;
    for (const auto& [name, history] : runs)
      for (int c = 0; c < history->columns().size(); ++c)
        cells << (row < history->rows() ? QByteArray::number(history->values(c)[static_cast<std::size_t>(row)], 'g', 17)
                                        : QByteArray());
    text += cells.join(',') + '\n';
  }
  return text;
}

bool read_status(std::string_view line, RunStatus& out) {
  const std::optional<run_folder::Status> status = run_folder::parse_status_line(line).status;
  if (!status) return false;
  const auto number = [](double value, double otherwise = 0) { return std::isfinite(value) ? value : otherwise; };
  out.state = QString::fromStdString(status->state);
  out.stage = QString::fromStdString(status->stage);
  out.message = QString::fromStdString(status->message);
  out.step = number(status->step);
  out.steps_total = number(status->steps_total);
  out.time = number(status->time);
  out.end = number(status->end);
  out.share = number(status->share);
  out.wall = number(status->wall);
  out.eta = number(status->eta, -1);
  out.residual = number(status->energy_residual);
  out.speed = number(status->element_steps_per_s);
  out.imbalance = number(status->imbalance, 1);
  out.broken_joints = number(status->broken_joints);
  out.fragments = number(status->fragments);
  return true;
}

bool RunStatus::over() const { return run_folder::is_end(state.toStdString()); }

std::vector<RunFrame> read_series(const QString& run_folder, const QString& part) {
  const QDir frames(QDir(run_folder).filePath(run_folder::kFrames));
  const QString index = frames.filePath(part + run_folder::kSeriesEnding.data());
  std::vector<RunFrame> found;
  for (const run_folder::SeriesFrame& frame :
       run_folder::parse_series(run_folder::read_content(path_of(index), Depth::subfolder).text).frames) {
    const QString path = frames.absoluteFilePath(QString::fromStdString(frame.name));
    if (is_regular_in_run(path)) found.push_back({path, frame.time});
  }
  return found;
}

std::vector<RunCheckpoint> read_checkpoints(const QString& run_folder) {
  static const QRegularExpression name(R"(^step_(\d+)\.h5$)");
  const QDir folder(QDir(run_folder).filePath(run_folder::kCheckpoints));
  std::vector<RunCheckpoint> found;
  for (const QString& file : folder.entryList({"step_*.h5"}, QDir::Files))
    if (const auto match = name.match(file); match.hasMatch() && is_regular_in_run(folder.absoluteFilePath(file)))
      found.push_back({folder.absoluteFilePath(file), match.captured(1).toLongLong()});
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.step > b.step; });
  return found;
}

bool is_held(const QString& run_folder) {
  struct stat about {};
  if (::stat(QFile::encodeName(QDir(run_folder).filePath("run.lock")).constData(), &about) != 0) return false;
  // Taking the lock for a check would block a run that needs it; the system's list does not.
  QFile locks("/proc/locks");
  if (!locks.open(QIODevice::ReadOnly)) return false;
  const QByteArray inode = ":" + QByteArray::number(static_cast<qulonglong>(about.st_ino)) + " ";
  for (const QByteArray& line : locks.readAll().split('\n'))
    if (line.contains(" FLOCK ") && line.contains(inode) && !line.contains("->")) return true;
  return false;
}

QByteArray case_text_of(const QString& run_folder) { return content_in_run(run_folder, run_folder::kCaseFile); }

bool was_run_with_another(const QString& run_folder, const QByteArray& case_text) {
  const QString sum = case_among(provenance_of(run_folder))["sha256"].toString();
  return !sum.isEmpty() && sum != QCryptographicHash::hash(case_text, QCryptographicHash::Sha256).toHex();
}

bool is_run_folder(const QString& folder) { return provenance_of(folder)["program"] == "breccia"; }

RunOrigin origin_of(const QString& run_folder) {
  RunOrigin origin{QDir(run_folder).absolutePath(), {}, 1, {}, {}};
  const QJsonObject json = provenance_of(run_folder);
  origin.started = QDateTime::fromString(json["started"].toString(), Qt::ISODate);
  origin.ranks = json["ranks"].toInt(1);
  origin.case_file = case_among(json)["file"].toString();
  origin.case_name = QFileInfo(origin.case_file).fileName();
  return origin;
}

std::vector<RunOrigin> runs_beside(const QString& case_file) {
  const QFileInfo file(case_file);
  const QDir runs(file.dir().filePath("runs"));
  const QRegularExpression own("^" + QRegularExpression::escape(file.completeBaseName()) + R"(-\d{8}-\d{6}(-\d+)?$)");
  std::vector<RunOrigin> found;
  for (const QString& name : runs.entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name | QDir::Reversed)) {
    const QString folder = runs.absoluteFilePath(name);
    if (!is_run_folder(folder)) continue;
    RunOrigin origin = origin_of(folder);
    if (own.match(name).hasMatch() || origin.case_name == file.fileName()) found.push_back(std::move(origin));
  }
  // Without a start time, the names give it.
  const auto when = [](const RunOrigin& run) { return run.started.isValid() ? run.started.toMSecsSinceEpoch() : 0; };
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return when(a) > when(b); });
  return found;
}

}  // namespace breccia::gui
