#pragma once

#include <array>
#include <vector>

namespace breccia::gui {

/// Share of the values at each end that colours pass over, as in the pictures of `breccia report`.
inline constexpr double kOutliers = 0.005;

/// Range of the colours of some values: the outermost ones are left out, unless all others are equal. Values that
/// differ by less than a thousandth of their size are one colour, of a range that begins or ends at 0.
/// Numbers that are not finite do not count.
/// O(values)
/// @param noise  size up to which a value is rounding alone; where all are, the result is { 0, 0 }. >= 0
/// @param outliers  share of them at each end, < 0.5
[[nodiscard]] std::array<double, 2> value_range(std::vector<double> values, double noise,
                                                double outliers = kOutliers);

}  // namespace breccia::gui
