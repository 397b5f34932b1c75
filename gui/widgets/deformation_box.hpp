#pragma once

#include <QComboBox>

#include "render/deformation.hpp"

namespace breccia::gui {

/// How large displacements are drawn: as they are, so many times larger, or so that they are seen.
class DeformationBox final : public QComboBox {
  Q_OBJECT
 public:
  explicit DeformationBox(QWidget* parent = nullptr);
  /// As of Deformation.
  [[nodiscard]] double scale() const { return scale_; }

 signals:
  /// Automatic that is chosen once more is found anew.
  void chosen();

 private:
  void take(bool anew);

  double scale_ = 1;
};

/// ", displacements x200", or why they are not drawn so; empty: they are drawn as they are.
[[nodiscard]] QString words_of(const Deformation& deformation);

}  // namespace breccia::gui
