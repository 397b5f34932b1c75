#pragma once

#include <QByteArray>
#include <QDateTime>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <string_view>
#include <vector>

#include "run_folder/growing_lines.hpp"
#include "run_folder/history.hpp"

/// What a run writes into its folder, read while it grows. Nothing is taken from log prose.
namespace breccia::gui {

/// One line of status.jsonl.
struct RunStatus {
  QString state;  ///< running, paused, complete, stopped, failed, interrupted; empty: none yet
  QString stage, message;
  double step = 0, steps_total = 0;
  double time = 0, end = 0;   ///< s
  double share = 0;           ///< 0..1
  double wall = 0, eta = -1;  ///< s; eta < 0: unknown
  double residual = 0, speed = 0, imbalance = 1;
  double broken_joints = 0, fragments = 0;
  [[nodiscard]] bool over() const;
};

/// One frame of a series.
struct RunFrame {
  QString file;     ///< absolute
  double time = 0;  ///< s
};

/// A state from which a run can be resumed.
struct RunCheckpoint {
  QString file;  ///< absolute
  qint64 step = 0;
};

/// Status of a run in progress, polled at intervals.
class RunProgress {
 public:
  explicit RunProgress(const QString& run_folder);
  /// The last status; as constructed before the first one.
  const RunStatus& look();

 private:
  run_folder::GrowingLines file_;
  RunStatus status_;
};

/// history.csv by columns; grows with the run.
class History {
 public:
  void add_line(std::string_view line);  ///< the first one names the columns
  void clear();
  [[nodiscard]] const QStringList& columns() const { return columns_; }
  [[nodiscard]] int column(const QString& name) const { return static_cast<int>(columns_.indexOf(name)); }
  [[nodiscard]] int rows() const { return static_cast<int>(table_.rows()); }
  /// @pre 0 <= column < number of columns
  [[nodiscard]] const std::vector<double>& values(int column) const {
    return table_.columns[static_cast<std::size_t>(column)];
  }
  /// Of the sizes of the finite values of a column.
  [[nodiscard]] double largest(int column) const { return largest_[static_cast<std::size_t>(column)]; }

 private:
  run_folder::History table_;
  QStringList columns_;  ///< names of the table's
  std::vector<double> largest_;
};

/// Histories of several runs beside each other, as CSV: blocks of columns "RUN: COLUMN".
[[nodiscard]] QByteArray histories_csv(const std::vector<std::pair<QString, const History*>>& runs);

/// A file of a run's folder as the readers of the solver take it (run_folder/).
[[nodiscard]] std::filesystem::path path_in_run(const QString& run_folder, const char* name);
/// False for a line that is no status (an event, broken JSON).
[[nodiscard]] bool read_status(std::string_view line, RunStatus& out);
/// Index of a series, e.g. frames/elements.hdf.series; frames whose file is there. Empty: there is none.
[[nodiscard]] std::vector<RunFrame> read_series(const QString& run_folder, const QString& part);
/// Checkpoints of a run, latest first.
[[nodiscard]] std::vector<RunCheckpoint> read_checkpoints(const QString& run_folder);
/// Whether a process of this machine holds the folder of a run, wherever it was started.
[[nodiscard]] bool is_held(const QString& run_folder);
/// The case of a run as it stands in its folder; null: there is none that can be read.
[[nodiscard]] QByteArray case_text_of(const QString& run_folder);
/// Whether a case reads otherwise than the one that a run was started from. False where that is not known.
[[nodiscard]] bool was_run_with_another(const QString& run_folder, const QByteArray& case_text);
/// True for a folder that a run has written into.
[[nodiscard]] bool is_run_folder(const QString& folder);
/// A run by its provenance.
struct RunOrigin {
  QString folder;     ///< absolute
  QDateTime started;  ///< not valid: not stated
  int ranks = 1;
  QString case_name;  ///< file name of its case
  QString case_file;  ///< the same as it was named when the run was started
};
[[nodiscard]] RunOrigin origin_of(const QString& run_folder);
/// The runs of a case in the folder "runs" beside it, newest first: by their provenance, or by the names that the
/// desktop gives to runs.
[[nodiscard]] std::vector<RunOrigin> runs_beside(const QString& case_file);

}  // namespace breccia::gui
