#pragma once

#include <QPainter>
#include <QPalette>
#include <QStringList>

namespace breccia::gui {

/// Where values are on a widget.
struct ChartFrame {
  QRectF box;
  double left = 0, right = 1, bottom = 0, top = 1;
  [[nodiscard]] QPointF at(double x, double y) const;
};

/// Round steps on an axis: at most six.
[[nodiscard]] double tick_of(double span);

/// Grid, numbers, base line and titles "name [unit]".
/// @param x_words  what stands at 0, 1, 2... instead of numbers; empty: numbers
void paint_axes(QPainter& painter, const ChartFrame& frame, const QPalette& palette, const QString& x, const QString& y,
                const QStringList& x_words = {});

}  // namespace breccia::gui
