#pragma once

#include <QByteArray>
#include <QSettings>
#include <QString>
#include <optional>

namespace breccia::gui {

/// How the window is arranged and coloured, from one session to the next: window.ini of the state folder.
class WindowMemory {
 public:
  explicit WindowMemory(const QString& state_folder);

  /// None: not chosen.
  [[nodiscard]] std::optional<bool> dark() const;
  void set_dark(bool dark);
  /// As of QWidget::saveGeometry and QMainWindow::saveState; empty: not kept.
  [[nodiscard]] QByteArray geometry() const;
  [[nodiscard]] QByteArray layout() const;
  void set_arrangement(const QByteArray& geometry, const QByteArray& layout);
  /// What went wrong with the last change; empty: nothing.
  [[nodiscard]] QString error();

 private:
  QSettings kept_;
};

}  // namespace breccia::gui
