#include "widgets/histogram_panel.hpp"

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
  }
  // A bar reaches from one number to the next, which stand at its edges.
  const auto bars = static_cast<int>(bars_.counts.size());
  const double each = (width() - 20.0) / bars, foot = height() - 2.2 * line;
  for (int edge = 0; edge <= bars; ++edge) {
    const double x = 10 + each * edge;
    painter.drawLine(QPointF(x, foot), QPointF(x, foot + 0.2 * line));
    const QString words = QString::number(bars_.low + bars_.width * edge, 'g', 3);
    const double wide = fontMetrics().horizontalAdvance(words);
    painter.drawText(
        QPointF(std::clamp(x - wide / 2, 0.0, width() - wide), foot + fontMetrics().ascent() + 0.15 * line), words);
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

HistogramPanel::HistogramPanel(QWidget* parent)
    : QWidget(parent),
      measure_(new QComboBox),
      view_(new HistogramView),
      words_(new QLabel),
      measuring_([this](const Counted& counted) { show_values(counted); }),
      collecting_([this](const vtkSmartPointer<vtkPolyData>& faces) { emit elements_chosen(faces, words_->text()); }) {
  setObjectName("histogram");
  for (const auto& [measure, name] : measures())
    measure_->addItem(QString::fromStdString(name), static_cast<int>(measure));
  measure_->setObjectName("histogram_measure");
  measure_->setAccessibleName(tr("Quantity of the histogram"));
  measure_->setToolTip(tr(
      "Quantity of the bars; flat elements (radius ratio near 0) make the step short; a result is the field by which "
      "the view is coloured"));
  view_->setObjectName("histogram_bars");
  view_->setAccessibleName(tr("Histogram"));
  view_->setToolTip(
      tr("A click on a bar, or the arrow keys, show its elements in the 3D view; Escape shows all again"));
  words_->setWordWrap(true);
  words_->setObjectName("histogram_words");
  auto* row = new QHBoxLayout(this);
  auto* column = new QVBoxLayout;
  row->setContentsMargins(4, 4, 4, 4);
  column->addWidget(measure_);
  column->addWidget(words_);
  column->addStretch();
  row->addLayout(column, 1);
  row->addWidget(view_, 3);
  connect(measure_, qOverload<int>(&QComboBox::currentIndexChanged), this, &HistogramPanel::measure_elements);
  connect(view_, &HistogramView::bar_chosen, this, &HistogramPanel::choose);
}

void HistogramPanel::set_frame(const FrameData& frame, bool follows) {
  if (!follows) {
    keeps_ = -1;
  } else if (view_->chosen() >= 0) {
    keeps_ = view_->chosen();
  }
  frame_ = frame;
  measure_elements();
}

void HistogramPanel::follow(Colouring colouring) {
  const std::optional<Quantity> quantity = quantity_of(colouring);
  const Measure wanted = quantity ? measure_of(*quantity) : measure();
  measure_->setCurrentIndex(measure_->findData(static_cast<int>(wanted)));
}

void HistogramPanel::measure_elements() {
  measuring_.start([frame = frame_, measure = measure()]() -> Counted {
    return std::make_shared<const Counts>(Counts{frame, values_of(frame, measure)});
  });
}

void HistogramPanel::show_values(const Counted& counted) {
  const bool same = values() != nullptr && values()->measure == counted->values.measure;
  const int bar = same && !counted->values.values.empty() ? keeps_ : -1;
  counted_ = counted;
  keeps_ = -1;
  view_->show_bars(counted->values.bars, measure_->currentText());
  view_->choose(bar);
}

void HistogramPanel::choose(int bar) {
  keeps_ = -1;
  const Histogram& bars = view_->bars();
  const ElementValues* told = values();
  const QString kind = told != nullptr && is_of_joints(told->measure) ? tr("joints") : tr("elements");
  if (bar < 0 || told == nullptr || told->values.empty()) {
    collecting_.forget();
    words_->setText(tr("%1 %2").arg(told == nullptr ? 0 : told->values.size()).arg(kind));
    view_->setAccessibleDescription(words_->text());
    emit elements_chosen(nullptr, {});
    return;
  }
  const double low = bars.low + bars.width * bar;
  words_->setText(tr("%1 %2, %3: %4 to %5")
                      .arg(bars.counts[static_cast<std::size_t>(bar)])
                      .arg(kind, measure_->currentText())
                      .arg(low, 0, 'g', 3)
                      .arg(low + bars.width, 0, 'g', 3));
  view_->setAccessibleDescription(words_->text());
  collecting_.start([counted = counted_, bar] { return faces_of_bar(counted->frame, counted->values, bar); });
}

}  // namespace breccia::gui
