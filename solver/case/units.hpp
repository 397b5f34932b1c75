#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace breccia::case_ {

/// Powers of metre, kilogram, second and radian. The angle counts as a dimension, so that an angle in degrees is
/// converted and a frequency is not taken for an angular velocity.
struct Dimension {
  std::array<int, 4> powers{};
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

/// "pressure", "length", ... or "m2 kg s-1" when the dimension has no everyday name.
[[nodiscard]] std::string name_of(const Dimension& dimension);

/// A quantity in SI. has_unit distinguishes "3" from "3 m/m".
struct Quantity {
  double value = 0;
  Dimension dimension;
  bool has_unit = false;
};

/// A text that is no quantity, or one of the wrong dimension: what is wrong and what is allowed.
class UnitError : public std::runtime_error {
 public:
  UnitError(const std::string& what, std::string allowed_text)
      : std::runtime_error(what), allowed(std::move(allowed_text)) {}
  std::string allowed;
};

/// Reads "26.6 GPa", "9.81 m/s^2", "2340 kg/m3", "1 J/(m2 s)", "30 deg", "5 %", "1e-3 mm".
/// A quantity is a number and a unit; a unit is made of names with an optional prefix and an optional whole exponent
/// ("m2", "m^2", "s^-1"), multiplied by a space, "*" or "." and divided by "/", from left to right; brackets group.
/// Powers of ten are applied to the written digits, so "10 us" is exactly the double 1e-5.
/// Throws UnitError. O(length).
[[nodiscard]] Quantity parse_quantity(std::string_view text);

/// Dimension of a unit alone, e.g. "kg/m3"; "1" is dimensionless. Throws UnitError.
[[nodiscard]] Dimension dimension_of(std::string_view unit);

/// The quantity in SI, which must have the dimension of `unit`. A number without a unit is allowed when it is zero or
/// `unit` is dimensionless. Throws UnitError, which names the units allowed.
[[nodiscard]] double to_si(std::string_view text, std::string_view unit);

/// Magnitudes below this lose digits, and what is computed with them more.
inline constexpr double smallest_magnitude = 1e-307;

/// What a number is written with, for messages.
inline constexpr const char* kDecimalPoint = "a decimal point and no other separators, such as 0.2 or \"0.06 ms\"";

/// Which magnitudes a number may have, for messages.
[[nodiscard]] std::string magnitudes_help();

/// The names of all units and prefixes, for messages and help.
[[nodiscard]] std::string units_help();

}  // namespace breccia::case_
