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
};

}  // namespace breccia::gui
