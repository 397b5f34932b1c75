#include "base/number_text.hpp"

#include <array>
#include <cstdio>

namespace breccia {

std::string number_text(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

}  // namespace breccia
