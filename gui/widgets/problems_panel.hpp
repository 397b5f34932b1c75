#pragma once

#include <QListWidget>
#include <QMap>

#include "base/error.hpp"
#include "core/document.hpp"

namespace breccia::gui {

/// What is wrong with the case and what the solver advises, in its words; a row leads to its field.
class ProblemsPanel final : public QListWidget {
  Q_OBJECT
 public:
  explicit ProblemsPanel(const Document& document, QWidget* parent = nullptr);
  void set_problems(const std::vector<Problem>& problems);
  void set_advice(const QStringList& advice);
  void add_message(const QString& text);
  /// Shows a failure of the desktop until it is resolved. @param text  empty: resolved
  /// @return  whether that is news
  bool set_trouble(const QString& what, const QString& text);
  /// Goes to the next problem, round and round.
  void next_problem();

 signals:
  void place_wanted(const QString& key, int line);

 private:
  void rebuild();
  void go(QListWidgetItem* item);
  std::vector<Problem> problems_;
  QStringList advice_, messages_;
  QMap<QString, QString> troubles_;
  const Document& document_;
};

}  // namespace breccia::gui
