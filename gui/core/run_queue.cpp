#include "core/run_queue.hpp"

#include <sys/file.h>
#include <sys/stat.h>

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLockFile>
#include <QThread>
#include <algorithm>
#include <cerrno>

#include "core/written_file.hpp"

namespace breccia::gui {
namespace {

constexpr unsigned long kPollInterval = 500;  // ms between two passes of the worker
constexpr int kPatience = 5000;               // ms for the lock of the file

QJsonObject json_of(const QueuedRun& run) {
  QJsonObject json = json_of(run.record);
  json["words"] = run.words;
  json["snapshot"] = run.snapshot;
  json["state"] = run.state;
  json["message"] = run.message;
  if (run.stop_asked) json["stop_asked"] = true;
  return json;
}

QueuedRun run_of(const QJsonObject& json) {
  return {record_of(json),          json["words"].toString(),   json["snapshot"].toString(),
          json["state"].toString(), json["message"].toString(), json["stop_asked"].toBool()};
}

/// The case as it is now, beside it, so that relative names hold. A case in a folder that cannot be written stays as it
/// is and needs no copy: the result is empty.
QString keep_text(const RunWish& wish, QString* error) {
  const QDir folder(QFileInfo(wish.case_file).absolutePath());
  if (!QFileInfo(folder.path()).isWritable()) return {};
  const QByteArray hash = QCryptographicHash::hash(wish.text, QCryptographicHash::Sha1).toHex().left(12);
  const QString name = folder.filePath(QString(".breccia-queued-%1.toml").arg(QString::fromLatin1(hash)));
  *error = written(name, wish.text);
  return name;
}

QueuedRun queued(const Launch& launch, const RunWish& wish, QString* error) {
  QueuedRun run;
  run.snapshot = keep_text(wish, error);
  run.words = wish.words.isEmpty() ? QFileInfo(wish.folder).fileName() : wish.words;
  run.record.folder = wish.folder;
  run.record.case_file = wish.case_file;
  run.record.ranks = wish.ranks;
  run.record.command =
      SolverRun::command_line(launch, run.snapshot.isEmpty() ? wish.case_file : run.snapshot, wish.folder, wish.ranks);
  for (const QString& value : wish.overrides) run.record.command << "--set" << value;
  return run;
}

/// Copies of cases that are no longer needed.
void remove_snapshots(const std::vector<QueuedRun>& before, const std::vector<QueuedRun>& now) {
  const auto needed = [](const std::vector<QueuedRun>& runs, const QString& file) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](const QueuedRun& r) { return r.snapshot == file && (r.waits() || r.runs()); });
  };
  for (const QueuedRun& run : before)
    if (!run.snapshot.isEmpty() && !needed(now, run.snapshot)) QFile::remove(run.snapshot);
}

bool goes_on(const RunRecord& record) {
  (void)take_exit_code(record.session);
  return !members_of(record.session).isEmpty() || is_held(record.folder);
}

void note_end(QueuedRun& run) {
  const RunOutcome outcome = outcome_of(run.record.folder);
  const bool stopped = run.stop_asked && outcome.last.state.isEmpty();
  run.state = stopped ? "stopped" : outcome.state;
  run.message = stopped ? QString() : outcome.message;
  if (run.state == "failed" && run.message.isEmpty())
    run.message = QObject::tr("%1 ended before its first step without a word").arg(run.record.command.value(0));
}

int cores_in_use(const RunRegistry& registry) {
  const std::vector<RunRecord> records = registry.load();
  std::vector<Session> sessions;
  for (const RunRecord& record : records) sessions.push_back(record.session);
  const std::vector<bool> alive = are_alive(sessions);
  int used = 0;
  for (std::size_t i = 0; i < records.size(); ++i) used += alive[i] ? records[i].ranks : 0;
  return used;
}

}  // namespace

RunQueue::RunQueue(const QString& state_folder) : folder_(QDir(state_folder).filePath("queue")) {}

QString RunQueue::file() const { return QDir(folder_).filePath("queue.json"); }
QString RunQueue::worker_lock() const { return QDir(folder_).filePath("run.lock"); }
bool RunQueue::is_worked() const { return is_held(folder_); }

QByteArray RunQueue::mark() const {
  struct stat about {};
  if (::stat(QFile::encodeName(file()).constData(), &about) != 0) return {};
  return QByteArray::number(static_cast<qulonglong>(about.st_ino)) + " " +
         QByteArray::number(static_cast<qlonglong>(about.st_mtim.tv_sec)) + "." +
         QByteArray::number(static_cast<qlonglong>(about.st_mtim.tv_nsec));
}

QueueContents RunQueue::load() const {
  QueueContents contents;
  contents.cores = QThread::idealThreadCount();
  QFile in(file());
  if (!in.open(QIODevice::ReadOnly)) return contents;
  const QJsonObject json = QJsonDocument::fromJson(in.readAll()).object();
  contents.cores = std::max(1, json["cores"].toInt(contents.cores));
  contents.held = json["held"].toBool();
  for (const QJsonValue& row : json["runs"].toArray()) contents.runs.push_back(run_of(row.toObject()));
  return contents;
}

