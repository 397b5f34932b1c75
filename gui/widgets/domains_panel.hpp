#pragma once

#include <QJsonObject>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>

#include "core/run_folder.hpp"

namespace breccia::gui {

/// Division of the model over N ranks: a table by rank, as of `breccia check --ranks N`.
class DomainsPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit DomainsPanel(QWidget* parent = nullptr);
  void set_ranks(int ranks);
  /// Answer of `check --ranks --json`.
  void show_division(const QJsonObject& json);
  /// Beside it: what the last run measured.
  void show_measured(const RunStatus& status, int ranks);

 signals:
  void division_wanted(int ranks);

 private:
  QSpinBox* ranks_;
  QPushButton* divide_;
  QTableWidget* table_;
  QLabel *verdict_, *measured_;
};

}  // namespace breccia::gui
