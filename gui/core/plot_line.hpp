#pragma once

#include <QString>
#include <vector>

namespace breccia::gui {

/// A line of a chart.
struct PlotLine {
  QString name;
  std::vector<double> x, y;  ///< same length
};

}  // namespace breccia::gui
