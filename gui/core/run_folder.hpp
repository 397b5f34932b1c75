#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>
#include <vector>

/// What a run writes into its folder, read while it grows. Nothing is taken from log prose.
namespace breccia::gui {

/// One line of status.jsonl.
struct RunStatus {
  QString state;  ///< running, paused, complete, stopped, failed; empty: nothing said yet
  QString stage, message;
  double step = 0, steps_total = 0;
  double time = 0, end = 0;   ///< s
  double share = 0;           ///< 0..1
  double wall = 0, eta = -1;  ///< s; eta < 0: unknown
  double residual = 0, speed = 0, imbalance = 1;
  double broken_joints = 0, fragments = 0;
  [[nodiscard]] bool over() const { return state == "complete" || state == "stopped" || state == "failed"; }
};

/// One frame of a series.
struct RunFrame {
  QString file;     ///< absolute
  double time = 0;  ///< s
};

/// Whole lines of a growing file; a line that is half written waits for its end.
class GrowingFile {
 public:
  explicit GrowingFile(QString path = {}) : path_(std::move(path)) {}
  /// Lines that came to it since the last call. A file that has become shorter is read anew; `restarted` tells.
  [[nodiscard]] QList<QByteArray> news(bool* restarted = nullptr);

 private:
  QString path_;
  qint64 read_ = 0;
};

/// history.csv by columns; grows with the run.
class History {
 public:
  void add_line(const QByteArray& line);  ///< the first one names the columns
  void clear();
  [[nodiscard]] const QStringList& columns() const { return columns_; }
  [[nodiscard]] int column(const QString& name) const { return columns_.indexOf(name); }
  [[nodiscard]] int rows() const { return rows_; }
  /// @pre 0 <= column < number of columns
  [[nodiscard]] const std::vector<double>& values(int column) const {
    return values_[static_cast<std::size_t>(column)];
  }

 private:
  QStringList columns_;
  std::vector<std::vector<double>> values_;
  int rows_ = 0;
};

/// False for a line that is no status (an event, broken JSON).
[[nodiscard]] bool read_status(const QByteArray& line, RunStatus& out);
/// Index of a series, e.g. frames/elements.hdf.series; frames whose file is there. Empty: there is none.
[[nodiscard]] std::vector<RunFrame> read_series(const QString& run_folder, const QString& part);
/// True for a folder that a run has written into.
[[nodiscard]] bool is_run_folder(const QString& folder);

}  // namespace breccia::gui
