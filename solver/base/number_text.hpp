#pragma once

#include <string>

namespace breccia {

/// A number of a message, with so many digits at most: 0.00015, 1.23e-09.
[[nodiscard]] std::string number_text(double value, int digits);

}  // namespace breccia
