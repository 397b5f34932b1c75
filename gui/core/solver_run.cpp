#include "core/solver_run.hpp"

#include <signal.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcessEnvironment>
#include <QSaveFile>
#include <QThread>

namespace breccia::gui {
namespace {

constexpr int kRemembered = 200;

QStringList environment_of_runs() {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  if (::geteuid() == 0) {  // in a container; Open MPI asks root to say so
    environment.insert("OMPI_ALLOW_RUN_AS_ROOT", "1");
    environment.insert("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  return environment.toStringList();
}

QJsonObject json_of(const RunRecord& r) {
  return {{"folder", r.folder},
          {"case", r.case_file},
          {"ranks", r.ranks},
          {"command", QJsonArray::fromStringList(r.command)},
          {"process", static_cast<qint64>(r.session.leader)},
          {"started", r.session.started}};
}

RunRecord record_of(const QJsonObject& json) {
  RunRecord r;
  r.folder = json["folder"].toString();
  r.case_file = json["case"].toString();
  r.ranks = json["ranks"].toInt(1);
  for (const QJsonValue& word : json["command"].toArray()) r.command << word.toString();
  r.session.leader = static_cast<pid_t>(json["process"].toInt());
  r.session.started = static_cast<qint64>(json["started"].toDouble());
  return r;
}

}  // namespace

SolverRun::SolverRun(RunRecord record, QObject* parent)
    : QObject(parent),
      record_(std::move(record)),
      status_file_(QDir(record_.folder).filePath("status.jsonl")),
      history_file_(QDir(record_.folder).filePath("history.csv")) {
  connect(&timer_, &QTimer::timeout, this, &SolverRun::look);
  timer_.start(kInterval);
  look();
}

QStringList SolverRun::command_line(const Launch& launch, const QString& case_file, const QString& folder, int ranks) {
  QStringList words;
  if (ranks > 1) {
    words << launch.launcher;
    if (ranks > QThread::idealThreadCount()) words << "--oversubscribe";
    words << "-n" << QString::number(ranks);
  }
  return words << launch.program << "run" << case_file << "-o" << folder << "--progress"
               << "none";
}

SolverRun* SolverRun::start(const Launch& launch, const QString& case_file, const QString& folder, int ranks,
                            QString* error, QObject* parent) {
  RunRecord record{folder, case_file, ranks, command_line(launch, case_file, folder, ranks), {}};
  QDir().mkpath(QFileInfo(folder).absolutePath());
  const auto session =
      start_session(record.command, QFileInfo(case_file).absolutePath(), folder + ".log", environment_of_runs(), error);
  if (!session) return nullptr;
  record.session = *session;
  return new SolverRun(record, parent);
}

QString SolverRun::state() const {
  if (alive_) {
    if (stopping_.isValid()) return "stopping";
    return status_.state.isEmpty() ? QString("starting") : status_.over() ? QString("finishing") : status_.state;
  }
  return status_.over() ? status_.state : QString("failed");
}

QString SolverRun::failure() const {
  if (!status_.message.isEmpty()) return status_.message;
  QFile file(log_file());
  if (!file.open(QIODevice::ReadOnly)) return {};
  return QString::fromUtf8(file.readAll().right(4000)).trimmed();
}

void SolverRun::look() {
  (void)take_exit_code(record_.session);
  const bool lived = alive_;
  alive_ = !members_of(record_.session).isEmpty();
  bool restarted = false, status_news = lived != alive_, history_news = false;
  for (const QByteArray& line : status_file_.news()) status_news = read_status(line, status_) || status_news;
  const QList<QByteArray> lines = history_file_.news(&restarted);
  if (restarted) history_.clear();
  for (const QByteArray& line : lines) {
    history_.add_line(line);
    history_news = true;
  }
  std::vector<RunFrame> frames = read_series(record_.folder, "elements");
  const bool frame_news = frames.size() != frames_.size();
  frames_ = std::move(frames);
  if (alive_) go_on_stopping();
  if (status_news) emit status_changed();
  if (history_news) emit history_grew();
  if (frame_news) emit frames_changed();
  if (!alive_ && !told_end_) {
    told_end_ = true;
    timer_.stop();
    emit ended();
  }
}

void SolverRun::ask(const QByteArray& command) {
  QSaveFile file(QDir(record_.folder).filePath("control"));
  if (file.open(QIODevice::WriteOnly)) {
    file.write(command + "\n");
    file.commit();
  }
}

void SolverRun::stop() {
  if (!alive_ || stopping_.isValid()) return;
  stopping_.start();
  // Before it has said anything there is nobody to read the request.
  if (status_.state.isEmpty()) {
    signal_session(record_.session, SIGTERM);
    terminated_ = true;
  } else {
    ask("stop");
  }
  emit status_changed();
}

void SolverRun::go_on_stopping() {
  if (!stopping_.isValid()) return;
  const qint64 waited = stopping_.elapsed();
  if (!terminated_ && waited > patience_.request) {
    terminated_ = true;
    signal_session(record_.session, SIGTERM);
  } else if (waited > (terminated_ ? patience_.terminate : 0) + patience_.request) {
    signal_session(record_.session, SIGKILL);
  }
}

std::vector<RunRecord> RunRegistry::load() const {
  std::vector<RunRecord> records;
  QFile file(file_);
  if (!file.open(QIODevice::ReadOnly)) return records;
  for (const QJsonValue& row : QJsonDocument::fromJson(file.readAll()).array()) {
    RunRecord record = record_of(row.toObject());
    if (QFileInfo::exists(record.folder) || !members_of(record.session).isEmpty()) records.push_back(std::move(record));
  }
  return records;
}

void RunRegistry::add(const RunRecord& record) const {
  QJsonArray rows{json_of(record)};
  for (const RunRecord& other : load())
    if (other.folder != record.folder && rows.size() < kRemembered) rows.append(json_of(other));
  QDir().mkpath(QFileInfo(file_).absolutePath());
  QSaveFile file(file_);
  if (!file.open(QIODevice::WriteOnly)) return;
  file.write(QJsonDocument(rows).toJson());
  file.commit();
}

}  // namespace breccia::gui
