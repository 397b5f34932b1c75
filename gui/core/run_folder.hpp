#pragma once

#include <QByteArray>
#include <QDateTime>
#include <QString>
#include <QStringList>
#include <vector>

/// What a run writes into its folder, read while it grows. Nothing is taken from log prose.
namespace breccia::gui {

/// Bytes at the end of status.jsonl in which its last state stands.
inline constexpr qint64 kStatusTail = 1 << 16;

/// One line of status.jsonl.
struct RunStatus {
  QString state;  ///< running, paused, complete, stopped, failed, interrupted; empty: nothing said yet
  QString stage, message;
  double step = 0, steps_total = 0;
  double time = 0, end = 0;   ///< s
  double share = 0;           ///< 0..1
  double wall = 0, eta = -1;  ///< s; eta < 0: unknown
  double residual = 0, speed = 0, imbalance = 1;
  double broken_joints = 0, fragments = 0;
  [[nodiscard]] bool over() const {
    return state == "complete" || state == "stopped" || state == "failed" || state == "interrupted";
  }
};

/// One frame of a series.
struct RunFrame {
  QString file;     ///< absolute
  double time = 0;  ///< s
};

/// A state from which a run can go on.
struct RunCheckpoint {
  QString file;  ///< absolute
  qint64 step = 0;
};

/// Whole lines of a growing file; a line that is half written waits for its end. A call reads a few hundred lines or
/// thousands, never a whole long file, so that the window is not held up.
class GrowingFile {
 public:
  /// @param tail  bytes before the end at which the first call begins, with the next whole line; < 0: at the start
  explicit GrowingFile(QString path = {}, qint64 tail = -1) : path_(std::move(path)), tail_(tail) {}
  /// Lines that came to it since the last call. A file that has become shorter, or is another one than before, is read
  /// anew; `restarted` tells.
  [[nodiscard]] QList<QByteArray> news(bool* restarted = nullptr);
  /// More is there than the last call returned.
  [[nodiscard]] bool has_more() const { return has_more_; }

 private:
  QString path_;
  qint64 tail_ = -1, read_ = 0;
  QByteArray last_;  ///< bytes before read_: a file in which others stand there is another one
  bool has_more_ = false;
};

/// What a run that goes on says of itself, looked at now and then.
class RunProgress {
 public:
  explicit RunProgress(const QString& run_folder);
  /// The last that was said; as it was made while nothing is.
  const RunStatus& look();

 private:
  GrowingFile file_;
  RunStatus status_;
};

/// history.csv by columns; grows with the run.
class History {
 public:
  void add_line(const QByteArray& line);  ///< the first one names the columns
  void clear();
  [[nodiscard]] const QStringList& columns() const { return columns_; }
  [[nodiscard]] int column(const QString& name) const { return static_cast<int>(columns_.indexOf(name)); }
  [[nodiscard]] int rows() const { return rows_; }
  /// @pre 0 <= column < number of columns
  [[nodiscard]] const std::vector<double>& values(int column) const {
    return values_[static_cast<std::size_t>(column)];
  }
  /// Of the sizes of the finite values of a column.
  [[nodiscard]] double largest(int column) const { return largest_[static_cast<std::size_t>(column)]; }

 private:
  QStringList columns_;
  std::vector<std::vector<double>> values_;
  std::vector<double> largest_;
  int rows_ = 0;
};

/// Histories of several runs beside each other, as CSV: blocks of columns "RUN: COLUMN".
[[nodiscard]] QByteArray histories_csv(const std::vector<std::pair<QString, const History*>>& runs);

/// False for a line that is no status (an event, broken JSON).
[[nodiscard]] bool read_status(const QByteArray& line, RunStatus& out);
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
/// A run, as its provenance tells it.
struct RunOrigin {
  QString folder;     ///< absolute
  QDateTime started;  ///< not valid: it does not tell
  int ranks = 1;
  QString case_name;  ///< file name of its case
  QString case_file;  ///< the same as it was named when the run was started
};
[[nodiscard]] RunOrigin origin_of(const QString& run_folder);
/// The runs of a case in the folder "runs" beside it, newest first: those that say so, and those with such names as
/// runs are given here.
[[nodiscard]] std::vector<RunOrigin> runs_beside(const QString& case_file);

}  // namespace breccia::gui
