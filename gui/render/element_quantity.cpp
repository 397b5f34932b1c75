#include "render/element_quantity.hpp"

#include <algorithm>
#include <cmath>

#include "render/fragment_sizes.hpp"

namespace breccia::gui {

const QuantitySource& source_of(Quantity quantity) {
  constexpr double kMega = 1e-6, kMilli = 1e3;
  // Rounding of 2e-16 of places 1000 elements away, in a solid of 1 TPa and 10 km/s, is below each of these, and they
  // are less than anything that is measured on solids: 1 Pa is the weight of 0.1 mm of water, 1e-13 m a thousandth of
  // an atom, and 1 nm/s leads no farther in a millisecond.
  constexpr double kStress = 1, kSpeed = 1e-9, kLength = 1e-13;
  static constexpr std::array<QuantitySource, kNumQuantities> kSources{
      {{"fragment size", "mm", kFragmentSize, 0, kMilli, 0},
       {"speed", "m/s", "velocity", -1, 1, kSpeed},
       {"von Mises stress", "MPa", "von_mises", 0, kMega, kStress},
       {"largest principal stress", "MPa", "principal", 0, kMega, kStress},
       {"smallest principal stress", "MPa", "principal", 2, kMega, kStress},
       {"stress xx", "MPa", "stress", 0, kMega, kStress},
       {"stress yy", "MPa", "stress", 1, kMega, kStress},
       {"stress zz", "MPa", "stress", 2, kMega, kStress},
       {"stress xy", "MPa", "stress", 3, kMega, kStress},
       {"stress yz", "MPa", "stress", 4, kMega, kStress},
       {"stress xz", "MPa", "stress", 5, kMega, kStress},
       {"displacement", "mm", "displacement", -1, kMilli, kLength},
       {"displacement x", "mm", "displacement", 0, kMilli, kLength},
       {"displacement y", "mm", "displacement", 1, kMilli, kLength},
       {"displacement z", "mm", "displacement", 2, kMilli, kLength}}};
  return kSources[static_cast<std::size_t>(quantity)];
}

std::string title_of(Quantity quantity) {
  const QuantitySource& source = source_of(quantity);
  return std::string(source.name) + " [" + source.unit + "]";
}

double noise_of(const QuantitySource& source, double most) {
  constexpr double kCancelled = 1e-9;  // of sums of many terms, with room for errors that have grown
  return source.scale * std::max(source.noise, source.component < 0 ? 0.0 : kCancelled * most);
}

double number_of(vtkDataArray& values, vtkIdType row, int component) {
  if (component >= 0) return values.GetComponent(row, component);
  double sum = 0;
  for (int a = 0; a < values.GetNumberOfComponents(); ++a)
    sum += values.GetComponent(row, a) * values.GetComponent(row, a);
  return std::sqrt(sum);
}

}  // namespace breccia::gui
