#pragma once

#include <QAbstractButton>
#include <QApplication>
#include <QMessageBox>
#include <QTest>
#include <QTimer>

namespace breccia::gui::test {

/// Answers every question that is asked while it lives.
class Answer {
 public:
  /// Clicks a button, the first one where there is none of the kind; NoButton: presses Escape.
  explicit Answer(QMessageBox::StandardButton button) {
    QObject::connect(&timer_, &QTimer::timeout, [this, button] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      words_ << box->text();
      details_ << box->informativeText();
      if (button == QMessageBox::NoButton) return QTest::keyClick(box, Qt::Key_Escape);
      QAbstractButton* wanted = box->button(button);
      (wanted != nullptr ? wanted : box->buttons().front())->click();
    });
    timer_.start(50);
  }
  [[nodiscard]] const QStringList& words() const { return words_; }
  [[nodiscard]] const QStringList& details() const { return details_; }

 private:
  QTimer timer_;
  QStringList words_, details_;
};

}  // namespace breccia::gui::test
