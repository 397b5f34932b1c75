#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "base/json_depth.hpp"

// Json is nlohmann::json or nlohmann::ordered_json, which the file that includes this one includes.
namespace breccia {

/// The value of a JSON text; discarded (is_discarded()) where it is no JSON or is nested deeper than kDeepestJson:
/// walks over a value are as deep on the stack as the value is.
template <class Json>
[[nodiscard]] Json json_of_text(std::string_view text) {
  if (is_nested_deeper(text, kDeepestJson)) return Json(Json::value_t::discarded);
  return Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
}

namespace run_folder {

/// NaN where the object has no number of that name.
template <class Json>
[[nodiscard]] double number_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->template get<double>()
                                                     : std::numeric_limits<double>::quiet_NaN();
}

/// 0 where the object has no number of that name, or one that a double does not count exactly.
template <class Json>
[[nodiscard]] std::int64_t whole_number_in(const Json& object, const char* name) {
  const double value = number_in(object, name);
  return std::abs(value) <= 9e15 ? static_cast<std::int64_t>(value) : 0;
}

/// Empty where the object has no text of that name.
template <class Json>
[[nodiscard]] std::string text_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->template get<std::string>() : std::string();
}

}  // namespace run_folder
}  // namespace breccia
