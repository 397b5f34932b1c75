#pragma once

#include <QAbstractSpinBox>
#include <QComboBox>
#include <QEvent>
#include <QScrollArea>

namespace breccia::gui {

/// Keeps the wheel from changing values that it only passes over: boxes to choose from or to count in take it with the
/// cursor in them alone, and never on a page that scrolls, which moves instead.
class WheelGuard final : public QObject {
 public:
  using QObject::QObject;

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::Wheel) return false;
    auto* box = qobject_cast<QWidget*>(watched);
    const bool counts = qobject_cast<QComboBox*>(box) != nullptr || qobject_cast<QAbstractSpinBox*>(box) != nullptr;
    if (!counts || (box->hasFocus() && !is_on_scrolled_page(*box))) return false;
    event->ignore();  // what lies below gets it
    return true;
  }

 private:
  static bool is_on_scrolled_page(const QWidget& box) {
    for (const QWidget* up = box.parentWidget(); up != nullptr; up = up->parentWidget())
      if (qobject_cast<const QScrollArea*>(up) != nullptr) return true;
    return false;
  }
};

}  // namespace breccia::gui
