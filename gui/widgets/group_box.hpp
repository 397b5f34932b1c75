#pragma once

#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <utility>

namespace breccia::gui {

/// A field for names of groups with a list of those that there are. What is typed stays as it was typed: it is neither
/// completed nor put into the list, and the arrow keys open the list instead of replacing it.
class GroupBox final : public QComboBox {
 public:
  explicit GroupBox(QWidget* parent = nullptr) : QComboBox(parent) {
    setEditable(true);
    setInsertPolicy(NoInsert);
    setCompleter(nullptr);
    connect(lineEdit(), &QLineEdit::textEdited, this, [this] { was_open_ = false; });
  }

  /// Of `activated`, which Qt emits for typed text as well: a name was chosen from the list. Once for each choice.
  [[nodiscard]] bool takes_choice() { return std::exchange(was_open_, false); }

  void showPopup() override {
    was_open_ = true;
    QComboBox::showPopup();
  }

 protected:
  void keyPressEvent(QKeyEvent* event) override {
    switch (event->key()) {
      case Qt::Key_Up:
      case Qt::Key_Down:
      case Qt::Key_PageUp:
      case Qt::Key_PageDown:
        return showPopup();
      default:
        return QComboBox::keyPressEvent(event);
    }
  }

 private:
  bool was_open_ = false;
};

}  // namespace breccia::gui
