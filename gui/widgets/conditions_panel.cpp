#include "widgets/conditions_panel.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QSignalBlocker>
#include <algorithm>

#include "core/case_outline.hpp"

namespace breccia::gui {
ConditionsPanel::ConditionsPanel(QWidget* parent) : QWidget(parent), table_(new QTableWidget), chart_(new LineChart) {
  setObjectName("conditions");
  table_->setObjectName("conditions_table");
  table_->setAccessibleName(tr("Loads and constraints"));
  table_->setToolTip(
      tr("Loads and constraints by stage; those chosen (several with Ctrl or Shift) are shown in the view; Enter or a "
         "double click leads to the entry"));
  table_->setColumnCount(5);
  table_->setHorizontalHeaderLabels({tr("stage"), tr("type"), tr("target"), tr("value"), tr("entry")});
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  table_->setTabKeyNavigation(false);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setStretchLastSection(true);
  chart_->setObjectName("load_chart");
  chart_->setAccessibleName(tr("Functions of time"));
  chart_->setToolTip(tr("The value of the selected condition over its stage, as evaluated by the solver"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2, 2, 2, 2);
  row->addWidget(table_, 1);
  row->addWidget(chart_, 1);
  connect(table_, &QTableWidget::currentCellChanged, this, [this] { show_curves(); });
  connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
    if (!table_->hasFocus()) return;
    QStringList groups;
    for (const QModelIndex& chosen : table_->selectionModel()->selectedRows())
      groups << conditions_[static_cast<std::size_t>(chosen.row())].target;
    emit groups_chosen(groups);
  });
  connect(table_, &QTableWidget::cellActivated, this, [this](int now, int) {
    emit entry_wanted(QString(conditions_[static_cast<std::size_t>(now)].path));  // the list may change meanwhile
  });
}

void ConditionsPanel::show_conditions(std::vector<Condition> conditions) {
  const int current = table_->currentRow();
  const QSignalBlocker quiet(table_);
  conditions_ = std::move(conditions);
  table_->setRowCount(static_cast<int>(conditions_.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const Condition& c = conditions_[static_cast<std::size_t>(row)];
    const QStringList cells{c.stage.isEmpty() ? tr("start") : c.stage, c.type,
                            c.target.isEmpty() ? tr("everything") : c.target, c.value, numbered_words(c.path)};
    for (int column = 0; column < cells.size(); ++column) {
      if (table_->item(row, column) == nullptr) table_->setItem(row, column, new QTableWidgetItem);
      table_->item(row, column)->setText(cells[column]);
      table_->item(row, column)->setToolTip(cells[column]);
    }
  }
  for (const int column : {0, 1, 2, 3}) table_->resizeColumnToContents(column);
  constexpr int kValue = 3, kWidest = 260;  // the column, and pixels: tables of a function are long
  table_->setColumnWidth(kValue, std::min(table_->columnWidth(kValue), kWidest));
  table_->setCurrentCell(std::min(std::max(current, 0), table_->rowCount() - 1), 0);
  show_curves();
}

void ConditionsPanel::choose(const QString& path) {
  for (int row = 0; row < table_->rowCount(); ++row)
    if (conditions_[static_cast<std::size_t>(row)].path == path) table_->setCurrentCell(row, 0);
}

bool ConditionsPanel::choose_targets(const QStringList& groups) {
  bool first = true;
  for (int row = 0; row < table_->rowCount(); ++row) {
    if (!groups.contains(conditions_[static_cast<std::size_t>(row)].target)) continue;
    if (first) table_->setCurrentCell(row, 0, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    table_->selectionModel()->select(table_->model()->index(row, 0),
                                     QItemSelectionModel::Select | QItemSelectionModel::Rows);
    first = false;
  }
  return !first;
}

void ConditionsPanel::show_curves() {
  const int row = table_->currentRow();
  if (row < 0 || row >= static_cast<int>(conditions_.size())) return chart_->show_lines({}, {}, {});
  const Condition& chosen = conditions_[static_cast<std::size_t>(row)];
  chart_->show_lines(chosen.curves, tr("time [s]"), QString("%1 [%2]").arg(chosen.type, chosen.unit));
}

}  // namespace breccia::gui
