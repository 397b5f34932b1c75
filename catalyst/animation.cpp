#include "catalyst/animation.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string_view>

#include "catalyst/child_process.hpp"
#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPatience = "120";  ///< s
/// An animation is to last so long, s, as far as its speed is one that can be followed.
constexpr double kLength = 6;
constexpr int kSlowest = 3, kFastest = 25;  ///< pictures a second
/// Video wants even widths and heights; the last picture stays for a second.
constexpr const char* kFilter = "pad=ceil(iw/2)*2:ceil(ih/2)*2,tpad=stop_mode=clone:stop_duration=1";

/// Pictures that belong together.
struct Series {
  int pictures = 0;
  std::set<std::size_t> digits;  ///< of their numbers
};

/// Those of a folder, by what stands before their number.
std::map<std::string, Series> series_of(const fs::path& folder) {
  static const std::regex numbered("([^*?\\[\\]{}\\\\%]*)_([0-9]{6,})\\.png");
  std::map<std::string, Series> series;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::smatch match;
    const std::string name = entry.path().filename();
    if (!std::regex_match(name, match, numbered)) continue;
    ++series[match[1]].pictures;
    series[match[1]].digits.insert(static_cast<std::size_t>(match.length(2)));
  }
  std::erase_if(series, [](const auto& one) { return one.second.pictures < 2; });
  return series;
}

/// A text as a pattern of glob that it alone fits.
std::string as_pattern(const std::string& text) {
  std::string pattern;
  for (const char c : text)
    pattern += (std::string_view("\\*?[]{},~").find(c) == std::string_view::npos ? "" : "\\") + std::string(1, c);
  return pattern;
}

/// As one word of a shell.
std::string quoted(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./";
  if (word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

/// The pictures of a series and no others, as a pattern of glob: "view_*.png" would take those of "view_top" as well.
std::string pattern_of(const fs::path& folder, const std::string& name, const Series& series) {
  std::string numbers;
  for (const std::size_t digits : series.digits) {
    if (!numbers.empty()) numbers += ',';
    for (std::size_t i = 1; i < digits; ++i) numbers += "[0-9]";
    numbers += '?';  // a digit; without one of *?{ ffmpeg takes a pattern for a name
  }
  if (series.digits.size() > 1) numbers = "{" + numbers + "}";
  return as_pattern((folder / name).string()) + "_" + numbers + ".png";
}

std::vector<std::string> command_of(const fs::path& folder, const std::string& name, const Series& series,
                                    const fs::path& result) {
  const int speed = std::clamp(static_cast<int>(series.pictures / kLength), kSlowest, kFastest);
  return {"ffmpeg",
          "-nostdin",
          "-y",
          "-loglevel",
          "error",
          "-framerate",
          std::to_string(speed),
          "-pattern_type",
          "glob",
          "-i",
          pattern_of(folder, name, series),
          "-vf",
          kFilter,
          "-pix_fmt",
          "yuv420p",
          "-f",
          "mp4",
          result.string()};
}

std::string made(const fs::path& folder, const std::string& name, const Series& series) {
  const fs::path result = folder / (name + ".mp4"), temporary = folder / ("." + name + ".mp4.tmp");
  std::vector<std::string> command = command_of(folder, name, series, temporary);
  command.insert(command.begin(), {"timeout", kPatience});
  std::error_code error;
  try {
    static_cast<void>(output_of(command));
    fs::rename(temporary, result, error);
    if (!error) return "animation: " + result.string();
  } catch (const PipelineError&) {
    // Reported below: the output of ffmpeg is long.
  }
  fs::remove(temporary, error);
  return "animation: ffmpeg could not make " + result.string();
}

std::string recipe(const fs::path& folder, const std::string& name, const Series& series) {
  std::string line = "animation: apt-get install ffmpeg, then:";
  for (const std::string& word : command_of(folder, name, series, folder / (name + ".mp4"))) line += " " + quoted(word);
  return line;
}

}  // namespace

std::string make_animations(const std::vector<fs::path>& folders) {
  std::string lines;
  const bool can = is_on_path("ffmpeg");
  for (const fs::path& folder : std::set<fs::path>(folders.begin(), folders.end())) {
    for (const auto& [name, series] : series_of(folder)) {
      if (!can) return recipe(folder, name, series);
      lines += (lines.empty() ? "" : "\n") + made(folder, name, series);
    }
  }
  return lines;
}

}  // namespace breccia::insitu
