#pragma once

#include <QPushButton>
#include <QTableWidget>

#include "core/document.hpp"

namespace breccia::gui {

/// Which [[contact]] holds for which pair of bodies: rows and columns are groups, a cell leads to its entry. Values
/// that a pair has from an entry for others are in italics and say so.
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
