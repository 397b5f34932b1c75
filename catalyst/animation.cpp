#include "catalyst/animation.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>

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

/// Pictures of a folder that belong together: what stands before their number, and how many there are.
std::map<std::string, int> series_of(const fs::path& folder) {
  static const std::regex numbered("([^*?\\[\\]{}\\\\%]*)_[0-9]{6,}\\.png");
  std::map<std::string, int> series;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::smatch match;
    const std::string name = entry.path().filename();
    if (std::regex_match(name, match, numbered)) ++series[match[1]];
  }
  std::erase_if(series, [](const auto& one) { return one.second < 2; });
  return series;
}

std::vector<std::string> command_of(const fs::path& folder, const std::string& name, int pictures,
                                    const fs::path& result) {
  const int speed = std::clamp(static_cast<int>(pictures / kLength), kSlowest, kFastest);
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
          (folder / (name + "_*.png")).string(),
          "-vf",
          kFilter,
          "-pix_fmt",
          "yuv420p",
          "-f",
          "mp4",
          result.string()};
}

std::string made(const fs::path& folder, const std::string& name, int pictures) {
  const fs::path result = folder / (name + ".mp4"), temporary = folder / ("." + name + ".mp4.tmp");
  std::vector<std::string> command = command_of(folder, name, pictures, temporary);
  command.insert(command.begin(), {"timeout", kPatience});
  std::error_code error;
  try {
    static_cast<void>(output_of(command));
    fs::rename(temporary, result, error);
    if (!error) return "animation: " + result.string();
  } catch (const PipelineError&) {
    // Said below: what ffmpeg has to say of it is long.
  }
  fs::remove(temporary, error);
  return "animation: ffmpeg could not make " + result.string();
}

std::string recipe(const fs::path& folder, const std::string& name, int pictures) {
  std::string line = "animation: apt-get install ffmpeg, then:";
  for (const std::string& word : command_of(folder, name, pictures, folder / (name + ".mp4")))
    line += word.find_first_of("*(=") == std::string::npos ? " " + word : " '" + word + "'";
  return line;
}

}  // namespace

std::string make_animations(const std::vector<fs::path>& folders) {
  std::string lines;
  const bool can = is_on_path("ffmpeg");
  for (const fs::path& folder : std::set<fs::path>(folders.begin(), folders.end())) {
    for (const auto& [name, pictures] : series_of(folder)) {
      if (!can) return recipe(folder, name, pictures);
      lines += (lines.empty() ? "" : "\n") + made(folder, name, pictures);
    }
  }
  return lines;
}

}  // namespace breccia::insitu
