#include "widgets/case_tree.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>
#include <QStyle>
#include <QVBoxLayout>
#include <algorithm>

namespace breccia::gui {
namespace {

constexpr int kBesideName = 16;  // pixels: margins and frame
constexpr int kPath = Qt::UserRole, kStage = Qt::UserRole + 1, kRemovable = Qt::UserRole + 2;

bool inside(const std::string& key, const std::string& path) {
  return key == path || key.starts_with(path + ".") || key.starts_with(path + "[");
}

}  // namespace

CaseTree::CaseTree(Document& document, QWidget* parent)
    : QWidget(parent), document_(document), tree_(new QTreeWidget), add_(new QToolButton), remove_(new QPushButton) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 4, 4, 4);
  tree_->setObjectName("stages");
  tree_->setAccessibleName(tr("Stages of the work"));
  tree_->setToolTip(tr("Steps of the work and the parts of the case; a mark counts the problems there"));
  tree_->setHeaderHidden(true);
  tree_->setColumnCount(1);
  column->addWidget(tree_);
  setFocusProxy(tree_);
  int widest = 0;  // names of stages are seen whole; an entry may have any name
  for (const WorkStage& stage : work_stages()) widest = std::max(widest, fontMetrics().horizontalAdvance(stage.name));
  tree_->setMinimumWidth(widest + tree_->indentation() + style()->pixelMetric(QStyle::PM_ScrollBarExtent) +
                         kBesideName);
  auto* row = new QHBoxLayout;
  add_->setText(tr("Add"));
  add_->setObjectName("add_entry");
  add_->setAccessibleName(tr("Add an entry"));
  add_->setToolTip(tr("Add a material, a joint law, a constraint, ... to the case"));
  add_->setPopupMode(QToolButton::InstantPopup);
  add_->setToolButtonStyle(Qt::ToolButtonTextOnly);
  add_->setFocusPolicy(Qt::StrongFocus);
  add_->setMenu(new QMenu(add_));
  remove_->setText(tr("Remove"));
  remove_->setObjectName("remove_entry");
  remove_->setAccessibleName(tr("Remove the entry"));
  remove_->setToolTip(tr("Remove the selected part of the case (Ctrl+Z brings it back)"));
  row->addWidget(add_);
  row->addWidget(remove_);
  row->addStretch();
  column->addLayout(row);
  connect(tree_, &QTreeWidget::currentItemChanged, this, &CaseTree::take_selection);
  connect(&document_, &Document::changed, this, &CaseTree::rebuild);
  connect(add_->menu(), &QMenu::aboutToShow, this, &CaseTree::fill_menu);
  connect(remove_, &QPushButton::clicked, this, [this] { document_.remove(path_); });
  rebuild();
}

void CaseTree::rebuild() {
  building_ = true;
  tree_->clear();
  QTreeWidgetItem* current = nullptr;
  const auto& stages = work_stages();
  for (int s = 0; s < static_cast<int>(stages.size()); ++s) {
    const WorkStage& stage = stages[static_cast<std::size_t>(s)];
    auto* item = new QTreeWidgetItem(tree_, {stage.name});
    item->setData(0, kStage, s);
    QTreeWidgetItem* entry = item;
    int problems = 0;
    const std::vector<OutlineRow> rows = outline(stage, document_.places());
    if (!rows.empty()) item->setData(0, kPath, rows.front().path);
    for (const OutlineRow& row : rows) {
      auto* line = new QTreeWidgetItem(row.depth == 0 ? item : entry, {row.label});
      if (row.depth == 0) entry = line;
      line->setData(0, kPath, row.path);
      line->setToolTip(0, row.label);
      line->setData(0, kStage, s);
      line->setData(0, kRemovable, row.removable);
      int here = 0;
      for (const Problem& p : problems_) here += !row.path.isEmpty() && inside(p.key, row.path.toStdString()) ? 1 : 0;
      if (here > 0) line->setText(0, tr("%1  ⚠ %2").arg(row.label).arg(here));
      if (!row.present) line->setForeground(0, palette().brush(QPalette::Disabled, QPalette::Text));
      if (stage_ == s && row.path == path_) current = line;
    }
    for (const Problem& p : problems_)
      problems += stage.kind == WorkStage::Kind::sections && stage_of(p.key) == s ? 1 : 0;
    if (problems > 0) item->setText(0, tr("%1  ⚠ %2").arg(stage.name).arg(problems));
    item->setExpanded(true);
    for (int i = 0; i < item->childCount(); ++i) item->child(i)->setExpanded(true);
    if (stage_ == s && current == nullptr) current = item;
  }
  tree_->setCurrentItem(current);
  building_ = false;
  take_selection();
}

void CaseTree::take_selection() {
  QTreeWidgetItem* item = tree_->currentItem();
  if (building_ || item == nullptr) return;
  const int stage = item->data(0, kStage).toInt();
  const QString path = item->data(0, kPath).toString();
  remove_->setEnabled(item->data(0, kRemovable).toBool());
  add_->setEnabled(!lists_of(work_stages()[static_cast<std::size_t>(stage)], document_.places()).empty());
  if (stage == stage_ && path == path_) return;
  stage_ = stage;
  path_ = path;
  emit selected(stage_, path_);
}

void CaseTree::fill_menu() {
  add_->menu()->clear();
  for (const QString& list : lists_of(work_stages()[static_cast<std::size_t>(stage_)], document_.places()))
    add_->menu()->addAction(list, this, [this, list] {
      document_.add_entry(list, lines_of_new_entry(list, document_.places(), groups_));
      select(stage_, list + QString("[%1]").arg(document_.places().count(list.toStdString()) - 1));
    });
}

void CaseTree::select(int stage, const QString& path) {
  QTreeWidgetItemIterator it(tree_);
  QTreeWidgetItem* best = nullptr;
  for (; *it != nullptr; ++it) {
    if ((*it)->data(0, kStage).toInt() != stage) continue;
    const QString own = (*it)->data(0, kPath).toString();
    const bool fits = own == path || own.isEmpty() || inside(path.toStdString(), own.toStdString());
    if (best == nullptr || (fits && own.size() >= best->data(0, kPath).toString().size())) best = *it;
  }
  if (best != nullptr) tree_->setCurrentItem(best);
}

void CaseTree::set_problems(const std::vector<Problem>& problems) {
  problems_ = problems;
  rebuild();
}

}  // namespace breccia::gui
