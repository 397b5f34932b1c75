#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/json_depth.hpp"
#include "system/regular_file.hpp"

namespace breccia {

/// The value of a JSON text; discarded (is_discarded()) where it is no JSON or is nested deeper than kDeepestJson:
/// walks over a value are as deep on the stack as the value is.
/// @tparam Json  nlohmann::json or nlohmann::ordered_json
template <class Json>
[[nodiscard]] Json json_of_text(std::string_view text) {
  if (is_nested_deeper(text, kDeepestJson)) return Json(Json::value_t::discarded);
  return Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
}

/// Likewise of a file of a run's folder; discarded as well where it is no regular file or cannot be read.
template <class Json>
[[nodiscard]] Json json_of_file(const std::filesystem::path& file, Depth depth = Depth::file) {
  const std::optional<std::string> content = regular_content(file, depth);
  return content ? json_of_text<Json>(*content) : Json(Json::value_t::discarded);
}

}  // namespace breccia
