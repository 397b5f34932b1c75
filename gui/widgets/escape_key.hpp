#pragma once

#include <QShortcut>
#include <QWidget>
#include <functional>

namespace breccia::gui {

/// The key of Escape in a field takes back what was typed there.
inline void on_escape(QWidget& field, const std::function<void()>& take_back) {
  auto* key = new QShortcut(QKeySequence(Qt::Key_Escape), &field, nullptr, nullptr, Qt::WidgetShortcut);
  QObject::connect(key, &QShortcut::activated, &field, take_back);
}

}  // namespace breccia::gui
