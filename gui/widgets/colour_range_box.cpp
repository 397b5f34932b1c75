#include "widgets/colour_range_box.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <cmath>

#include "widgets/escape_key.hpp"

namespace breccia::gui {
namespace {

constexpr int kLeast = 64, kWidth = 84;  // pixels, of "-12.3456"

QLineEdit* end_field(const QString& object, const QString& name, const QString& tip) {
  auto* field = new QLineEdit;
  field->setObjectName(object);
  field->setAccessibleName(name);
  field->setToolTip(tip);
  field->setMinimumWidth(kLeast);
  field->setMaximumWidth(kWidth);
  field->setClearButtonEnabled(true);
  return field;
}

struct End {
  std::optional<double> value;  ///< none: it is found
  bool is_number = true;
};

End end_of(const QLineEdit& field) {
  const QString text = field.text().trimmed();
  if (text.isEmpty()) return {};
  bool ok = false;
  const double value = QLocale::c().toDouble(QString(text).replace(',', '.'), &ok);
  if (!ok || !std::isfinite(value)) return {{}, false};
  return {value};
}

QString words(const std::optional<double>& value) { return value ? QString::number(*value, 'g', 6) : QString(); }

void set_wrong(QLineEdit& field, bool wrong) { field.setStyleSheet(wrong ? "border: 2px solid #d03030;" : QString()); }

}  // namespace

ColourRangeBox::ColourRangeBox(QWidget* parent)
    : QWidget(parent),
      low_(end_field("colours_from", tr("Colours from"),
                     tr("Value of the darkest colour, in the unit of the legend; empty: the least of each frame, "
                        "without outliers (0.5 %)"))),
      high_(
          end_field("colours_to", tr("Colours to"),
                    tr("Value of the brightest colour, in the unit of the legend; empty: the largest of each frame, "
                       "without outliers (0.5 %)"))) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(new QLabel(tr("Colours from")));
  row->addWidget(low_);
  row->addWidget(new QLabel(tr("to")));
  row->addWidget(high_);
  for (QLineEdit* field : {low_, high_}) {
    connect(field, &QLineEdit::editingFinished, this, &ColourRangeBox::take);
    connect(field, &QLineEdit::textChanged, this, [this](const QString& text) {
      if (text.isEmpty()) take();  // its button does not end the editing
    });
    on_escape(*field, [this] { write_ends(); });
  }
}

void ColourRangeBox::show_range(const ColourRange& given, const std::array<double, 2>& drawn) {
  low_->setPlaceholderText(isEnabled() ? QString::number(drawn[0], 'g', 4) : QString());
  high_->setPlaceholderText(isEnabled() ? QString::number(drawn[1], 'g', 4) : QString());
  if (given == given_) return;  // what is being typed stays
  given_ = given;
  write_ends();
}

void ColourRangeBox::write_ends() {
  const QSignalBlocker low_quiet(low_), high_quiet(high_);
  low_->setText(words(given_.low));
  high_->setText(words(given_.high));
  for (QLineEdit* field : {low_, high_}) set_wrong(*field, false);
}

void ColourRangeBox::take() {
  const End low = end_of(*low_), high = end_of(*high_);
  const bool crossed = low.value && high.value && !(*low.value < *high.value);
  set_wrong(*low_, !low.is_number || crossed);
  set_wrong(*high_, !high.is_number || crossed);
  const ColourRange range{low.value, high.value};
  if (!low.is_number || !high.is_number || crossed || range == given_) return;
  given_ = range;
  emit chosen(range);
}

}  // namespace breccia::gui
