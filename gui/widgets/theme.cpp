#include "widgets/theme.hpp"

#include <QApplication>
#include <QPainter>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleFactory>
#include <QStyleOption>
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

/// Fusion outlines boxes to tick by a darker shade of the window, which is not seen in a dark one.
class OutlinedBoxes final : public QProxyStyle {
 public:
  OutlinedBoxes() : QProxyStyle(QStyleFactory::create("Fusion")) {}

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    if (element != PE_IndicatorCheckBox || option->palette.color(QPalette::Window).lightness() >= 128) return;
    painter->setPen(option->palette.color(QPalette::PlaceholderText));
    painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
  }
};

}  // namespace

bool system_is_dark() { return QApplication::palette().color(QPalette::Window).lightness() < 128; }

void apply_theme(bool dark) {
  QApplication::setStyle(new OutlinedBoxes);
  QApplication::setPalette(palette_of(dark));
  QToolTip::setPalette(palette_of(dark));
}

}  // namespace breccia::gui
