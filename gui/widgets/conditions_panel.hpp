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

 signals:
  void entry_wanted(const QString& path);
  /// The view shows what the condition in hand is about.
  void group_entered(const QString& group);

 private:
  void show_curves();

  std::vector<Condition> conditions_;
  QTableWidget* table_;
  LineChart* chart_;
};

}  // namespace breccia::gui
