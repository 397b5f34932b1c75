#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "run_folder/json_text.hpp"
#include "system/regular_file.hpp"

namespace breccia {

/// The value (json_of_text) of a file of a run's folder; discarded as well where there is no file. Throws InputError
/// where it cannot be read or is no regular file.
/// @tparam Json  nlohmann::json or nlohmann::ordered_json
template <class Json>
[[nodiscard]] Json json_of_file(const std::filesystem::path& file, Depth depth = Depth::file) {
  const std::optional<std::string> content = regular_content(file, depth);
  return content ? json_of_text<Json>(*content) : Json(Json::value_t::discarded);
}

}  // namespace breccia
