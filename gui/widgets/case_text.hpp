#pragma once

#include <QPlainTextEdit>

#include "core/document.hpp"

namespace breccia::gui {

/// The text of the case. Typing edits the document, edits of the forms show here.
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

 private:
  void take_text();
  void show_text();

  Document& document_;
  bool own_edit_ = false, showing_ = false;
  QByteArray line_end_ = "\n";
};

}  // namespace breccia::gui
