#include "widgets/theme.hpp"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>
#include <QToolTip>

namespace breccia::gui {
namespace {

QPalette palette_of(bool dark) {
  const QColor window = dark ? QColor(45, 47, 51) : QColor(240, 241, 243), base = dark ? QColor(32, 34, 37) : Qt::white;
  const QColor ink = dark ? QColor(235, 236, 238) : QColor(25, 27, 30),
               dim = dark ? QColor(160, 163, 168) : QColor(105, 108, 112);
  const QColor accent(30, 110, 190);
  QPalette p;
  p.setColor(QPalette::Window, window);
  p.setColor(QPalette::Button, window);
  p.setColor(QPalette::Base, base);
  p.setColor(QPalette::AlternateBase, window);
  p.setColor(QPalette::ToolTipBase, base);
  p.setColor(QPalette::Highlight, accent);
  p.setColor(QPalette::HighlightedText, Qt::white);
  p.setColor(QPalette::Link, dark ? QColor(110, 175, 240) : accent);
  for (const QPalette::ColorRole role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
    p.setColor(role, ink);
    p.setColor(QPalette::Disabled, role, dim);
  }
  p.setColor(QPalette::PlaceholderText, dim);
  return p;
}

}  // namespace

bool system_is_dark() { return QApplication::palette().color(QPalette::Window).lightness() < 128; }

void apply_theme(bool dark) {
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setPalette(palette_of(dark));
  QToolTip::setPalette(palette_of(dark));
}

}  // namespace breccia::gui
