#pragma once

#include <QPushButton>
#include <QTableWidget>

#include "core/document.hpp"

namespace breccia::gui {

/// The [[contact]] of each pair of bodies: rows and columns are groups, a cell opens its entry. Values from an entry
/// for other groups are in italics, with a note.
class ContactMatrix final : public QWidget {
  Q_OBJECT
 public:
  explicit ContactMatrix(Document& document, QWidget* parent = nullptr);

 signals:
  void entry_wanted(const QString& path);
  /// The pair in hand: the view shows it. @param group  of the row
  void group_entered(const QString& group);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void refresh();
  void show_own();
  void show_cell(int row, int column);

  Document& document_;
  QTableWidget* table_;
  QPushButton* own_;
  QStringList groups_;
};

}  // namespace breccia::gui
