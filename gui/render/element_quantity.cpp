#include "render/element_quantity.hpp"

#include <cmath>

namespace breccia::gui {

const QuantitySource& source_of(Quantity quantity) {
  constexpr double kMega = 1e-6, kMilli = 1e3;
  static constexpr std::array<QuantitySource, kNumQuantities> kSources{
      {{"speed", "m/s", "velocity", -1, 1},
       {"von Mises stress", "MPa", "von_mises", 0, kMega},
       {"largest principal stress", "MPa", "principal", 0, kMega},
       {"smallest principal stress", "MPa", "principal", 2, kMega},
       {"stress xx", "MPa", "stress", 0, kMega},
       {"stress yy", "MPa", "stress", 1, kMega},
       {"stress zz", "MPa", "stress", 2, kMega},
       {"stress xy", "MPa", "stress", 3, kMega},
       {"stress yz", "MPa", "stress", 4, kMega},
       {"stress xz", "MPa", "stress", 5, kMega},
       {"displacement", "mm", "displacement", -1, kMilli},
       {"displacement x", "mm", "displacement", 0, kMilli},
       {"displacement y", "mm", "displacement", 1, kMilli},
       {"displacement z", "mm", "displacement", 2, kMilli}}};
  return kSources[static_cast<std::size_t>(quantity)];
}

std::string title_of(Quantity quantity) {
  const QuantitySource& source = source_of(quantity);
  return std::string(source.name) + " [" + source.unit + "]";
}

double number_of(vtkDataArray& values, vtkIdType row, int component) {
  if (component >= 0) return values.GetComponent(row, component);
  double sum = 0;
  for (int a = 0; a < values.GetNumberOfComponents(); ++a)
    sum += values.GetComponent(row, a) * values.GetComponent(row, a);
  return std::sqrt(sum);
}

}  // namespace breccia::gui
