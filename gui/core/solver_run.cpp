#include "core/solver_run.hpp"

#include <signal.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLockFile>
#include <QProcessEnvironment>
#include <QRegularExpression>
#include <QSaveFile>
#include <QThread>
#include <algorithm>
#include <cerrno>

#include "core/written_file.hpp"
#include "run_folder/names.hpp"

namespace breccia::gui {
namespace {

constexpr int kRunsRemembered = 200;
constexpr int kPollsAfterEnd = 3;

/// The library that keeps what a process listens at on this machine; empty: it is not installed.
QString loopback_library(const QStringList& command) {
  for (const QString& word : command) {
    const QDir above(QFileInfo(word).absolutePath() + "/..");
    for (const char* place : {"catalyst", "lib/breccia"}) {
      const QString file = above.filePath(QString(place) + "/libbreccia_loopback.so");
      if (QFileInfo(word).isExecutable() && QFileInfo(file).isFile()) return QFileInfo(file).canonicalFilePath();
    }
  }
  return {};
}

/// All ranks are of this machine: mpiexec, which would listen to networks for daemons of others, need not.
QStringList environment_of_runs(const RunRecord& record) {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  if (::geteuid() == 0) {  // in a container; Open MPI requires this of root
    environment.insert("OMPI_ALLOW_RUN_AS_ROOT", "1");
    environment.insert("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  if (record.ranks <= 1) return environment.toStringList();
  // As in solver/parallel/mpi_session.cpp: mpiexec, too, ends if it queries an X display that closes.
  if (!environment.contains("HWLOC_COMPONENTS")) environment.insert("HWLOC_COMPONENTS", "-gl");
  const QString library = loopback_library(record.command), others = environment.value("LD_PRELOAD");
  if (!library.isEmpty()) environment.insert("LD_PRELOAD", others.isEmpty() ? library : library + ":" + others);
  return environment.toStringList();
}

QStringList launcher_words(const Launch& launch, int ranks) {
  QStringList words;
  if (ranks <= 1) return words;
  words << launch.launcher;
  if (ranks > QThread::idealThreadCount()) words << "--oversubscribe";
  return words << "-n" << QString::number(ranks);
}

/// Runs the command of a record, and watches it.
SolverRun* launch_watched(RunRecord record, const QString& folder, QString* error, QObject* parent) {
  return SolverRun::launch(record, folder, error) ? new SolverRun(std::move(record), parent, true) : nullptr;
}

/// State of a run whose process has ended. @param status  the last one that it wrote
QString state_after(const RunStatus& status) {
  if (status.state.isEmpty()) return "failed";
  return status.over() ? status.state : QString("interrupted");
}

QString log_of(const QString& folder) { return folder + ".log"; }

/// Its last message, else the end of its log.
QString last_words(const RunStatus& status, const QString& folder) {
  if (status.over() && !status.message.isEmpty()) return status.message;
  QFile file(log_of(folder));
  if (!file.open(QIODevice::ReadOnly)) return {};
  constexpr qint64 kShown = 4000;
  file.seek(std::max<qint64>(0, file.size() - kShown));
  return QString::fromUtf8(file.readAll()).trimmed();
}

}  // namespace

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

RunOutcome outcome_of(const QString& folder) {
  RunProgress progress(folder);
  const RunStatus& status = progress.look();
  const QString state = state_after(status);
  return {status, state, state == "failed" || state == "interrupted" ? last_words(status, folder) : QString()};
}

SolverRun::SolverRun(RunRecord record, QObject* parent, bool is_new)
    : QObject(parent),
      record_(std::move(record)),
      status_file_(path_in_run(record_.folder, run_folder::kStatus), run_folder::kStatusTail),
      history_file_(path_in_run(record_.folder, run_folder::kHistory)) {
  connect(&timer_, &QTimer::timeout, this, &SolverRun::look);
  timer_.start(kInterval);
  look();
  told_end_ = !is_new && !alive_;
}

QStringList SolverRun::command_line(const Launch& launch, const QString& case_file, const QString& folder, int ranks) {
  return launcher_words(launch, ranks) << launch.program << "run" << case_file << "-o" << folder << "--progress"
                                       << "none";
}

QStringList SolverRun::resume_line(const Launch& launch, const QString& folder, int ranks) {
  return launcher_words(launch, ranks) << launch.program << "resume" << folder << "--progress"
                                       << "none";
}

bool SolverRun::launch(RunRecord& record, const QString& folder, QString* error) {
  const QString parent_folder = QFileInfo(record.folder).absolutePath();
  if (!QDir().mkpath(parent_folder) || !QFileInfo(parent_folder).isWritable()) {
    *error = QObject::tr("the folder %1 cannot be written").arg(parent_folder);
    return false;
  }
  if (!QFileInfo(folder).isDir()) {  // the system would name the program instead
    *error = QObject::tr("the folder %1 is not there").arg(folder);
    return false;
  }
  const auto session = start_session(record.command, folder, log_of(record.folder), environment_of_runs(record), error);
  if (session) record.session = *session;
  return session.has_value();
}

SolverRun* SolverRun::start(const Launch& launch, const QString& case_file, const QString& folder, int ranks,
                            QString* error, QObject* parent) {
  RunRecord record{folder, case_file, ranks, command_line(launch, case_file, folder, ranks), {}};
  SolverRun* run = launch_watched(std::move(record), QFileInfo(case_file).absolutePath(), error, parent);
  if (run != nullptr) run->read_history();
  return run;
}

SolverRun* SolverRun::go_on(const Launch& launch, const RunRecord& ended, int ranks, QString* error, QObject* parent) {
  RunRecord record = ended;
  record.ranks = ranks;
  record.command = resume_line(launch, ended.folder, ranks);
  SolverRun* run = launch_watched(std::move(record), QFileInfo(ended.folder).absolutePath(), error, parent);
  if (run == nullptr) return nullptr;
  run->read_history();
  run->status_ = {};  // the status there is that of the run that has ended
  return run;
}

QString SolverRun::state() const {
  if (alive_) {
    if (stopping_.isValid()) return "stopping";
    if (!awaited_.isEmpty() && !status_.over()) return awaited_ == "paused" ? "pausing" : "resuming";
    return status_.state.isEmpty() ? QString("starting") : status_.over() ? QString("finishing") : status_.state;
  }
  // A run that was stopped before its first status has not failed.
  if (stopping_.isValid() && status_.state.isEmpty()) return "stopped";
  return state_after(status_);
}

QString SolverRun::failure() const { return last_words(status_, record_.folder); }

void SolverRun::read_history() {
  wants_history_ = true;
  if (!timer_.isActive()) timer_.start(kInterval);
  if (look_at_history()) emit history_grew();
}

bool SolverRun::read_more_history() {
  if (look_at_history()) emit history_grew();
  return history_file_.has_more();
}

bool SolverRun::look_at_status() {
  bool news = false;
  for (const std::string& line : status_file_.news().lines) {
    if (!read_status(line, status_)) continue;
    news = true;
    if (status_.state == awaited_) awaited_.clear();
  }
  return news;
}

bool SolverRun::look_at_history() {
  if (!wants_history_) return false;
  const run_folder::GrowingLines::News news = history_file_.news();
  if (news.is_restarted) history_.clear();
  for (const std::string& line : news.lines) history_.add_line(line);
  return news.is_restarted || !news.lines.empty();
}

void SolverRun::look_at_frames() {
  const QFileInfo index(QDir(record_.folder).filePath("frames/elements.hdf.series"));
  const QByteArray mark =
      QByteArray::number(index.lastModified().toMSecsSinceEpoch()) + " " + QByteArray::number(index.size());
  if (mark == series_mark_) return;
  series_mark_ = mark;
  frames_ = read_series(record_.folder, "elements");
  emit frames_changed();
}

void SolverRun::look() {
  (void)take_exit_code(record_.session);
  const bool lived = alive_;
  alive_ = !members_of(record_.session).isEmpty() || is_held(record_.folder);
  const bool status_news = look_at_status(), history_news = look_at_history();
  const std::size_t had = checkpoints_.size();
  const qint64 latest = had > 0 ? checkpoints_.front().step : -1;
  checkpoints_ = read_checkpoints(record_.folder);
  const bool more = had != checkpoints_.size() || (had > 0 && checkpoints_.front().step != latest);
  if (alive_) {
    send_requests();
    go_on_stopping();
  }
  if (status_news || more || lived != alive_) emit status_changed();
  if (history_news) emit history_grew();
  look_at_frames();
  // The last line of a run that was killed is written by a process that outlives it for a moment.
  if (alive_) {
    polls_after_end_ = 0;
    told_end_ = false;
  }
  if (alive_ || ++polls_after_end_ <= kPollsAfterEnd || history_file_.has_more()) return;
  timer_.stop();
  if (told_end_) return;
  told_end_ = true;
  emit ended();
}

void SolverRun::ask(const QByteArray& command) {
  requests_.append(command);
  send_requests();
}

void SolverRun::ask_for(const QByteArray& command, const QString& state) {
  awaited_ = status_.state == state ? QString() : state;
  ask(command);
  emit status_changed();
}

/// The run takes the file away when it has read it. Requests of other programs are not overwritten: a link never
/// replaces a file.
void SolverRun::send_requests() {
  if (requests_.isEmpty()) return;
  const QDir folder(record_.folder);
  const QString own = folder.filePath(QString(".control.gui.%1").arg(::getpid())), control = folder.filePath("control");
  QSaveFile file(own);
  if (!file.open(QIODevice::WriteOnly) || file.write(requests_.join('\n') + "\n") < 0 || !file.flush() ||
      !file.commit())
    return;
  bool sent = ::link(QFile::encodeName(own).constData(), QFile::encodeName(control).constData()) == 0;
  if (!sent && errno != EEXIST)  // a file system without links
    sent = ::rename(QFile::encodeName(own).constData(), QFile::encodeName(control).constData()) == 0;
  QFile::remove(own);
  if (sent) requests_.clear();
}

void SolverRun::stop() {
  if (!alive_ || stopping_.isValid()) return;
  stopping_.start();
  // Before its first status it does not read requests.
  if (status_.state.isEmpty()) {
    signal_session(record_.session, SIGTERM);
    terminated_ = true;
  } else {
    requests_.clear();  // earlier requests are obsolete
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
  std::vector<RunRecord> records, found;
  QFile file(file_);
  if (!file.open(QIODevice::ReadOnly)) return found;
  std::vector<Session> sessions;
  for (const QJsonValue& row : QJsonDocument::fromJson(file.readAll()).array()) {
    records.push_back(record_of(row.toObject()));
    sessions.push_back(records.back().session);
  }
  const std::vector<bool> alive = are_alive(sessions);
  for (std::size_t i = 0; i < records.size(); ++i)
    if (alive[i] || QFileInfo::exists(records[i].folder)) found.push_back(std::move(records[i]));
  return found;
}

QString RunRegistry::add(const RunRecord& record) const {
  QDir().mkpath(QFileInfo(file_).absolutePath());
  QLockFile alone(file_ + ".lock");  // two windows may start runs at once
  (void)alone.tryLock(1000);
  QJsonArray rows{json_of(record)};
  for (const RunRecord& other : load())
    if (other.folder != record.folder && rows.size() < kRunsRemembered) rows.append(json_of(other));
  return written(file_, QJsonDocument(rows).toJson());
}

QString shell_line(const QStringList& command) {
  static const QRegularExpression plain(R"(^[A-Za-z0-9_@%+=:,./-]+$)");
  QStringList words;
  for (QString word : command) {
    if (!plain.match(word).hasMatch()) word = "'" + word.replace("'", R"('\'')") + "'";
    words << word;
  }
  return words.join(' ');
}

}  // namespace breccia::gui
