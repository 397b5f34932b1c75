#pragma once

#include <QPushButton>
#include <QToolButton>
#include <QTreeWidget>

#include "core/case_outline.hpp"
#include "core/group_names.hpp"

namespace breccia::gui {

/// Stages of the work with the sections of the case below them, and buttons to add and to remove entries.
class CaseTree final : public QWidget {
  Q_OBJECT
 public:
  explicit CaseTree(Document& document, QWidget* parent = nullptr);

  [[nodiscard]] int stage() const { return stage_; }
  [[nodiscard]] const QString& path() const { return path_; }
  void select(int stage, const QString& path);
  void set_problems(const std::vector<Problem>& problems);
  /// Those of the mesh, which new entries are about.
  void set_groups(const std::optional<MeshGroups>& groups) { groups_ = groups; }

 signals:
  void selected(int stage, const QString& path);

 private:
  void rebuild();
  void take_selection();
  void fill_menu();

  Document& document_;
  QTreeWidget* tree_;
  QToolButton* add_;
  QPushButton* remove_;
  std::vector<Problem> problems_;
  std::optional<MeshGroups> groups_;
  int stage_ = 0;
  QString path_;
  bool building_ = false;
};

}  // namespace breccia::gui
