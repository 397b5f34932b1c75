#include "widgets/cut_bar.hpp"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "core/value_text.hpp"
#include "render/prefixed_unit.hpp"
#include "widgets/escape_key.hpp"

namespace breccia::gui {
namespace {

constexpr int kTicks = 500;  // of the slider

/// A place with few digits, closer to the given one than the resolution of the slider.
double short_place(double place, const std::array<double, 2>& extent) {
  if (!(extent[1] > extent[0])) return place;
  const double step = std::pow(10, std::floor(std::log10((extent[1] - extent[0]) / kTicks)));
  return std::round(place / step) * step + 0.0;  // no "-0"
}

QString metres_words(double metres) {
  const PrefixedUnit unit = prefixed_unit(metres, "m");
  return QString("%1 %2").arg(metres / unit.size, 0, 'g', 5).arg(QString::fromStdString(unit.name));
}

}  // namespace

CutBar::CutBar(QWidget* parent)
    : QWidget(parent),
      way_(new QComboBox),
      slider_(new QSlider(Qt::Horizontal)),
      place_(new QLineEdit),
      other_(new QCheckBox(tr("Other side"))),
      action_(new QAction(tr("C&ut open"), this)) {
  make_fields();
  action_->setShortcut(QKeySequence("Ctrl+8"));
  action_->setCheckable(true);
  connect(action_, &QAction::triggered, this, [this](bool on) {
    way_->setCurrentIndex(on ? last_way_ : 0);
    choose_way();
    if (on) slider_->setFocus();
  });
  connect(way_, qOverload<int>(&QComboBox::activated), this, &CutBar::choose_way);
  connect(slider_, &QSlider::valueChanged, this, &CutBar::take_slider);
  connect(place_, &QLineEdit::editingFinished, this, &CutBar::take_typed);
  on_escape(*place_, [this] { show_place(); });
  connect(other_, &QCheckBox::toggled, this, [this] { set_place(at_); });
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(new QLabel(tr("Cut")));
  row->addWidget(way_);
  row->addWidget(slider_, 1);
  row->addWidget(place_);
  row->addWidget(other_);
  row->addStretch();
  choose_way();
}

void CutBar::make_fields() {
  const auto add = [this](const QString& text, Way way) { way_->addItem(text, static_cast<int>(way)); };
  add(tr("none"), Way::none);
  add(tr("x"), Way::x);
  add(tr("y"), Way::y);
  add(tr("z"), Way::z);
  add(tr("the view"), Way::view);
  way_->setObjectName("cut_way");
  way_->setAccessibleName(tr("Cut across"));
  way_->setToolTip(
      tr("Cut the model by a plane across an axis, or across the present view direction (choose again to update it); "
         "the plane shows the elements that it cuts (Ctrl+8)"));
  slider_->setObjectName("cut_slider");
  slider_->setAccessibleName(tr("Place of the cut"));
  slider_->setToolTip(tr("Moves the cut through the model (arrow keys)"));
  slider_->setRange(0, kTicks);
  slider_->setMinimumWidth(60);
  place_->setObjectName("cut_place");
  place_->setAccessibleName(tr("Place of the cut, a length"));
  place_->setToolTip(tr("Place of the cut along its direction, with a unit: 12.5 mm"));
  place_->setMaximumWidth(110);
  other_->setObjectName("cut_other");
  other_->setAccessibleName(tr("Show the other side of the cut"));
  other_->setToolTip(tr("Hide the front side of the cut instead of the back side"));
}

void CutBar::set_model(std::function<std::array<double, 2>(const Vector&)> extent, std::function<Vector()> look) {
  extent_ = std::move(extent);
  look_ = std::move(look);
}

/// In the middle of the model.
void CutBar::choose_way() {
  const bool on = way() != Way::none;
  for (QWidget* widget : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(place_), static_cast<QWidget*>(other_)})
    widget->setVisible(on);
  action_->setChecked(on);
  if (!on) {
    plane_.reset();
    emit changed();
    return;
  }
  last_way_ = way_->currentIndex();
  if (way() == Way::view) {
    normal_ = -1.0 * look_();  // what is nearer than the cut is hidden
  } else {
    normal_ = {};
    normal_[static_cast<std::size_t>(way()) - static_cast<std::size_t>(Way::x)] = 1;
  }
  to_middle();
}

void CutBar::to_middle() {
  const std::array<double, 2> extent = extent_(normal_);
  set_place(short_place(0.5 * (extent[0] + extent[1]), extent));
}

void CutBar::set_place(double place) {
  at_ = place;
  const double side = other_->isChecked() ? -1 : 1;
  plane_ = CutPlane{side * normal_, side * place};
  show_place();
  emit changed();
}

void CutBar::show_place() {
  const auto [from, to] = extent_(normal_);
  const QSignalBlocker quiet(slider_);
  slider_->setValue(to > from ? static_cast<int>(std::lround(kTicks * std::clamp((at_ - from) / (to - from), 0., 1.)))
                              : 0);
  place_->setText(metres_words(at_));
  place_->setStyleSheet({});
}

void CutBar::follow_model(bool is_new) {
  if (!plane_) return;
  const auto [from, to] = extent_(normal_);
  is_new && (at_ <= from || at_ >= to) ? to_middle() : show_place();
}

void CutBar::take_slider(int tick) {
  if (!plane_) return;
  const std::array<double, 2> extent = extent_(normal_);
  set_place(short_place(extent[0] + (extent[1] - extent[0]) * tick / kTicks, extent));
}

void CutBar::take_typed() {
  if (!plane_ || place_->text() == metres_words(at_)) return;
  QString error;
  const std::optional<double> metres = number_of(place_->text(), "m", &error);
  place_->setStyleSheet(metres ? QString() : "border: 2px solid #d03030;");
  place_->setToolTip(metres ? tr("Place of the cut along its direction, with a unit: 12.5 mm") : error);
  if (metres) set_place(*metres);
}

QString CutBar::words() const {
  if (!plane_) return {};
  const QString along = way() == Way::view ? tr("along the view") : QString("xyz"[static_cast<int>(way()) - 1]);
  return way() == Way::view ? tr(", cut at %1 %2").arg(metres_words(at_), along)
                            : tr(", cut at %1 = %2").arg(along, metres_words(at_));
}

}  // namespace breccia::gui
