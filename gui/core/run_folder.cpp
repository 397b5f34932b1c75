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
#include <limits>

#include "system/regular_file.hpp"

namespace breccia::gui {

namespace {

constexpr qint64 kMostAtOnce = 1 << 20, kRemembered = 64;  // bytes

/// The case among the inputs of a run: the first that is one. A geometry may stand before it, and that of another run
/// from which it goes on behind it.
QJsonObject case_among(const QJsonObject& provenance) {
  for (const QJsonValue& input : provenance["inputs"].toArray()) {
    if (input.toObject()["file"].toString().endsWith(".toml")) return input.toObject();
  }
  return {};
}

/// Opens a file of a run's folder, which may be another's: no link, pipe or device. False where that cannot be done.
bool open_in_run(const QString& path, Depth depth, QFile& file) {
  Opened opened = open_regular(QFile::encodeName(path).toStdString(), O_RDONLY, depth);
  return opened && file.open(opened.descriptor.release(), QIODevice::ReadOnly, QFileDevice::AutoCloseHandle);
}

/// Empty: there is none that can be read.
QJsonObject json_in_run(const QString& path, Depth depth) {
  QFile file;
  if (!open_in_run(path, depth, file)) return {};
  return QJsonDocument::fromJson(file.readAll()).object();
}

QJsonObject provenance_of(const QString& run_folder) {
  return json_in_run(QDir(run_folder).filePath("provenance.json"), Depth::file);
}

/// Whether a file of one of a run's folders is a regular one, reached without a link.
bool is_regular_in_run(const QString& path) {
  QFile file;
  return open_in_run(path, Depth::subfolder, file);
}

}  // namespace

QList<QByteArray> GrowingFile::news(bool* restarted) {
  QFile file;
  has_more_ = false;
  if (restarted != nullptr) *restarted = false;
  if (!open_in_run(path_, Depth::file, file)) return {};
  if (read_ > 0) {
    const bool same = file.size() >= read_ && file.seek(read_ - last_.size()) && file.read(last_.size()) == last_;
    if (restarted != nullptr) *restarted = !same;
    if (!same) read_ = 0;
  }
  if (read_ == 0 && tail_ >= 0 && file.size() > tail_) {
    if (!file.seek(file.size() - tail_)) return {};
    read_ = file.size() - tail_ + file.readLine().size();
  }
  if (file.size() == read_ || !file.seek(read_)) return {};
  QByteArray bytes = file.read(kMostAtOnce);
  if (!bytes.contains('\n')) bytes += file.readLine();  // one line that is longer than all that
  const auto end = bytes.lastIndexOf('\n');
  if (end < 0) return {};
  read_ += end + 1;
  last_ = bytes.left(end + 1).right(kRemembered);
  has_more_ = !file.atEnd();
  return bytes.left(end).split('\n');
}

RunProgress::RunProgress(const QString& run_folder) : file_(QDir(run_folder).filePath("status.jsonl"), kStatusTail) {}

const RunStatus& RunProgress::look() {
  for (const QByteArray& line : file_.news()) (void)read_status(line, status_);
  return status_;
}

void History::clear() {
  columns_.clear();
  values_.clear();
  largest_.clear();
  rows_ = 0;
}

void History::add_line(const QByteArray& line) {
  if (columns_.isEmpty()) {
    columns_ = QString::fromUtf8(line).trimmed().split(',');
    values_.assign(static_cast<std::size_t>(columns_.size()), {});
    largest_.assign(static_cast<std::size_t>(columns_.size()), 0);
    return;
  }
  const QList<QByteArray> cells = line.split(',');
  if (cells.size() != columns_.size()) return;
  for (int c = 0; c < cells.size(); ++c) {
    bool good = false;
    const double value = cells[c].toDouble(&good);
    const auto column = static_cast<std::size_t>(c);
    values_[column].push_back(good ? value : std::numeric_limits<double>::quiet_NaN());
    if (good && std::isfinite(value)) largest_[column] = std::max(largest_[column], std::abs(value));
  }
  ++rows_;
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

bool read_status(const QByteArray& line, RunStatus& out) {
  const QJsonObject json = QJsonDocument::fromJson(line).object();
  if (!json.contains("state")) return false;
  out.state = json["state"].toString();
  out.stage = json["stage"].toString();
  out.message = json["message"].toString();
  out.step = json["step"].toDouble();
  out.steps_total = json["steps_total"].toDouble();
  out.time = json["time"].toDouble();
  out.end = json["end"].toDouble();
  out.share = json["share"].toDouble();
  out.wall = json["wall_s"].toDouble();
  out.eta = json["eta_s"].toDouble(-1);
  out.residual = json["energy_residual"].toDouble();
  out.speed = json["element_steps_per_s"].toDouble();
  out.imbalance = json["imbalance"].toDouble(1);
  out.broken_joints = json["broken_joints"].toDouble();
  out.fragments = json["fragments"].toDouble();
  return true;
}

std::vector<RunFrame> read_series(const QString& run_folder, const QString& part) {
  const QDir frames(QDir(run_folder).filePath("frames"));
  std::vector<RunFrame> found;
  const QJsonArray list = json_in_run(frames.filePath(part + ".hdf.series"), Depth::subfolder)["files"].toArray();
  for (const QJsonValue& entry : list) {
    const QString name = entry.toObject()["name"].toString();
    const QString path = frames.absoluteFilePath(name);
    if (!name.contains('/') && is_regular_in_run(path)) found.push_back({path, entry.toObject()["time"].toDouble()});
  }
  return found;
}

std::vector<RunCheckpoint> read_checkpoints(const QString& run_folder) {
  static const QRegularExpression name(R"(^step_(\d+)\.h5$)");
  const QDir folder(QDir(run_folder).filePath("checkpoints"));
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
  // To take the lock for a look would be in the way of a run that wants it; the system's list is not.
  QFile locks("/proc/locks");
  if (!locks.open(QIODevice::ReadOnly)) return false;
  const QByteArray inode = ":" + QByteArray::number(static_cast<qulonglong>(about.st_ino)) + " ";
  for (const QByteArray& line : locks.readAll().split('\n'))
    if (line.contains(" FLOCK ") && line.contains(inode) && !line.contains("->")) return true;
  return false;
}

QByteArray case_text_of(const QString& run_folder) {
  QFile file;
  return open_in_run(QDir(run_folder).filePath("case.toml"), Depth::file, file) ? file.readAll() : QByteArray();
}

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
  // Of those that do not tell when, the names do.
  const auto when = [](const RunOrigin& run) { return run.started.isValid() ? run.started.toMSecsSinceEpoch() : 0; };
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return when(a) > when(b); });
  return found;
}

}  // namespace breccia::gui
