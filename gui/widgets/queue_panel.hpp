#pragma once

#include <QCheckBox>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTimer>
#include <map>

#include "core/run_folder.hpp"
#include "core/run_queue.hpp"

namespace breccia::gui {

/// The queue of runs: its order, progress, and number of cores. It is read every second, since the worker and other
/// windows change it.
class QueuePanel final : public QWidget {
  Q_OBJECT
 public:
  explicit QueuePanel(const RunQueue& queue, QWidget* parent = nullptr);
  /// Reads the file if it has changed, and requests a worker if one is missing.
  void look();
  /// Shows the list as it is after a change was tried. @param error  empty: it was made
  void changed_with(const QString& error);
  [[nodiscard]] const QueueContents& contents() const { return contents_; }

 signals:
  void changed();
  void worker_wanted();
  void run_chosen(const QString& folder);
  void stop_wanted(const QString& folder);
  /// The list was to be changed. @param error  empty: it was
  void change_tried(const QString& error);

 private:
  void make_table();
  void make_buttons(QHBoxLayout& row);
  void show_contents();
  /// Shows the progress of the runs.
  void show_progress();
  void show_buttons();
  /// Why the chosen run failed; none is chosen: the last one that did.
  void show_why();
  /// nullptr: no row is chosen.
  [[nodiscard]] const QueuedRun* chosen() const;
  void move(int by);

  const RunQueue& queue_;
  QueueContents contents_;
  std::map<QString, RunProgress> progress_;  ///< by folder, of those in progress
  QByteArray mark_;
  QTimer timer_;
  QElapsedTimer since_worker_;
  QTableWidget* table_;
  QPushButton *earlier_, *later_, *stop_, *remove_, *clear_;
  QSpinBox* cores_;
  QCheckBox* held_;
  QLabel* why_;
};

}  // namespace breccia::gui
