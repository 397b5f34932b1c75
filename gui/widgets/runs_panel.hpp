#pragma once

#include <QTableWidget>

#include "core/solver_run.hpp"

namespace breccia::gui {

/// The runs of this session and those found again.
class RunsPanel final : public QTableWidget {
  Q_OBJECT
 public:
  explicit RunsPanel(QWidget* parent = nullptr);
  void show_runs(const std::vector<SolverRun*>& runs);

 signals:
  void run_chosen(const QString& folder);
  /// Ticks have changed. @param folders  of the runs to compare with
  void comparison_wanted(const QStringList& folders);

 private:
  bool showing_ = false;
};

}  // namespace breccia::gui
