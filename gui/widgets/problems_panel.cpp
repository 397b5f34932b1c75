#include "widgets/problems_panel.hpp"

#include <QStyle>

#include "core/case_outline.hpp"

namespace breccia::gui {
namespace {
constexpr int kKey = Qt::UserRole, kLine = Qt::UserRole + 1;
}

ProblemsPanel::ProblemsPanel(const Document& document, QWidget* parent) : QListWidget(parent), document_(document) {
  setObjectName("problems");
  setAccessibleName(tr("Messages"));
  setToolTip(tr("Problems of the case and advice of the solver; Enter or a double click leads to the field"));
  setWordWrap(true);
  connect(this, &QListWidget::itemActivated, this, &ProblemsPanel::go);
}

void ProblemsPanel::go(QListWidgetItem* item) {
  if (const QString key = item->data(kKey).toString(); !key.isEmpty())
    emit place_wanted(key, item->data(kLine).toInt());
}

void ProblemsPanel::rebuild() {
  clear();
  for (const Problem& p : problems_) {
    Problem shown = p;
    shown.file.clear();
    shown.key = words_of(QString::fromStdString(p.key), document_.places()).replace(": ", " ").toStdString();
    QString words = QString::fromStdString(shown.text());
    if (p.line > 0) words = tr("line %1: %2").arg(p.line).arg(words);
    auto* item = new QListWidgetItem(style()->standardIcon(QStyle::SP_MessageBoxCritical), words, this);
    item->setData(kKey, QString::fromStdString(p.key.empty() ? "title" : p.key));
    item->setData(kLine, p.line);
    item->setToolTip(QString::fromStdString(p.key));
    item->setData(Qt::AccessibleTextRole, tr("Problem: %1").arg(words));
  }
  for (const QString& words : troubles_) {
    auto* item = new QListWidgetItem(style()->standardIcon(QStyle::SP_MessageBoxCritical), words, this);
    item->setData(Qt::AccessibleTextRole, tr("Trouble: %1").arg(words));
  }
  for (const QString& words : messages_)
    new QListWidgetItem(style()->standardIcon(QStyle::SP_MessageBoxWarning), words, this);
  for (const QString& words : advice_)
    new QListWidgetItem(style()->standardIcon(QStyle::SP_MessageBoxInformation), tr("Advice: %1").arg(words), this);
}

void ProblemsPanel::set_problems(const std::vector<Problem>& problems) {
  problems_ = problems;
  rebuild();
}

void ProblemsPanel::set_advice(const QStringList& advice) {
  advice_ = advice;
  messages_.clear();
  rebuild();
}

void ProblemsPanel::add_message(const QString& text) {
  if (messages_.contains(text)) return;
  messages_ << text;
  rebuild();
}

bool ProblemsPanel::set_trouble(const QString& what, const QString& text) {
  if (troubles_.value(what) == text) return false;
  text.isEmpty() ? static_cast<void>(troubles_.remove(what)) : static_cast<void>(troubles_.insert(what, text));
  rebuild();
  return true;
}

void ProblemsPanel::next_problem() {
  const int n = static_cast<int>(problems_.size());
  if (n == 0) return;
  const int row = (currentRow() + 1) % n;
  setCurrentRow(row);
  go(item(row));
}

}  // namespace breccia::gui