QString RunQueue::save(const QueueContents& contents) const {
  QJsonArray rows;
  for (const QueuedRun& run : contents.runs) rows.append(json_of(run));
  const QByteArray text =
      QJsonDocument(QJsonObject{{"cores", contents.cores}, {"held", contents.held}, {"runs", rows}}).toJson();
  return written(file(), text);
}

template <class Change>
QString RunQueue::change(const Change& what) const {
  QDir().mkpath(folder_);
  QLockFile alone(file() + ".lock");
  if (!alone.tryLock(kPatience)) return QObject::tr("the queue %1 cannot be locked").arg(file());
  QueueContents contents = load();
  const std::vector<QueuedRun> before = contents.runs;
  what(contents);
  QString error = save(contents);
  if (error.isEmpty()) remove_snapshots(before, contents.runs);
  return error;
}

QString RunQueue::add(const Launch& launch, const std::vector<RunWish>& wishes) const {
  QString error;
  const QString unsaved = change([&](QueueContents& contents) {
    std::vector<QueuedRun> more;
    for (const RunWish& wish : wishes)
      if (error.isEmpty()) more.push_back(queued(launch, wish, &error));
    if (error.isEmpty()) contents.runs.insert(contents.runs.end(), more.begin(), more.end());
  });
  return error.isEmpty() ? unsaved : error;
}

QString RunQueue::remove(const QString& folder) const {
  return change([&](QueueContents& contents) {
    std::erase_if(contents.runs, [&](const QueuedRun& r) { return r.record.folder == folder && !r.runs(); });
  });
}

QString RunQueue::remove_ended() const {
  return change([](QueueContents& contents) {
    std::erase_if(contents.runs, [](const QueuedRun& r) { return !r.waits() && !r.runs(); });
  });
}

QString RunQueue::note_stop(const QString& folder) const {
  return change([&](QueueContents& contents) {
    for (QueuedRun& run : contents.runs)
      if (run.record.folder == folder && run.runs()) run.stop_asked = true;
  });
}

QString RunQueue::move(const QString& folder, int by) const {
  return change([&](QueueContents& contents) {
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < contents.runs.size(); ++i)
      if (contents.runs[i].waits()) waiting.push_back(i);
    for (int w = 0; w < static_cast<int>(waiting.size()); ++w) {
      if (contents.runs[waiting[static_cast<std::size_t>(w)]].record.folder != folder) continue;
      const int target = std::clamp(w + by, 0, static_cast<int>(waiting.size()) - 1), step = target > w ? 1 : -1;
      for (int at = w; at != target; at += step)
        std::swap(contents.runs[waiting[static_cast<std::size_t>(at)]],
                  contents.runs[waiting[static_cast<std::size_t>(at + step)]]);
      return;
    }
  });
}

QString RunQueue::set_cores(int cores) const {
  return change([&](QueueContents& contents) { contents.cores = cores; });
}

QString RunQueue::hold(bool on) const {
  return change([&](QueueContents& contents) { contents.held = on; });
}

bool RunQueue::wants_worker() const {
  const QueueContents contents = load();
  return !is_worked() && std::any_of(contents.runs.begin(), contents.runs.end(),
                                     [&](const QueuedRun& r) { return r.runs() || (r.waits() && !contents.held); });
}

bool RunQueue::advance(const RunRegistry& registry) const {
  const QueueContents seen = load();
  const auto ended = [](const QueuedRun& r) { return r.runs() && !goes_on(r.record); };
  const bool news = std::any_of(seen.runs.begin(), seen.runs.end(), ended);
  const auto first = std::find_if(seen.runs.begin(), seen.runs.end(), [](const QueuedRun& r) { return r.waits(); });
  const bool wanted = first != seen.runs.end() && !seen.held;
  int used = wanted ? cores_in_use(registry) : 0;
  const auto fits = [&](const QueuedRun& r) { return used == 0 || used + r.record.ranks <= seen.cores; };
  bool busy = false, writable = true;
  const auto look = [&](QueueContents& contents) {
    for (QueuedRun& run : contents.runs)
      if (ended(run)) note_end(run);
    for (QueuedRun& run : contents.runs) {
      if (!run.waits() || contents.held) continue;
      if (!fits(run)) break;  // later ones do not overtake it
      writable = save(contents).isEmpty();
      if (!writable) return;
      QString error;
      if (SolverRun::launch(run.record, QFileInfo(run.record.case_file).absolutePath(), &error)) {
        run.state = "running";
        used += run.record.ranks;
        registry.add(run.record);
      } else {
        run.state = "failed";
        run.message = error;
      }
    }
    for (const QueuedRun& run : contents.runs) busy = busy || run.runs() || (run.waits() && !contents.held);
  };
  if (!news && !(wanted && fits(*first)))
    return wanted || std::any_of(seen.runs.begin(), seen.runs.end(), [](const QueuedRun& r) { return r.runs(); });
  return change(look).isEmpty() && writable && busy;
}

int work_queue(const QString& state_folder) {
  const RunQueue queue(state_folder);
  const RunRegistry registry(QDir(state_folder).filePath("runs.json"));
  QFile lock(queue.worker_lock());
  if (!lock.open(QIODevice::WriteOnly)) return 0;
  // Another worker is there. A file system without locks shows none: then two may work, each change under its own lock.
  if (::flock(lock.handle(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return 0;
  while (queue.advance(registry)) QThread::msleep(kPollInterval);
  return 0;
}

}  // namespace breccia::gui
