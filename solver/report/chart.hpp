#pragma once

#include <string>
#include <vector>

namespace breccia::report {

/// A line, or points, of a chart. Values that are not finite, and on a logarithmic axis those that are not positive,
/// are gaps.
struct Series {
  std::string name;
  std::vector<double> x, y;  ///< SI; y is what stands above the sum of the series before where they are stacked
  bool points = false;       ///< marks instead of a line
  bool reference = false;    ///< dark and dashed, never stacked
};

struct Chart {
  std::string title;  ///< for those who do not see it
  std::string x_name, x_unit, y_name, y_unit;
  bool log_x = false, log_y = false;
  bool stacked = false;  ///< areas, one above another, on a chart of twice the width; series share x
  std::vector<Series> series;
};

/// An SVG element with a title and a description in words. Lines of many values are thinned so that the extremes stay.
/// Empty where there is nothing to show.
[[nodiscard]] std::string svg_of(const Chart& chart);

/// A bar of a share (0 to 1) for a table.
[[nodiscard]] std::string bar(double share);

}  // namespace breccia::report
