#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTreeWidget>

#include "core/material_library.hpp"

namespace breccia::gui {

/// Materials with values and sources, those that came with the program and one's own. Accepted: `chosen` is wanted.
class LibraryDialog final : public QDialog {
  Q_OBJECT
 public:
  /// @param group  that the material is for, shown in the title
  LibraryDialog(const UserLibrary& library, const QString& group, QWidget* parent);
  [[nodiscard]] const LibraryMaterial* chosen() const;

 private:
  void fill();
  void show_chosen();
  void remove_chosen();

  const UserLibrary& library_;
  std::vector<LibraryMaterial> materials_;
  QLineEdit* filter_;
  QTreeWidget* list_;
  QTableWidget* values_;
  QLabel* note_;
  QPushButton *take_, *remove_;
};

}  // namespace breccia::gui
