#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "run_folder/json_text.hpp"

namespace breccia::run_folder {

/// A frame that an index lists.
struct SeriesFrame {
  std::string name;  ///< of a file beside the index
  double time = 0;   ///< s, simulated
};

/// An index of frames, such as frames/elements.hdf.series.
struct Series {
  std::vector<SeriesFrame> frames;   ///< in the order of the index
  std::vector<std::string> refused;  ///< names of entries that are no file beside the index or have no time
};

/// False for what leads out of a folder, or is no name at all.
[[nodiscard]] inline bool is_plain_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

/// An index that is no JSON or lists no files gives no frames. Throws nothing but std::bad_alloc.
[[nodiscard]] inline Series parse_series(std::string_view text) {
  const auto json = json_of_text<nlohmann::json>(text);
  Series series;
  const auto files = json.is_object() ? json.find("files") : json.end();
  if (!json.is_object() || files == json.end() || !files->is_array()) return series;
  for (const auto& entry : *files) {
    std::string name = text_in(entry, "name");
    const double time = number_in(entry, "time");
    if (is_plain_name(name) && std::isfinite(time)) {
      series.frames.push_back({std::move(name), time});
    } else {
      series.refused.push_back(std::move(name));
    }
  }
  return series;
}

}  // namespace breccia::run_folder
