#pragma once

#include <QWidget>
#include <functional>

namespace breccia::gui {

/// The strip beside a text in which the numbers of its lines stand: what draws them is the text's own.
class LineNumbers final : public QWidget {
 public:
  LineNumbers(QWidget* text, std::function<void(QPaintEvent*)> paint) : QWidget(text), paint_(std::move(paint)) {
    setObjectName("line_numbers");
  }

 protected:
  void paintEvent(QPaintEvent* event) override { paint_(event); }

 private:
  std::function<void(QPaintEvent*)> paint_;
};

}  // namespace breccia::gui
