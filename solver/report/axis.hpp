#pragma once

#include <string>
#include <vector>

namespace breccia::report {

/// One axis of a chart: which values it spans, where its marks are, and how it is called.
struct Axis {
  double low = 0, high = 1;  ///< SI
  bool logarithmic = false;
  std::vector<double> marks;  ///< SI
  std::vector<std::string> labels;
  std::string title;  ///< "time [µs]"

  /// 0 at the low end, 1 at the high end.
  [[nodiscard]] double place(double value) const;
};

/// @param low, high  of the values; a linear axis whose values do not change sign begins at 0 where that costs less
///                   than half of it
/// @param unit       empty: a pure number, whose power of ten stands in the title
[[nodiscard]] Axis linear_axis(double low, double high, const std::string& name, const std::string& unit);
/// Marks at powers of ten, and between them where there are few. @pre 0 < low <= high
[[nodiscard]] Axis logarithmic_axis(double low, double high, const std::string& name, const std::string& unit);

}  // namespace breccia::report
