#pragma once

#include <QLineEdit>
#include <QWidget>
#include <array>

#include "render/scene.hpp"

namespace breccia::gui {

/// From where to where the colours reach: two ends, each found in every frame anew or given.
class ColourRangeBox final : public QWidget {
  Q_OBJECT
 public:
  explicit ColourRangeBox(QWidget* parent = nullptr);
  /// @param given  for the quantity in view
  /// @param drawn  the colours as they are drawn, in the same unit
  void show_range(const ColourRange& given, const std::array<double, 2>& drawn);

 signals:
  void chosen(const ColourRange& range);

 private:
  void take();
  void write_ends();

  QLineEdit *low_, *high_;
  ColourRange given_;
};

}  // namespace breccia::gui
