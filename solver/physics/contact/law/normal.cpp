#include "physics/contact/law/normal.hpp"

#include <cmath>

#include "physics/whole_power.hpp"

namespace breccia::normal_law {

double power(double ratio, double exponent) {
  const int whole = static_cast<int>(exponent);
  return whole == exponent ? whole_power(ratio, whole) : std::pow(ratio, exponent);
}

}  // namespace breccia::normal_law
