#include "widgets/joint_plot.hpp"

#include <QJsonArray>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "widgets/chart_frame.hpp"
#include "widgets/run_panel.hpp"

namespace breccia::gui {
namespace {

constexpr double kMicro = 1e6, kMega = 1e-6;
const QColor kOpening(0, 114, 178), kSliding(213, 94, 0);

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

JointPlot::JointPlot(QWidget* parent) : QWidget(parent) {
  setObjectName("joint_plot");
  setAccessibleName(tr("Curves of the joint law"));
  setToolTip(tr(
      "Traction over opening [um] (solid) and over slip [um] (dashed), as evaluated by the solver; the areas are the "
      "fracture energies, the dotted line is unloading from half of the opening. At the right: the strength under "
      "normal and shear traction [MPa]"));
}

JointPlot::Series JointPlot::series(const QJsonObject& from, const char* x, const char* y, double x_scale) {
  Series out;
  for (const QJsonValue& v : from[x].toArray()) out.x.push_back(x_scale * v.toDouble());
  for (const QJsonValue& v : from[y].toArray()) out.y.push_back(kMega * v.toDouble());
  if (out.x.size() != out.y.size()) out = {};
  return out;
}

void JointPlot::show_law(const QJsonObject& law, const QString& words) {
  words_ = words;
  const QJsonObject normal = law["normal"].toObject(), shear = law["shear"].toObject();
  normal_ = series(normal, "opening", "traction", kMicro);
  shear_ = series(shear, "opening", "traction", kMicro);
  unloading_ = series(law["unloading"].toObject(), "opening", "traction", kMicro);
  envelope_ = series(law["envelope"].toObject(), "normal", "shear", kMega);
  energy_1_ = normal["energy"].toDouble();
  energy_2_ = shear["energy"].toDouble();
  if (!law.isEmpty()) {
    words_ = tr("h = %1, k = %2; broken at an opening of %3 or a slip of %4")
                 .arg(quantity_words(law["size"].toDouble(), "m"), quantity_words(law["stiffness"].toDouble(), "Pa/m"),
                      quantity_words(1e-6 * largest(normal_.x), "m"), quantity_words(1e-6 * largest(shear_.x), "m"));
  }
  setAccessibleDescription(words_);
  update();
}

int JointPlot::num_points() const { return static_cast<int>(normal_.x.size() + shear_.x.size() + envelope_.x.size()); }

void JointPlot::paint_curves(QPainter& painter, const QRectF& box) const {
  const ChartFrame frame{box, 0, 1.05 * std::max(largest(normal_.x), largest(shear_.x)), 0,
                         1.1 * std::max(largest(normal_.y), largest(shear_.y))};
  const auto path = [&](const Series& s) {
    QPainterPath p;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const QPointF at = frame.at(s.x[i], s.y[i]);
      i == 0 ? p.moveTo(at) : p.lineTo(at);
    }
    return p;
  };
  const auto area = [&](const Series& s, QColor colour) {
    colour.setAlpha(55);
    painter.fillPath(path(s), colour);
  };
  area(shear_, kSliding);
  area(normal_, kOpening);
  paint_axes(painter, frame, palette(), tr("opening, slip [um]"), tr("traction [MPa]"));
  painter.setPen(QPen(kSliding, 2, Qt::DashLine));
  painter.drawPath(path(shear_));
  painter.setPen(QPen(kOpening, 2));
  painter.drawPath(path(normal_));
  painter.setPen(QPen(kOpening, 1.5, Qt::DotLine));
  painter.drawPath(path(unloading_));
  painter.setPen(palette().color(QPalette::WindowText));
  const QFontMetrics metrics(painter.font());
  double line = box.top() + 2;
  for (const auto& [pen, text] :
       {std::pair{QPen(kOpening, 2), tr("opening, G_I = %1 J/m²").arg(energy_1_, 0, 'g', 4)},
        std::pair{QPen(kSliding, 2, Qt::DashLine), tr("sliding, G_II = %1 J/m²").arg(energy_2_, 0, 'g', 4)}}) {
    const double left = box.right() - metrics.horizontalAdvance(text) - 2;
    painter.setPen(pen);
    painter.drawLine(QPointF(left - 34, line + metrics.height() / 2.0),
                     QPointF(left - 6, line + metrics.height() / 2.0));
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRectF(left, line, box.right() - left + 2, metrics.height()), Qt::AlignLeft, text);
    line += metrics.height() + 2;
  }
}

void JointPlot::paint_envelope(QPainter& painter, const QRectF& box) const {
  const double low = envelope_.x.empty() ? 0 : *std::min_element(envelope_.x.begin(), envelope_.x.end());
  const double high = largest(envelope_.x);
  const ChartFrame frame{box, low, high + 0.1 * (high - low), 0, 1.1 * largest(envelope_.y)};
  QPainterPath line, area;
  for (std::size_t i = 0; i < envelope_.x.size(); ++i) {
    const QPointF at = frame.at(envelope_.x[i], envelope_.y[i]);
    i == 0 ? line.moveTo(at) : line.lineTo(at);
  }
  area = line;
  area.lineTo(frame.at(high, 0));
  area.lineTo(frame.at(low, 0));
  QColor inside(0, 158, 115);
  inside.setAlpha(45);
  painter.fillPath(area, inside);
  paint_axes(painter, frame, palette(), tr("normal traction, tension positive [MPa]"), tr("shear strength [MPa]"));
  painter.setPen(QPen(QColor(0, 158, 115), 2));
  painter.drawPath(line);
}

void JointPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPointSizeF(0.85 * font.pointSizeF());
  painter.setFont(font);
  const double line = QFontMetrics(font).height();
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(QRectF(8, 3, width() - 16, line), Qt::AlignLeft, words_);
  if (normal_.x.empty()) return;
  const double left = 58, gap = 70, top = 2.8 * line, foot = 2.4 * line;
  const double each = (width() - left - gap - 16) / 2, height_of_box = height() - top - foot;
  paint_curves(painter, {left, top, each, height_of_box});
  paint_envelope(painter, {left + each + gap, top, each, height_of_box});
}

}  // namespace breccia::gui
