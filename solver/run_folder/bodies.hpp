#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "run_folder/csv.hpp"
#include "run_folder/lines.hpp"

namespace breccia::run_folder {

/// Names of the bodies by their numbers, from a text of bodies.csv: "body,name", then a line a body in the order of
/// their numbers. nullopt: it is no such table. A last line that is not whole is left out.
[[nodiscard]] inline std::optional<std::vector<std::string>> parse_bodies(std::string_view text) {
  const std::vector<std::string_view> lines = whole_lines(text).lines;
  if (lines.empty() || fields_of(lines.front()) != std::vector<std::string>{"body", "name"}) return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::vector<std::string> fields = fields_of(lines[i]);
    if (fields.size() != 2 || fields[0] != std::to_string(names.size())) return std::nullopt;
    names.push_back(std::move(fields[1]));
  }
  return names;
}

}  // namespace breccia::run_folder
