#include "widgets/domains_panel.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QJsonArray>
#include <QVBoxLayout>

#include "widgets/run_panel.hpp"

namespace breccia::gui {

DomainsPanel::DomainsPanel(QWidget* parent)
    : QWidget(parent),
      ranks_(new QSpinBox),
      divide_(new QPushButton(tr("&Divide"))),
      table_(new QTableWidget),
      verdict_(new QLabel),
      measured_(new QLabel) {
  ranks_->setRange(1, 4096);
  ranks_->setObjectName("domain_ranks");
  ranks_->setAccessibleName(tr("Ranks to divide among"));
  ranks_->setToolTip(tr("How many ranks the model is divided among"));
  divide_->setObjectName("divide");
  divide_->setAccessibleName(tr("Divide"));
  divide_->setToolTip(tr("Show how so many ranks would divide the model"));
  table_->setObjectName("domain_table");
  table_->setAccessibleName(tr("Loads of the ranks"));
  table_->setToolTip(tr("Elements, joints, proxies, neighbours, cut faces and predicted time of each rank"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setTabKeyNavigation(false);
  table_->verticalHeader()->hide();
  table_->setMinimumHeight(120);
  verdict_->setWordWrap(true);
  verdict_->setObjectName("division");
  measured_->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(tr("Ra&nks"));
  label->setBuddy(ranks_);
  row->addWidget(label);
  row->addWidget(ranks_);
  row->addWidget(divide_);
  row->addStretch();
  column->addLayout(row);
  column->addWidget(verdict_);
  column->addWidget(table_);
  column->addWidget(measured_);
  connect(divide_, &QPushButton::clicked, this, [this] { emit division_wanted(ranks_->value()); });
}

void DomainsPanel::set_ranks(int ranks) { ranks_->setValue(ranks); }

void DomainsPanel::show_division(const QJsonObject& json) {
  const QJsonArray domains = json["domains"].toArray();
  const QStringList keys{"elements", "joints", "proxies", "neighbours", "cut_faces", "bytes", "seconds_a_step"};
  table_->setColumnCount(static_cast<int>(keys.size()) + 1);
  table_->setHorizontalHeaderLabels({tr("rank"), tr("elements"), tr("joints"), tr("proxies"), tr("neighbours"),
                                     tr("cut faces"), tr("kB a step"), tr("us a step")});
  table_->setRowCount(static_cast<int>(domains.size()));
  for (int d = 0; d < table_->rowCount(); ++d) {
    table_->setItem(d, 0, new QTableWidgetItem(QString::number(d)));
    for (int k = 0; k < keys.size(); ++k) {
      double x = domains[d].toObject()[keys[k]].toDouble();
      if (keys[k] == "bytes") x *= 1e-3;
      if (keys[k] == "seconds_a_step") x *= 1e6;
      auto* cell = new QTableWidgetItem(QString::number(x, 'f', 0));
      cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(d, k + 1, cell);
    }
  }
  table_->resizeColumnsToContents();
  verdict_->setText(tr("%1 ranks, %2: imbalance %3 % (most elements / mean - 1), predicted efficiency %4 %")
                        .arg(domains.size())
                        .arg(json["how"].toString())
                        .arg(100 * (json["imbalance"].toDouble() - 1), 0, 'f', 1)
                        .arg(100 * json["efficiency"].toDouble(), 0, 'f', 1));
}

void DomainsPanel::show_measured(const RunStatus& status, int ranks) {
  measured_->setText(status.state.isEmpty() ? QString()
                                            : tr("Measured in the last run on %1 ranks: imbalance %2 %, %3 a second")
                                                  .arg(ranks)
                                                  .arg(100 * (status.imbalance - 1), 0, 'f', 1)
                                                  .arg(quantity_words(status.speed, tr("element-steps"))));
}

}  // namespace breccia::gui
