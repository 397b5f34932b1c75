#include "core/run_folder.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <limits>

namespace breccia::gui {

QList<QByteArray> GrowingFile::news(bool* restarted) {
  QFile file(path_);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const bool shorter = file.size() < read_;
  if (shorter) read_ = 0;
  if (restarted != nullptr) *restarted = shorter;
  if (file.size() == read_ || !file.seek(read_)) return {};
  const QByteArray bytes = file.readAll();
  const auto end = bytes.lastIndexOf('\n');
  if (end < 0) return {};
  read_ += end + 1;
  QList<QByteArray> lines = bytes.left(end).split('\n');
  return lines;
}

void History::clear() {
  columns_.clear();
  values_.clear();
  rows_ = 0;
}

void History::add_line(const QByteArray& line) {
  if (columns_.isEmpty()) {
    columns_ = QString::fromUtf8(line).trimmed().split(',');
    values_.assign(static_cast<std::size_t>(columns_.size()), {});
    return;
  }
  const QList<QByteArray> cells = line.split(',');
  if (cells.size() != columns_.size()) return;
  for (int c = 0; c < cells.size(); ++c) {
    bool good = false;
    const double value = cells[c].toDouble(&good);
    values_[static_cast<std::size_t>(c)].push_back(good ? value : std::numeric_limits<double>::quiet_NaN());
  }
  ++rows_;
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
  QFile file(frames.filePath(part + ".hdf.series"));
  std::vector<RunFrame> found;
  if (!file.open(QIODevice::ReadOnly)) return found;
  const QJsonArray list = QJsonDocument::fromJson(file.readAll()).object()["files"].toArray();
  for (const QJsonValue& entry : list) {
    const QString path = frames.absoluteFilePath(entry.toObject()["name"].toString());
    if (QFileInfo::exists(path)) found.push_back({path, entry.toObject()["time"].toDouble()});
  }
  return found;
}

bool is_run_folder(const QString& folder) {
  QFile file(QDir(folder).filePath("provenance.json"));
  return file.open(QIODevice::ReadOnly) && QJsonDocument::fromJson(file.readAll()).object()["program"] == "breccia";
}

}  // namespace breccia::gui
