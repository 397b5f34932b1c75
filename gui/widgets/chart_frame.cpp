#include "widgets/chart_frame.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::gui {

QPointF ChartFrame::at(double x, double y) const {
  return {box.left() + (x - left) / (right - left) * box.width(),
          box.bottom() - (y - bottom) / (top - bottom) * box.height()};
}

double tick_of(double span) {
  const double raw = span / 5, power = std::pow(10, std::floor(std::log10(std::max(raw, 1e-300))));
  for (const double step : {1.0, 2.0, 5.0})
    if (raw <= step * power) return step * power;
  return 10 * power;
}

void paint_axes(QPainter& painter, const ChartFrame& frame, const QPalette& palette, const QString& x, const QString& y,
                const QStringList& x_words) {
  constexpr double kRounding = 1e-9;  // of a step
  const QColor ink = palette.color(QPalette::WindowText);
  QColor grid = ink;
  grid.setAlpha(45);
  const QFontMetrics metrics(painter.font());
  const double step_x = x_words.isEmpty() ? tick_of(frame.right - frame.left) : 1;
  const double step_y = tick_of(frame.top - frame.bottom);
  const auto number = [](double v, double step) {
    return QString::number(std::abs(v) < kRounding * step ? 0 : v, 'g', 4);
  };
  for (double v = std::ceil(frame.left / step_x) * step_x; v <= frame.right + kRounding * step_x; v += step_x) {
    const QPointF p = frame.at(v, frame.bottom);
    painter.setPen(grid);
    painter.drawLine(p, frame.at(v, frame.top));
    painter.setPen(ink);
    painter.drawText(QRectF(p.x() - 60, p.y() + 3, 120, metrics.height()), Qt::AlignCenter,
                     x_words.isEmpty() ? number(v, step_x) : x_words.value(static_cast<int>(std::lround(v))));
  }
  for (double v = std::ceil(frame.bottom / step_y) * step_y; v <= frame.top + kRounding * step_y; v += step_y) {
    const QPointF p = frame.at(frame.left, v);
    painter.setPen(grid);
    painter.drawLine(p, frame.at(frame.right, v));
    painter.setPen(ink);
    painter.drawText(QRectF(p.x() - 64, p.y() - metrics.height() / 2.0, 60, metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, number(v, step_y));
  }
  painter.drawLine(frame.at(frame.left, frame.bottom), frame.at(frame.right, frame.bottom));
  painter.drawText(
      QRectF(frame.box.left(), frame.box.bottom() + metrics.height() + 3, frame.box.width(), metrics.height()),
      Qt::AlignCenter, x);
  painter.drawText(QRectF(frame.box.left() - 40, frame.box.top() - metrics.height() - 4, 400, metrics.height()),
                   Qt::AlignLeft, y);
}

}  // namespace breccia::gui
