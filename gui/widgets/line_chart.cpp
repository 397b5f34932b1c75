#include "widgets/line_chart.hpp"

#include <QPainterPath>
#include <QRegularExpression>
#include <algorithm>
#include <array>
#include <cmath>

#include "render/prefixed_unit.hpp"
#include "widgets/chart_frame.hpp"

namespace breccia::gui {
namespace {

constexpr std::size_t kMostMarked = 60;  // points of a line that get marks

QPen pen_of(int number) {
  static const std::array<QColor, 6> colours{QColor(0, 114, 178),   QColor(213, 94, 0),  QColor(0, 158, 115),
                                             QColor(204, 121, 167), QColor(230, 159, 0), QColor(86, 180, 233)};
  static const std::array<Qt::PenStyle, 4> styles{Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine};
  const auto n = static_cast<std::size_t>(number);
  return QPen(colours[n % colours.size()], 2, styles[n % styles.size()]);
}

void paint_mark(QPainter& painter, const QPointF& at, int number) {
  constexpr double r = 4;
  const QPen pen = painter.pen();
  painter.setPen(QPen(pen.color(), 1.5));
  painter.setBrush(number % 2 == 0 ? QBrush(pen.color()) : QBrush(Qt::NoBrush));
  switch (number % 3) {
    case 0:
      painter.drawEllipse(at, r, r);
      break;
    case 1:
      painter.drawRect(QRectF(at.x() - r, at.y() - r, 2 * r, 2 * r));
      break;
    default:
      painter.drawPolygon(QPolygonF({{at.x(), at.y() - r}, {at.x() + r, at.y() + r}, {at.x() - r, at.y() + r}}));
  }
  painter.setPen(pen);
  painter.setBrush(Qt::NoBrush);
}

/// Room around the values, also where they are all the same.
void widen(double& low, double& high) {
  const double room = high > low ? 0.05 * (high - low) : std::max(0.5 * std::abs(high), 1e-12);
  low -= room;
  high += room;
}

/// Puts values into a unit in which they are short. @return  the title with that unit
/// @param size  out: of the unit, SI
QString scaled(const QString& title, std::vector<PlotLine>& lines, std::vector<double> PlotLine::*values,
               double& size) {
  size = 1;
  static const QRegularExpression pattern(R"(^(.*) \[([^\[\]]+)\]$)");
  const auto match = pattern.match(title);
  if (!match.hasMatch()) return title;
  double largest = 0;
  for (const PlotLine& line : lines)
    for (const double v : line.*values)
      if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  const PrefixedUnit unit = prefixed_unit(largest, match.captured(2).toStdString());
  size = unit.size;
  for (PlotLine& line : lines)
    for (double& v : line.*values) v /= size;
  return QString("%1 [%2]").arg(match.captured(1), QString::fromStdString(unit.name));
}

}  // namespace

LineChart::LineChart(QWidget* parent) : QWidget(parent) {}

void LineChart::show_lines(std::vector<PlotLine> lines, const QString& x_title, const QString& y_title,
                           const QStringList& x_words) {
  lines_ = std::move(lines);
  shown_ = lines_;
  double y_unit = 1;
  x_unit_ = 1;
  x_title_ = x_words.isEmpty() ? scaled(x_title, shown_, &PlotLine::x, x_unit_) : x_title;
  y_title_ = scaled(y_title, shown_, &PlotLine::y, y_unit);
  x_words_ = x_words;
  QStringList names;
  for (const PlotLine& line : lines_) names << line.name;
  for (const ChartMark& mark : marks_) names << mark.name;
  setAccessibleDescription(tr("%1 over %2: %3").arg(y_title_, x_title_, names.join(", ")));
  update();
}

void LineChart::paint_line(QPainter& painter, const ChartFrame& frame, const PlotLine& line, int number) const {
  QPainterPath path;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const QPointF at = frame.at(line.x[i], line.y[i]);
    i == 0 ? path.moveTo(at) : path.lineTo(at);
  }
  painter.setPen(pen_of(number));
  painter.drawPath(path);
  if (line.x.size() > kMostMarked) return;
  for (std::size_t i = 0; i < line.x.size(); ++i) paint_mark(painter, frame.at(line.x[i], line.y[i]), number);
}

void LineChart::paint_marks(QPainter& painter, const ChartFrame& frame) const {
  const QColor ink = palette().color(QPalette::WindowText);
  const QFontMetrics metrics(painter.font());
  double free_to = frame.box.right();  // words of earlier marks give way
  for (auto mark = marks_.rbegin(); mark != marks_.rend(); ++mark) {
    const double x = frame.at(mark->at / x_unit_, frame.bottom).x();
    if (x < frame.box.left() || x > frame.box.right()) continue;
    painter.setPen(QPen(ink, 1, Qt::DashLine));
    painter.drawLine(QPointF(x, frame.box.top()), QPointF(x, frame.box.bottom()));
    const double begin = x - metrics.horizontalAdvance(mark->name) - 4;
    if (begin < frame.box.left() || x > free_to) continue;
    painter.setPen(ink);
    painter.drawText(QPointF(begin, frame.box.bottom() - metrics.descent() - 2), mark->name);
    free_to = begin;
  }
}

void LineChart::paint_legend(QPainter& painter, const QRectF& box) const {
  const QFontMetrics metrics(painter.font());
  double line = box.top();
  for (int i = 0; i < static_cast<int>(lines_.size()) && line + metrics.height() < box.bottom(); ++i) {
    painter.setPen(pen_of(i));
    const double middle = line + metrics.height() / 2.0;
    painter.drawLine(QPointF(box.left(), middle), QPointF(box.left() + 28, middle));
    if (lines_[static_cast<std::size_t>(i)].x.size() <= kMostMarked) paint_mark(painter, {box.left() + 14, middle}, i);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QPointF(box.left() + 34, line + metrics.ascent()), lines_[static_cast<std::size_t>(i)].name);
    line += metrics.height() + 3;
  }
}

void LineChart::paintEvent(QPaintEvent*) {
  double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
  int widest = 0;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPointSizeF(0.85 * font.pointSizeF());
  painter.setFont(font);
  const QFontMetrics metrics(font);
  for (const PlotLine& line : shown_) {
    for (const double x : line.x) left = std::min(left, x), right = std::max(right, x);
    for (const double y : line.y) bottom = std::min(bottom, y), top = std::max(top, y);
    widest = std::max(widest, metrics.horizontalAdvance(line.name));
  }
  if (!(left <= right)) return;
  if (!x_words_.isEmpty()) left = 0, right = static_cast<double>(x_words_.size() - 1);
  widen(left, right);
  widen(bottom, top);
  const double height_of_line = metrics.height(), legend = std::min(widest + 44.0, 0.45 * width());
  const QRectF box(66, 1.6 * height_of_line, width() - 66 - legend - 16, height() - 4 * height_of_line);
  if (box.width() < 20 || box.height() < 20) return;
  const ChartFrame frame{box, left, right, bottom, top};
  paint_axes(painter, frame, palette(), x_title_, y_title_, x_words_);
  for (std::size_t i = 0; i < shown_.size(); ++i) paint_line(painter, frame, shown_[i], static_cast<int>(i));
  paint_marks(painter, frame);
  paint_legend(painter, QRectF(box.right() + 12, box.top(), legend, height() - box.top()));
}

}  // namespace breccia::gui
