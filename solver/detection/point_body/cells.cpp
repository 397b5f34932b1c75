#include "detection/point_body/cells.hpp"

#include <cmath>

namespace breccia::detection {

double choose_cell(std::span<const Corners> contactors, double buffer, double share) {
  constexpr std::size_t sample_size = 4096;
  const std::size_t stride = contactors.size() / sample_size + 1;
  double sum_of_logarithms = 0;
  int count = 0;
  for (std::size_t c = 0; c < contactors.size(); c += stride) {
    const Corners& x = contactors[c];
    const Vec3 widths =
        x[0].cwiseMax(x[1]).cwiseMax(x[2].cwiseMax(x[3])) - x[0].cwiseMin(x[1]).cwiseMin(x[2].cwiseMin(x[3]));
    const double width = widths.sum() / 3 + 2 * buffer;
    if (!(width > 0) || !std::isfinite(width)) continue;
    sum_of_logarithms += std::log(width);
    ++count;
  }
  return count == 0 ? 1.0 : share * std::exp(sum_of_logarithms / count);
}

}  // namespace breccia::detection
