#pragma once

#include <vtkDataArray.h>

#include <array>
#include <string>

/// The numbers of every element in a frame, for colours and histograms. VTK only; may be called from any thread.
namespace breccia::gui {

enum class Quantity {
  fragment_size,
  speed,
  von_mises,
  tension,
  compression,
  stress_xx,
  stress_yy,
  stress_zz,
  stress_xy,
  stress_yz,
  stress_xz,
  displacement,
  displacement_x,
  displacement_y,
  displacement_z
};
inline constexpr int kNumQuantities = static_cast<int>(Quantity::displacement_z) + 1;

/// Where a quantity is found in a frame, and what people call it.
struct QuantitySource {
  const char* name;   ///< "von Mises stress"
  const char* unit;   ///< in which it is shown
  const char* array;  ///< of the elements
  int component;      ///< < 0: the magnitude
  double scale;       ///< from SI to the unit
  double noise;       ///< SI; what is no larger is rounding
};

/// A length: small in some models and large in others, so that its colours are in a unit that fits.
[[nodiscard]] constexpr bool is_length(Quantity quantity) {
  return quantity == Quantity::fragment_size || quantity >= Quantity::displacement;
}

[[nodiscard]] const QuantitySource& source_of(Quantity quantity);
/// "von Mises stress [MPa]"
[[nodiscard]] std::string title_of(Quantity quantity);

/// Size of the values of a quantity up to which they are rounding, in its unit: its own, or a share of the other
/// components, whose sums have cancelled in it. @param most  the largest of all components of its array, SI
[[nodiscard]] double noise_of(const QuantitySource& source, double most);

/// @param component  < 0: the magnitude
[[nodiscard]] double number_of(vtkDataArray& values, vtkIdType row, int component);

}  // namespace breccia::gui
