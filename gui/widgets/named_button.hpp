#pragma once

#include <QPushButton>

namespace breccia::gui {

/// A button whose accessible name is its text. @param name  by which tests and style find it
inline QPushButton* named_button(const QString& text, const QString& name, const QString& tip) {
  auto* made = new QPushButton(text);
  made->setObjectName(name);
  made->setAccessibleName(QString(text).remove('&').remove("..."));
  made->setToolTip(tip);
  return made;
}

}  // namespace breccia::gui
