#pragma once

#include <QHBoxLayout>
#include <QResizeEvent>
#include <QWidget>
#include <algorithm>
#include <array>

namespace breccia::gui {

/// A bar of two rows, which stand side by side where there is room for both.
class FoldingBar final : public QWidget {
 public:
  explicit FoldingBar(QWidget* parent = nullptr) : QWidget(parent) {
    both_ = new QBoxLayout(QBoxLayout::LeftToRight, this);
    both_->setContentsMargins(0, 0, 0, 0);
    both_->setSizeConstraint(QLayout::SetNoConstraint);
    for (QHBoxLayout*& row : rows_) both_->addLayout(row = new QHBoxLayout);
  }

  [[nodiscard]] QHBoxLayout* row(std::size_t i) { return rows_[i]; }

  [[nodiscard]] QSize minimumSizeHint() const override {
    return {std::max(rows_[0]->minimumSize().width(), rows_[1]->minimumSize().width()), both_->minimumSize().height()};
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    const int wide = rows_[0]->minimumSize().width() + both_->spacing() + rows_[1]->minimumSize().width();
    both_->setDirection(event->size().width() < wide ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    updateGeometry();
  }

 private:
  QBoxLayout* both_;
  std::array<QHBoxLayout*, 2> rows_{};
};

}  // namespace breccia::gui
