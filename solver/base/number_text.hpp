#pragma once

#include <string>

namespace breccia {

/// A number of a message, with so many digits at most: 0.00015, 1.23e-09.
[[nodiscard]] std::string number_text(double value, int digits);

/// The number nearest to a value that has so many significant digits, as it is when it is printed and read again. Any
/// finite value, the smallest included.
[[nodiscard]] double rounded(double value, int digits);

}  // namespace breccia
