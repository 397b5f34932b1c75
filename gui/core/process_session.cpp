#include "core/process_session.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QProcessEnvironment>
#include <cstring>
#include <string>
#include <vector>

namespace breccia::gui {
namespace {

/// Entry of /proc for a process.
struct Entry {
  char state = '?';
  pid_t session = 0;
  qint64 started = 0;
};

std::optional<Entry> entry_of(pid_t process) {
  QFile file(QString("/proc/%1/stat").arg(process));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray text = file.readAll();
  // The name stands in brackets and may hold anything; what follows is numbers.
  const QList<QByteArray> rest = text.mid(text.lastIndexOf(')') + 2).split(' ');
  constexpr int kState = 0, kSession = 3, kStarted = 19;
  if (rest.size() <= kStarted) return {};
  return Entry{rest[kState].at(0), rest[kSession].toInt(), rest[kStarted].toLongLong()};
}

bool runs(const Entry& entry) { return entry.state != 'Z' && entry.state != 'X'; }

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> out;
  for (std::string& s : strings) out.push_back(s.data());
  out.push_back(nullptr);
  return out;
}

std::vector<std::string> bytes_of(const QStringList& list) {
  std::vector<std::string> out;
  for (const QString& s : list) out.push_back(s.toStdString());
  return out;
}

}  // namespace

std::optional<Session> start_session(const QStringList& command, const QString& folder, const QString& output_file,
                                     const QStringList& environment, QString* error) {
  std::vector<std::string> words = bytes_of(command), variables = bytes_of(environment);
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  posix_spawn_file_actions_addchdir_np(&files, folder.toStdString().c_str());
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output_file.toStdString().c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int failed = ::posix_spawnp(&process, words.front().c_str(), &files, &attributes, pointers(words).data(),
                                    pointers(variables).data());
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0) {
    *error = QString("%1: %2").arg(command.front(), QString::fromLocal8Bit(std::strerror(failed)));
    return {};
  }
  const auto entry = entry_of(process);
  return Session{process, entry ? entry->started : 0};
}

std::optional<qint64> start_of_process(pid_t process) {
  const std::optional<Entry> entry = process > 0 ? entry_of(process) : std::nullopt;
  return entry && runs(*entry) ? std::optional<qint64>(entry->started) : std::nullopt;
}

namespace {

/// Every process of the machine.
QList<QPair<pid_t, Entry>> process_table() {
  QList<QPair<pid_t, Entry>> table;
  for (const QString& name : QDir("/proc").entryList(QDir::Dirs | QDir::NoDotAndDotDot)) {
    bool number = false;
    const pid_t process = name.toInt(&number);
    if (!number) continue;
    if (const auto entry = entry_of(process); entry) table.append({process, *entry});
  }
  return table;
}

QList<pid_t> members_in(const QList<QPair<pid_t, Entry>>& table, const Session& session) {
  QList<pid_t> found;
  if (session.leader <= 0) return found;
  for (const auto& [process, entry] : table) {
    // A leader of that number which started at another time is another process, and so is its session.
    if (process == session.leader && entry.started != session.started) return {};
    if (entry.session == session.leader && entry.started >= session.started && runs(entry)) found.append(process);
  }
  return found;
}

}  // namespace

QList<pid_t> members_of(const Session& session) {
  if (session.leader <= 0) return {};
  return members_in(process_table(), session);
}

std::vector<bool> are_alive(const std::vector<Session>& sessions) {
  const auto table = process_table();
  std::vector<bool> alive;
  for (const Session& session : sessions) alive.push_back(!members_in(table, session).isEmpty());
  return alive;
}

int signal_session(const Session& session, int signal) {
  const QList<pid_t> members = members_of(session);
  for (const pid_t process : members) ::kill(process, signal);
  return static_cast<int>(members.size());
}

std::optional<int> take_exit_code(const Session& session) {
  int status = 0;
  if (session.leader <= 0 || ::waitpid(session.leader, &status, WNOHANG) != session.leader) return {};
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace breccia::gui
