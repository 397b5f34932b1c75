#pragma once

#include <QTableWidget>

#include "core/conditions.hpp"
#include "widgets/line_chart.hpp"

namespace breccia::gui {

/// Loads and constraints as a table; beside it the functions of time of the one in hand, over its stage.
class ConditionsPanel final : public QWidget {
  Q_OBJECT
 public:
  explicit ConditionsPanel(QWidget* parent = nullptr);
  void show_conditions(std::vector<Condition> conditions);
  /// Takes the row of a path in hand, if there is one.
  void choose(const QString& path);
  /// Chooses all conditions on one of these groups. False: there is none.
  bool choose_targets(const QStringList& groups);

 signals:
  void entry_wanted(const QString& path);
  /// The view shows what the chosen conditions are about.
  void groups_chosen(const QStringList& groups);

 private:
  void show_curves();

  std::vector<Condition> conditions_;
  QTableWidget* table_;
  LineChart* chart_;
};

}  // namespace breccia::gui
