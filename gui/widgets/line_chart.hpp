#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

#include "core/plot_line.hpp"

namespace breccia::gui {

struct ChartFrame;

/// A place on the axis of x, across all lines.
struct ChartMark {
  double at = 0;  ///< SI
  QString name;
};

/// Lines with a legend, distinguished by dashes and marks as well as by colour.
class LineChart final : public QWidget {
  Q_OBJECT
 public:
  explicit LineChart(QWidget* parent = nullptr);
  /// Numbers on the axes get a prefix of their unit with which they are short.
  /// @param x_title, y_title  "name [unit]", of SI;  @param x_words  what stands at 0, 1, 2...; empty: numbers
  void show_lines(std::vector<PlotLine> lines, const QString& x_title, const QString& y_title,
                  const QStringList& x_words = {});
  /// Seen from the next lines on.
  void set_marks(std::vector<ChartMark> marks) { marks_ = std::move(marks); }
  [[nodiscard]] const std::vector<ChartMark>& marks() const { return marks_; }
  [[nodiscard]] QSize sizeHint() const override { return {420, 200}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {240, 120}; }
  [[nodiscard]] const std::vector<PlotLine>& lines() const { return lines_; }
  /// As they stand at the axes: "pressure [MPa]".
  [[nodiscard]] const QString& x_title() const { return x_title_; }
  [[nodiscard]] const QString& y_title() const { return y_title_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paint_line(QPainter& painter, const ChartFrame& frame, const PlotLine& line, int number) const;
  void paint_marks(QPainter& painter, const ChartFrame& frame) const;
  void paint_legend(QPainter& painter, const QRectF& box) const;

  std::vector<PlotLine> lines_, shown_;  ///< as given, and in the units of the axes
  std::vector<ChartMark> marks_;
  double x_unit_ = 1;  ///< of the axis, SI
  QString x_title_, y_title_;
  QStringList x_words_;
};

}  // namespace breccia::gui
