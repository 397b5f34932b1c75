#include "widgets/contact_matrix.hpp"

#include <QHeaderView>
#include <QVBoxLayout>

#include "core/contact_pairs.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {

ContactMatrix::ContactMatrix(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      table_(new QTableWidget),
      own_(new QPushButton(tr("&Give this pair an entry of its own"))) {
  table_->setObjectName("contact_matrix");
  table_->setAccessibleName(tr("Contacts of the pairs of groups"));
  table_->setToolTip(
      tr("Penalty [Pa] and friction of each pair; Enter or a double click leads to the entry that holds. "
         "Italics: it is an entry for others as well"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setTabKeyNavigation(false);
  own_->setObjectName("own_contact");
  own_->setAccessibleName(tr("Give this pair an entry of its own"));
  own_->setToolTip(tr("A new [[contact]] for the pair of the cell, with the values it has now"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  column->addWidget(table_, 1);
  column->addWidget(own_, 0, Qt::AlignLeft);
  connect(&document_, &Document::changed, this, &ContactMatrix::refresh);
  connect(table_, &QTableWidget::cellActivated, this, [this](int row, int col) {
    bool own = false;
    if (const QString path = contact_of(document_, groups_[row], groups_[col], &own); !path.isEmpty())
      emit entry_wanted(path);
  });
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int row, int, int, int) {
    show_own();
    if (row >= 0 && row < groups_.size() && table_->hasFocus()) emit group_entered(groups_[row]);
  });
  connect(own_, &QPushButton::clicked, this, [this] {
    const int row = table_->currentRow(), col = table_->currentColumn();
    if (row < 0 || col < 0) return;
    const QString a = groups_[row], b = groups_[col];  // the edit refreshes the list
    emit entry_wanted(give_own_contact(document_, a, b));
  });
  own_->setEnabled(false);
}

void ContactMatrix::showEvent(QShowEvent* event) {
  refresh();
  QWidget::showEvent(event);
}

void ContactMatrix::show_own() {
  const int row = table_->currentRow(), column = table_->currentColumn();
  bool own = true;
  if (row >= 0 && column >= 0 && row < groups_.size() && column < groups_.size())
    (void)contact_of(document_, groups_[row], groups_[column], &own);
  own_->setEnabled(!own);
}

void ContactMatrix::refresh() {
  if (!isVisible()) return;  // typing elsewhere does not pay for it
  groups_ = groups_of(document_);
  const int n = static_cast<int>(groups_.size());
  table_->setRowCount(n);
  table_->setColumnCount(n);
  table_->setHorizontalHeaderLabels(groups_);
  table_->setVerticalHeaderLabels(groups_);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) show_cell(row, col);
  table_->resizeColumnsToContents();
  show_own();
}

void ContactMatrix::show_cell(int row, int column) {
  bool own = false;
  const QString path = contact_of(document_, groups_[row], groups_[column], &own);
  QString words = tr("no contact");
  const QString interaction =
      shown_value(case_::key_of("contact[].interaction"), document_.value(path + ".interaction"));
  if (!path.isEmpty() && interaction == "none") {
    words = tr("do not meet");
  } else if (!path.isEmpty()) {
    const QString friction = shown_value(case_::key_of("contact[].friction"), document_.value(path + ".friction"));
    const QString penalty = document_.value(path + ".penalty"), factor = document_.value(path + ".penalty_factor");
    words = (penalty.isEmpty()
                 ? (factor.isEmpty() ? shown_default(case_::key_of("contact[].penalty_factor")) : factor) + " E"
                 : shown_value(case_::key_of("contact[].penalty"), penalty)) +
            ", μ " + (friction.isEmpty() ? shown_default(case_::key_of("contact[].friction")) : friction);
  }
  if (table_->item(row, column) == nullptr) table_->setItem(row, column, new QTableWidgetItem);
  QTableWidgetItem* cell = table_->item(row, column);
  cell->setText(words);
  QFont font = table_->font();
  font.setItalic(!own);
  font.setBold(own);
  cell->setFont(font);
  cell->setToolTip(path.isEmpty() ? tr("No [[contact]] holds for %1 and %2").arg(groups_[row], groups_[column])
                   : own          ? tr("An entry of its own: %1").arg(path)
                                  : tr("From %1, which holds for others as well").arg(path));
}

}  // namespace breccia::gui
