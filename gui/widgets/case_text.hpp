#pragma once

#include <QPlainTextEdit>
#include <set>

#include "core/document.hpp"

namespace breccia::gui {

class LineNumbers;

/// The text of the case, its lines numbered as in messages. Typing edits the document, edits of the forms show here.
class CaseText final : public QPlainTextEdit {
  Q_OBJECT
 public:
  explicit CaseText(Document& document, QWidget* parent = nullptr);
  void set_problems(const std::vector<Problem>& problems);
  void go_to_line(int line);

 signals:
  void line_entered(int line);

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void take_text();
  void show_text();
  void make_numbers();
  void place_numbers();
  void paint_numbers(const QRect& part);

  Document& document_;
  LineNumbers* numbers_;
  std::set<int> wrong_lines_;
  bool own_edit_ = false, showing_ = false;
  QByteArray line_end_ = "\n";
};

}  // namespace breccia::gui
