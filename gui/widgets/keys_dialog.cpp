#include "widgets/keys_dialog.hpp"

#include <QAbstractButton>
#include <QCoreApplication>
#include <QDialog>
#include <QHeaderView>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTableWidget>
#include <QVBoxLayout>
#include <utility>
#include <vector>

namespace breccia::gui {
namespace {

using Rows = std::vector<std::pair<QString, QString>>;  // keys, and what they do

QString text(const char* words) { return QCoreApplication::translate("keys", words); }

QString plain(QString words) { return words.remove('&').remove("..."); }

void add_menu(const QMenu& menu, const QString& name, Rows& rows) {
  for (const QAction* action : menu.actions()) {
    const QString words = name + " > " + plain(action->text());
    if (action->menu() != nullptr) add_menu(*action->menu(), words, rows);
    for (const QKeySequence& keys : action->shortcuts())
      rows.emplace_back(keys.toString(QKeySequence::NativeText), words);
  }
}

/// Buttons and boxes; the key that goes with an underlined letter is seen at the button.
void add_buttons(const QMainWindow& window, Rows& rows) {
  for (const QAbstractButton* button : window.findChildren<QAbstractButton*>())
    if (!button->shortcut().isEmpty() && button->shortcut() != QKeySequence::mnemonic(button->text()))
      rows.emplace_back(button->shortcut().toString(QKeySequence::NativeText), button->accessibleName());
}

void add_ways(Rows& rows) {
  rows.emplace_back(text("drag in the view"), text("turn; with the middle button: move"));
  rows.emplace_back(text("wheel in the view"), text("zoom"));
  rows.emplace_back(text("click in the view"), text("choose a face or a group"));
  rows.emplace_back(text("left, right in the histogram"), text("the next bar; Escape: none"));
  rows.emplace_back(text("left, right at the frame slider"), text("the next frame"));
  rows.emplace_back(text("Enter in a table"), text("go to the entry, or open the run"));
  rows.emplace_back(text("space in a list"), text("tick a curve or a run"));
}

}  // namespace

void show_keys(QMainWindow& window) {
  if (auto* open = window.findChild<QDialog*>("keys"); open != nullptr) return open->raise();
  Rows rows;
  for (const QAction* action : window.menuBar()->actions())
    if (action->menu() != nullptr) add_menu(*action->menu(), plain(action->text()), rows);
  add_buttons(window, rows);
  add_ways(rows);
  auto* dialog = new QDialog(&window);
  dialog->setObjectName("keys");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(text("Keys"));
  auto* table = new QTableWidget(static_cast<int>(rows.size()), 2);
  table->setObjectName("keys_table");
  table->setAccessibleName(text("Keys"));
  table->setToolTip(text("Functions of keys and mouse"));
  table->setHorizontalHeaderLabels({text("key"), text("does")});
  table->verticalHeader()->hide();
  table->horizontalHeader()->setStretchLastSection(true);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  for (int row = 0; row < table->rowCount(); ++row) {
    table->setItem(row, 0, new QTableWidgetItem(rows[static_cast<std::size_t>(row)].first));
    table->setItem(row, 1, new QTableWidgetItem(rows[static_cast<std::size_t>(row)].second));
  }
  table->resizeColumnToContents(0);
  auto* column = new QVBoxLayout(dialog);
  column->addWidget(table);
  dialog->resize(520, 600);
  dialog->show();
}

}  // namespace breccia::gui
