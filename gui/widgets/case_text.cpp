#include "widgets/case_text.hpp"

#include <QFontDatabase>
#include <QKeyEvent>
#include <QPainter>
#include <QTextBlock>

#include "widgets/line_numbers.hpp"

namespace breccia::gui {
namespace {

constexpr int kBeside = 6;  // pixels on both sides of the numbers
const QColor kWrong(208, 48, 48);

}  // namespace

CaseText::CaseText(Document& document, QWidget* parent)
    : QPlainTextEdit(parent),
      document_(document),
      numbers_(new LineNumbers(this, [this](QPaintEvent* event) { paint_numbers(event->rect()); })) {
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
  make_numbers();
}

void CaseText::make_numbers() {
  connect(this, &QPlainTextEdit::blockCountChanged, this, &CaseText::place_numbers);
  connect(this, &QPlainTextEdit::cursorPositionChanged, numbers_, qOverload<>(&QWidget::update));
  connect(this, &QPlainTextEdit::updateRequest, this, [this](const QRect& part, int scrolled) {
    scrolled != 0 ? numbers_->scroll(0, scrolled) : numbers_->update(0, part.y(), numbers_->width(), part.height());
  });
  place_numbers();
}

/// As wide as the last number.
void CaseText::place_numbers() {
  const QString widest(QString::number(std::max(100, blockCount())).size(), '9');
  const int width = fontMetrics().horizontalAdvance(widest) + 2 * kBeside;
  setViewportMargins(width, 0, 0, 0);
  const QRect inside = contentsRect();
  numbers_->setGeometry(inside.left(), inside.top(), width, inside.height());
}

void CaseText::resizeEvent(QResizeEvent* event) {
  QPlainTextEdit::resizeEvent(event);
  place_numbers();
}

void CaseText::changeEvent(QEvent* event) {
  QPlainTextEdit::changeEvent(event);
  if (event->type() == QEvent::FontChange) place_numbers();
}

void CaseText::paint_numbers(const QRect& part) {
  QPainter painter(numbers_);
  painter.fillRect(part, palette().color(QPalette::Window));
  painter.setFont(font());
  QTextBlock block = firstVisibleBlock();
  auto top = static_cast<int>(blockBoundingGeometry(block).translated(contentOffset()).top());
  for (; block.isValid() && top <= part.bottom(); block = block.next()) {
    const auto height = static_cast<int>(blockBoundingRect(block).height());
    const int number = block.blockNumber() + 1;
    const bool wrong = wrong_lines_.count(number) != 0, here = number == textCursor().blockNumber() + 1;
    painter.setPen(wrong ? kWrong : palette().color(here ? QPalette::Active : QPalette::Disabled, QPalette::Text));
    painter.drawText(0, top, numbers_->width() - kBeside, height, Qt::AlignRight | Qt::AlignVCenter,
                     QString::number(number));
    top += height;
  }
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
    // Only what differs is replaced, so that the visible place is kept. Positions are those of QString.
    const QString old_text = QString::fromStdString(before), new_text = QString::fromStdString(after);
    int front = 0, back = 0;
    const auto most = static_cast<int>(std::min(old_text.size(), new_text.size()));
    while (front < most && old_text[front] == new_text[front]) ++front;
    while (back < most - front && old_text[old_text.size() - 1 - back] == new_text[new_text.size() - 1 - back]) ++back;
    QTextCursor cursor(document());
    cursor.setPosition(front);
    cursor.setPosition(static_cast<int>(old_text.size()) - back, QTextCursor::KeepAnchor);
    cursor.insertText(new_text.mid(front, new_text.size() - front - back));
    if (before.empty()) moveCursor(QTextCursor::Start);  // of a case that is opened the beginning is seen
  }
  showing_ = false;
}

void CaseText::set_problems(const std::vector<Problem>& problems) {
  QList<QTextEdit::ExtraSelection> marks;
  wrong_lines_.clear();
  for (const Problem& p : problems) {
    const QTextBlock block = document()->findBlockByNumber(p.line - 1);
    if (p.line <= 0 || !block.isValid()) continue;
    wrong_lines_.insert(p.line);
    QTextEdit::ExtraSelection mark;
    mark.cursor = QTextCursor(block);
    mark.cursor.select(QTextCursor::LineUnderCursor);
    mark.format.setUnderlineStyle(QTextCharFormat::WaveUnderline);
    mark.format.setUnderlineColor(kWrong);
    mark.format.setToolTip(QString::fromStdString(p.text()));
    marks << mark;
  }
  setExtraSelections(marks);
  numbers_->update();
}

void CaseText::go_to_line(int line) {
  const QTextBlock block = document()->findBlockByNumber(line - 1);
  if (!block.isValid()) return;
  setTextCursor(QTextCursor(block));
  centerCursor();
}

}  // namespace breccia::gui
