#include "widgets/deformation_box.hpp"

#include <QCoreApplication>
#include <QLineEdit>
#include <QRegularExpression>
#include <optional>

namespace breccia::gui {
namespace {

/// Of "x10", "10", "2,5"; none: it is no such factor.
std::optional<double> scale_of(const QString& text) {
  static const QRegularExpression factor(R"(^\s*[x×]?\s*([0-9]+(?:[.,][0-9]+)?(?:[eE]\+?[0-9]+)?)\b)");
  const auto match = factor.match(text);
  const double scale = match.captured(1).replace(',', '.').toDouble();
  if (!match.hasMatch() || !(scale > 0) || scale > 1e9) return std::nullopt;
  return scale;
}

}  // namespace

DeformationBox::DeformationBox(QWidget* parent) : QComboBox(parent) {
  addItems({tr("x1 (true)"), tr("automatic"), "x2", "x10", "x100", "x1000"});
  setEditable(true);
  setInsertPolicy(NoInsert);
  setObjectName("deformation");
  setAccessibleName(tr("Scale of displacements"));
  setToolTip(
      tr("How many times larger than they are displacements are drawn; any factor can be typed. Automatic: so that the "
         "largest of the frame in view is seen; the other frames keep that scale until it is chosen again"));
  lineEdit()->setAccessibleName(accessibleName());
  lineEdit()->setToolTip(toolTip());
  connect(this, qOverload<int>(&QComboBox::activated), this, [this] { take(true); });
  connect(lineEdit(), &QLineEdit::editingFinished, this, [this] { take(false); });
}

void DeformationBox::take(bool anew) {
  const QString text = currentText().trimmed();
  const std::optional<double> scale = text == itemText(1) ? Deformation::kAutomatic : scale_of(text);
  setStyleSheet(scale ? QString() : "border: 2px solid #d03030;");
  if (!scale || (*scale == scale_ && !(anew && *scale == Deformation::kAutomatic))) return;
  scale_ = *scale;
  emit chosen();
}

QString words_of(const Deformation& deformation) {
  if (deformation.scale == 1) return {};
  if (deformation.lacks_rest)
    return QCoreApplication::translate("deformation", ", true places: no frame of this run is at rest");
  if (deformation.scale == Deformation::kAutomatic) return {};
  return QCoreApplication::translate("deformation", ", displacements x%1").arg(deformation.scale, 0, 'g', 6);
}

}  // namespace breccia::gui
