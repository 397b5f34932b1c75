#pragma once

#include <QElapsedTimer>
#include <QJsonObject>
#include <QObject>
#include <QTimer>
#include <vector>

#include "core/process_session.hpp"
#include "core/run_folder.hpp"

namespace breccia::gui {

/// How runs are started here.
struct Launch {
  QString program = "breccia";   ///< the solver
  QString launcher = "mpiexec";  ///< used on several ranks
};

/// What is needed to find a run again.
struct RunRecord {
  QString folder;  ///< of the results
  QString case_file;
  int ranks = 1;
  QStringList command;
  Session session;
};

[[nodiscard]] QJsonObject json_of(const RunRecord& record);
[[nodiscard]] RunRecord record_of(const QJsonObject& json);

/// How a run has ended, from its folder.
struct RunOutcome {
  RunStatus last;   ///< its last status
  QString state;    ///< complete, stopped, failed, interrupted
  QString message;  ///< why it failed
};
[[nodiscard]] RunOutcome outcome_of(const QString& folder);

/// One run: an independent process, monitored through its folder every `kInterval` while this object exists; the run
/// continues without it.
class SolverRun final : public QObject {
  Q_OBJECT
 public:
  static constexpr int kInterval = 400;  // ms
  /// How long a stop waits before it becomes stricter, ms: after the request, after SIGTERM.
  struct Patience {
    int request = 10000, terminate = 5000;
  };

  /// Finds a run again, or only its results when it has ended.
  /// @param is_new  it has just been started: its end is signalled even if it has ended already
  explicit SolverRun(RunRecord record, QObject* parent = nullptr, bool is_new = false);

  /// The command line of a run, as it is shown and started.
  [[nodiscard]] static QStringList command_line(const Launch& launch, const QString& case_file, const QString& folder,
                                                int ranks);
  /// That of a run that is resumed from its last checkpoint.
  [[nodiscard]] static QStringList resume_line(const Launch& launch, const QString& folder, int ranks);
  /// Runs the command of a record as a session of its own, which is noted there. False: it could not be started.
  /// @param folder  in which it works
  [[nodiscard]] static bool launch(RunRecord& record, const QString& folder, QString* error);
  /// Starts one. nullptr: it could not be started, see `error`.
  [[nodiscard]] static SolverRun* start(const Launch& launch, const QString& case_file, const QString& folder,
                                        int ranks, QString* error, QObject* parent);
  /// Resumes a run that ended before its time, from its last checkpoint, on any number of ranks. The object that
  /// monitored it so far is no longer used.
  [[nodiscard]] static SolverRun* go_on(const Launch& launch, const RunRecord& ended, int ranks, QString* error,
                                        QObject* parent);

  [[nodiscard]] const RunRecord& record() const { return record_; }
  [[nodiscard]] const RunStatus& status() const { return status_; }
  /// Empty until read_history is called, since it may be long.
  [[nodiscard]] const History& history() const { return history_; }
  void read_history();
  /// Reads the next piece of it. Returns whether more is there.
  bool read_more_history();
  [[nodiscard]] const std::vector<RunFrame>& frames() const { return frames_; }
  [[nodiscard]] const std::vector<RunCheckpoint>& checkpoints() const { return checkpoints_; }
  [[nodiscard]] bool alive() const { return alive_; }
  /// starting, running, pausing, paused, resuming, stopping, finishing, complete, stopped, failed, interrupted
  [[nodiscard]] QString state() const;
  /// It has ended before its time and left a checkpoint.
  [[nodiscard]] bool can_go_on() const { return !alive_ && state() != "complete" && !checkpoints_.empty(); }
  /// Why it failed, in the solver's words.
  [[nodiscard]] QString failure() const;

  void pause() { ask_for("pause", "paused"); }
  void resume() { ask_for("resume", "running"); }
  void checkpoint() { ask("checkpoint"); }
  /// Requests the end of the run after the present step; then SIGTERM; then SIGKILL to every process of its session. A
  /// run that was started elsewhere, in a terminal, gets the request only: its session has other processes.
  void stop();
  void set_patience(Patience patience) { patience_ = patience; }
  /// Reads the folder and the process table now.
  void look();

 signals:
  void status_changed();
  void history_grew();
  void frames_changed();
  /// While it was watched: one that had ended before is silent.
  void ended();

 private:
  void ask(const QByteArray& command);
  /// @param state  reported state of the run after the command
  void ask_for(const QByteArray& command, const QString& state);
  void send_requests();
  void go_on_stopping();
  void look_at_frames();
  [[nodiscard]] bool look_at_history();
  [[nodiscard]] bool look_at_status();

  RunRecord record_;
  RunStatus status_;
  History history_;
  std::vector<RunFrame> frames_;
  std::vector<RunCheckpoint> checkpoints_;
  run_folder::GrowingLines status_file_, history_file_;
  QByteArray series_mark_;  ///< time and size of the index of frames
  QList<QByteArray> requests_;
  QString awaited_;  ///< requested state that the run has not reported yet; empty: none
  QTimer timer_;
  QElapsedTimer stopping_;
  Patience patience_;
  int polls_after_end_ = 0;
  bool alive_ = true, terminated_ = false, told_end_ = false, wants_history_ = false;
};

/// A command line for a shell: words with blanks, quotes and other signs that a shell reads stand in quotes.
[[nodiscard]] QString shell_line(const QStringList& command);

/// The runs that were started here, kept in a file of the state folder so that a later session finds them.
class RunRegistry {
 public:
  explicit RunRegistry(QString file) : file_(std::move(file)) {}
  [[nodiscard]] std::vector<RunRecord> load() const;
  /// Newest first; folders that are no more are left out.
  /// Returns what went wrong, empty: nothing.
  QString add(const RunRecord& record) const;

 private:
  QString file_;
};

}  // namespace breccia::gui
