#include "widgets/runs_panel.hpp"

#include <QFileInfo>
#include <QHeaderView>

#include "widgets/run_panel.hpp"

namespace breccia::gui {

RunsPanel::RunsPanel(QWidget* parent) : QTableWidget(parent) {
  setObjectName("runs");
  setAccessibleName(tr("Runs"));
  setToolTip(tr("Runs started here; Enter or a double click opens the results, a tick adds the run to the plots"));
  setColumnCount(7);
  setHorizontalHeaderLabels(
      {tr("run"), tr("state"), tr("ranks"), tr("progress"), tr("to go"), tr("broken joints"), tr("folder")});
  setEditTriggers(NoEditTriggers);
  setSelectionBehavior(SelectRows);
  setSelectionMode(SingleSelection);
  setTabKeyNavigation(false);
  verticalHeader()->hide();
  horizontalHeader()->setStretchLastSection(true);
  connect(this, &QTableWidget::itemChanged, this, [this](const QTableWidgetItem* changed) {
    if (showing_ || changed->column() != 0) return;
    QStringList folders;
    for (int row = 0; row < rowCount(); ++row)
      if (item(row, 0)->checkState() == Qt::Checked) folders << item(row, 6)->text();
    emit comparison_wanted(folders);
  });
  connect(this, &QTableWidget::cellActivated, this, [this](int row, int) { emit run_chosen(item(row, 6)->text()); });
}

void RunsPanel::show_runs(const std::vector<SolverRun*>& runs) {
  showing_ = true;
  QStringList ticked;
  for (int row = 0; row < rowCount(); ++row)
    if (item(row, 0) != nullptr && item(row, 0)->checkState() == Qt::Checked) ticked << item(row, 6)->text();
  setRowCount(static_cast<int>(runs.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const SolverRun& run = *runs[static_cast<std::size_t>(row)];
    const RunStatus& s = run.status();
    const QStringList cells{QFileInfo(run.record().folder).fileName(),
                            run.state(),
                            QString::number(run.record().ranks),
                            tr("%1 %").arg(100 * s.share, 0, 'f', 0),
                            to_go_words(run),
                            QString::number(s.broken_joints, 'f', 0),
                            run.record().folder};
    for (int c = 0; c < cells.size(); ++c) {
      if (item(row, c) == nullptr) setItem(row, c, new QTableWidgetItem);
      item(row, c)->setText(cells[c]);
      item(row, c)->setToolTip(cells[c]);
    }
    item(row, 0)->setFlags(item(row, 0)->flags() | Qt::ItemIsUserCheckable);
    item(row, 0)->setCheckState(ticked.contains(run.record().folder) ? Qt::Checked : Qt::Unchecked);
  }
  resizeColumnToContents(0);  // names of runs differ in their ends
  showing_ = false;
}

}  // namespace breccia::gui
