#include "base/number_text.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace breccia {

std::string number_text(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

double rounded(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
  return std::strtod(text.data(), nullptr);  // std::stod refuses numbers below 2.2e-308
}

}  // namespace breccia
