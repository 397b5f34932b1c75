#pragma once

#include <vector>

#include "core/solver_run.hpp"

/// Runs that wait for their turn. The queue is a file of the state folder; a process of its own, the worker, starts the
/// runs, so that the windows may be closed meanwhile. A process that changes the file holds its lock for that moment.
namespace breccia::gui {

/// A requested run.
struct RunWish {
  QString case_file, folder;  ///< of the results
  QByteArray text;            ///< of the case; what is edited later is not its matter
  int ranks = 1;
  QStringList overrides;  ///< key=value
  QString words;          ///< what it is called; empty: by its folder
};

struct QueuedRun {
  RunRecord record;
  QString words;
  QString snapshot;           ///< file that the command reads, taken away in the end; empty: the case itself
  QString state = "waiting";  ///< waiting, running, then as it ended: complete, stopped, failed, interrupted
  QString message;            ///< why it failed
  bool stop_asked = false;    ///< by the user: a run that then ends without a status has not failed
  [[nodiscard]] bool waits() const { return state == "waiting"; }
  [[nodiscard]] bool runs() const { return state == "running"; }
};

/// What stands in the file.
struct QueueContents {
  int cores = 0;      ///< that runs may use at a time, those started by hand counted too
  bool held = false;  ///< nothing is started
  std::vector<QueuedRun> runs;
};

class RunQueue {
 public:
  /// @param state_folder  made when needed
  explicit RunQueue(const QString& state_folder);

  [[nodiscard]] QueueContents load() const;
  /// Puts runs at the end. Returns what went wrong, empty: nothing.
  [[nodiscard]] QString add(const Launch& launch, const std::vector<RunWish>& wishes) const;
  // What follows returns what went wrong, empty: nothing; then all is as it was.
  /// Takes a run that waits or has ended off the list; one that runs stays.
  QString remove(const QString& folder) const;
  /// Moves one that waits past others that wait. @param by  < 0: earlier
  QString move(const QString& folder, int by) const;
  QString remove_ended() const;
  /// Records that the user has requested the stop of a run; SolverRun sends the request.
  QString note_stop(const QString& folder) const;
  QString set_cores(int cores) const;
  QString hold(bool on) const;

  /// One pass: records ended runs and starts, in their order, those for which cores are free; the first one starts
  /// alone if it needs more than all. A run that cannot be started or fails does not delay the others.
  /// @param registry  gets those that were started
  /// @return whether anything runs, or will without a change from outside; false where the file cannot be written, and
  ///         then nothing is started, since the next pass would start it again
  bool advance(const RunRegistry& registry) const;

  /// A worker is at it.
  [[nodiscard]] bool is_worked() const;
  /// No worker is at it, and there is something to do.
  [[nodiscard]] bool wants_worker() const;
  /// Changes whenever the file does.
  [[nodiscard]] QByteArray mark() const;

 private:
  /// Returns what went wrong, empty: nothing.
  template <class Change>
  QString change(const Change& what) const;
  [[nodiscard]] QString save(const QueueContents& contents) const;
  [[nodiscard]] QString file() const;
  [[nodiscard]] QString worker_lock() const;
  friend int work_queue(const QString& state_folder);

  QString folder_;
};

/// The worker: starts runs until none is left, then returns 0; at once where another is at it.
/// @param state_folder  of RunQueue; its runs.json is the registry
int work_queue(const QString& state_folder);

}  // namespace breccia::gui
