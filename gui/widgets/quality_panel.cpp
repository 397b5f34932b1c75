#include "widgets/quality_panel.hpp"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QVBoxLayout>
#include <algorithm>

namespace breccia::gui {
namespace {

constexpr double kLeast = 3;  // pixels: one element among thousands is seen as well

}  // namespace

HistogramView::HistogramView(QWidget* parent) : QWidget(parent) { setFocusPolicy(Qt::StrongFocus); }

void HistogramView::show_bars(const Histogram& bars, const QString& title) {
  bars_ = bars;
  title_ = title;
  chosen_ = -1;
  update();
}

void HistogramView::choose(int bar) {
  if (bar < -1 || bar >= static_cast<int>(bars_.counts.size())) return;
  chosen_ = bar;
  update();
  emit bar_chosen(bar);
}

QRectF HistogramView::place_of(int bar) const {
  const double line = fontMetrics().height(), foot = height() - 2.2 * line, top = 1.4 * line;
  const int most = *std::max_element(bars_.counts.begin(), bars_.counts.end());
  const double each = (width() - 20.0) / static_cast<double>(bars_.counts.size());
  const int count = bars_.counts[static_cast<std::size_t>(bar)];
  const double tall = count == 0 ? 0 : std::max(kLeast, (foot - top) * count / most);
  return {10 + each * bar + 2, foot - tall, each - 4, tall};
}

void HistogramView::paintEvent(QPaintEvent*) {
  if (bars_.counts.empty()) return;
  QPainter painter(this);
  const double line = fontMetrics().height();
  const QColor ink = palette().color(QPalette::WindowText);
  for (int bar = 0; bar < static_cast<int>(bars_.counts.size()); ++bar) {
    const QRectF place = place_of(bar);
    painter.fillRect(place, bar == chosen_ ? QColor(213, 94, 0) : QColor(0, 114, 178));
    painter.setPen(bar == chosen_ ? QPen(ink, 2) : QPen(Qt::NoPen));
    painter.drawRect(place.adjusted(-1, -1, 1, 1));
    painter.setPen(ink);
    const QRectF above(place.left() - 10, place.top() - line, place.width() + 20, line);
    painter.drawText(above, Qt::AlignCenter, QString::number(bars_.counts[static_cast<std::size_t>(bar)]));
    painter.drawText(QRectF(place.left() - 2, height() - 2.2 * line, place.width() + 4, line), Qt::AlignCenter,
                     QString::number(bars_.low + bars_.width * bar, 'g', 3));
  }
  painter.drawText(QRectF(0, height() - 1.15 * line, width(), line), Qt::AlignCenter, title_);
  if (hasFocus()) {
    painter.setPen(QPen(ink, 1, Qt::DotLine));
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void HistogramView::mousePressEvent(QMouseEvent* event) {
  setFocus();
  if (bars_.counts.empty()) return;
  const double each = (width() - 20.0) / static_cast<double>(bars_.counts.size());
  const int bar = static_cast<int>((event->pos().x() - 10) / each);
  choose(bar == chosen_ || bar >= static_cast<int>(bars_.counts.size()) ? -1 : bar);
}

void HistogramView::keyPressEvent(QKeyEvent* event) {
  const int last = static_cast<int>(bars_.counts.size()) - 1;
  if (event->key() == Qt::Key_Right && chosen_ < last) return choose(chosen_ + 1);
  if (event->key() == Qt::Key_Left && chosen_ > 0) return choose(chosen_ - 1);
  if (event->key() == Qt::Key_Home && last >= 0) return choose(0);
  if (event->key() == Qt::Key_Escape) return choose(-1);
  QWidget::keyPressEvent(event);
}

QualityPanel::QualityPanel(QWidget* parent)
    : QWidget(parent),
      measure_(new QComboBox),
      view_(new HistogramView),
      words_(new QLabel),
      measuring_([this](const Values& values) { show_values(values); }),
      collecting_([this](const vtkSmartPointer<vtkPolyData>& faces) { emit elements_chosen(faces, words_->text()); }) {
  setObjectName("quality");
  measure_->addItem(tr("radius ratio, 1 is regular"), static_cast<int>(ShapeMeasure::radius_ratio));
  measure_->addItem(tr("smallest dihedral angle [deg]"), static_cast<int>(ShapeMeasure::min_dihedral));
  measure_->addItem(tr("mean edge [mm]"), static_cast<int>(ShapeMeasure::mean_edge));
  measure_->setObjectName("quality_measure");
  measure_->setAccessibleName(tr("Measure of the elements"));
  measure_->setToolTip(tr("What the bars count; flat elements (radius ratio near 0) make the step short"));
  view_->setObjectName("quality_bars");
  view_->setAccessibleName(tr("Histogram of the elements"));
  view_->setToolTip(
      tr("A click on a bar, or the arrow keys, show its elements in the 3D view; Escape shows all again"));
  words_->setWordWrap(true);
  words_->setObjectName("quality_words");
  auto* row = new QHBoxLayout(this);
  auto* column = new QVBoxLayout;
  row->setContentsMargins(4, 4, 4, 4);
  column->addWidget(measure_);
  column->addWidget(words_);
  column->addStretch();
  row->addLayout(column, 1);
  row->addWidget(view_, 3);
  connect(measure_, qOverload<int>(&QComboBox::currentIndexChanged), this, &QualityPanel::measure_elements);
  connect(view_, &HistogramView::bar_chosen, this, &QualityPanel::choose);
}

void QualityPanel::set_mesh(const FrameData& mesh) {
  mesh_ = mesh;
  measure_elements();
}

void QualityPanel::measure_elements() {
  const auto measure = static_cast<ShapeMeasure>(measure_->currentData().toInt());
  measuring_.start([elements = mesh_.elements, measure]() -> Values {
    return std::make_shared<const ElementValues>(measure_shapes(elements, measure));
  });
}

void QualityPanel::show_values(const Values& values) {
  values_ = values;
  view_->show_bars(values_->bars, measure_->currentText());
  choose(-1);
}

void QualityPanel::choose(int bar) {
  const Histogram& bars = view_->bars();
  if (bar < 0 || values_ == nullptr || mesh_.elements == nullptr) {
    collecting_.forget();
    words_->setText(tr("%1 elements").arg(values_ == nullptr ? 0 : values_->values.size()));
    emit elements_chosen(nullptr, {});
    return;
  }
  const double low = bars.low + bars.width * bar;
  words_->setText(tr("%1 elements, %2: %3 to %4")
                      .arg(bars.counts[static_cast<std::size_t>(bar)])
                      .arg(measure_->currentText())
                      .arg(low, 0, 'g', 3)
                      .arg(low + bars.width, 0, 'g', 3));
  view_->setAccessibleDescription(words_->text());
  collecting_.start([mesh = mesh_, values = values_, bar] { return elements_of_bar(mesh, *values, bar); });
}

}  // namespace breccia::gui
