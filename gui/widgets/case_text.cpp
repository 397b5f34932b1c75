#include "widgets/case_text.hpp"

#include <QFontDatabase>
#include <QKeyEvent>
#include <QTextBlock>

namespace breccia::gui {

CaseText::CaseText(Document& document, QWidget* parent) : QPlainTextEdit(parent), document_(document) {
  setObjectName("case_text");
  setAccessibleName(tr("Text of the case"));
  setToolTip(tr("The case as the solver reads it (TOML); forms and text follow each other"));
  setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  setLineWrapMode(NoWrap);
  setUndoRedoEnabled(false);  // the document remembers, so that forms and text have one history
  setTabChangesFocus(true);
  connect(this, &QPlainTextEdit::textChanged, this, &CaseText::take_text);
  connect(&document_, &Document::changed, this, &CaseText::show_text);
  connect(this, &QPlainTextEdit::cursorPositionChanged, this, [this] {
    if (!showing_ && hasFocus()) emit line_entered(textCursor().blockNumber() + 1);
  });
}

void CaseText::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Undo)) {
    document_.undo_stack().undo();
  } else if (event->matches(QKeySequence::Redo)) {
    document_.undo_stack().redo();
  } else {
    QPlainTextEdit::keyPressEvent(event);
  }
}

void CaseText::take_text() {
  if (showing_ || isReadOnly()) return;
  QByteArray bytes = toPlainText().toUtf8();
  if (line_end_ != "\n") bytes.replace("\n", line_end_);
  own_edit_ = true;
  document_.set_text(bytes);
  own_edit_ = false;
}

void CaseText::show_text() {
  if (own_edit_) return;
  showing_ = true;
  const QByteArray bytes = document_.text();
  line_end_ = bytes.contains("\r\n") ? "\r\n" : "\n";
  setReadOnly(!document_.is_open() || !document_.editable_as_text());
  const std::string before = toPlainText().toStdString();
  const std::string after = QString::fromUtf8(bytes).replace("\r\n", "\n").toStdString();
  if (before != after) {
    // Only what differs is replaced, so that the place one looks at stays. Positions are those of QString.
    const QString old_text = QString::fromStdString(before), new_text = QString::fromStdString(after);
    int front = 0, back = 0;
    const auto most = static_cast<int>(std::min(old_text.size(), new_text.size()));
    while (front < most && old_text[front] == new_text[front]) ++front;
    while (back < most - front && old_text[old_text.size() - 1 - back] == new_text[new_text.size() - 1 - back]) ++back;
    QTextCursor cursor(document());
    cursor.setPosition(front);
    cursor.setPosition(static_cast<int>(old_text.size()) - back, QTextCursor::KeepAnchor);
    cursor.insertText(new_text.mid(front, new_text.size() - front - back));
  }
  showing_ = false;
}

void CaseText::set_problems(const std::vector<Problem>& problems) {
  QList<QTextEdit::ExtraSelection> marks;
  for (const Problem& p : problems) {
    const QTextBlock block = document()->findBlockByNumber(p.line - 1);
    if (p.line <= 0 || !block.isValid()) continue;
    QTextEdit::ExtraSelection mark;
    mark.cursor = QTextCursor(block);
    mark.cursor.select(QTextCursor::LineUnderCursor);
    mark.format.setUnderlineStyle(QTextCharFormat::WaveUnderline);
    mark.format.setUnderlineColor(QColor(208, 48, 48));
    mark.format.setToolTip(QString::fromStdString(p.text()));
    marks << mark;
  }
  setExtraSelections(marks);
}

void CaseText::go_to_line(int line) {
  const QTextBlock block = document()->findBlockByNumber(line - 1);
  if (!block.isValid()) return;
  setTextCursor(QTextCursor(block));
  centerCursor();
}

}  // namespace breccia::gui
