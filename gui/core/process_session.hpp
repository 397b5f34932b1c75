#pragma once

#include <sys/types.h>

#include <QString>
#include <QStringList>
#include <QtGlobal>
#include <optional>
#include <vector>

/// Processes that outlive their starter: each run is the leader of a session of its own, and so everything that it
/// starts (mpiexec, its ranks) can be counted and ended, by any process.
namespace breccia::gui {

struct Session {
  pid_t leader = 0;
  qint64 started = 0;  ///< of the leader, ticks since boot: distinguishes it from a later process of the same number
};

/// Start of a process, ticks since boot. Nothing: there is none of this number, or it has ended and its parent has not
/// received its status yet.
[[nodiscard]] std::optional<qint64> start_of_process(pid_t process);

/// Starts a program in a new session, its output at the end of a file. @param error  out: what went wrong
[[nodiscard]] std::optional<Session> start_session(const QStringList& command, const QString& folder,
                                                   const QString& output_file, const QStringList& environment,
                                                   QString* error);

/// Processes of the session that still run, zombies not counted.
[[nodiscard]] QList<pid_t> members_of(const Session& session);

/// Which of the sessions still have a process. Reads the process table once for all.
[[nodiscard]] std::vector<bool> are_alive(const std::vector<Session>& sessions);

/// Sends a signal to every one of them. Returns how many there were.
int signal_session(const Session& session, int signal);

/// Takes the exit status of a leader that is our child and has ended, so that it does not stay in the process table.
/// Exit code, 128 + signal; nothing: it runs on, or is no child of ours.
[[nodiscard]] std::optional<int> take_exit_code(const Session& session);

}  // namespace breccia::gui
